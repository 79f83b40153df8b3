"""The error that ends a night before there is a verdict."""


class TrackingError(Exception):
    """What cannot be run or read; the message is one line. The exit code is 2."""
