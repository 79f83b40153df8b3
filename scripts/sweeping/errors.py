"""The error that ends a sweep before anything is run."""


class SweepError(Exception):
    """Input or usage that cannot be run; the message is one line."""
