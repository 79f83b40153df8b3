"""The error that ends a night before there is a verdict."""


class TrackingError(Exception):
    """What cannot be run or read; the message is one line. The exit code is 2."""


class ProgramCrashed(TrackingError):
    """The same of a program that a signal ended."""


def run_again_once(run, note):
    """run(""), or run("-again") if a program crashed in the first; a second crash is raised. note:
    called with a line that says so. Mesa's llvmpipe crashes about once in 500 replays: docs/nightly.md.
    """
    try:
        return run("")
    except ProgramCrashed as error:
        note(f"{error}; run again")
        return run("-again")
