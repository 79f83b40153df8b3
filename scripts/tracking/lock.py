"""One night at a time on a machine, whichever checkout and history it belongs to."""

import fcntl
import os
import pathlib
import sys
import tempfile

NAME = "hlodbench-nightly.lock"


class MachineLock:
    """Held while something is built or measured; gone with the process, however it ends. Waits for
    another one, and says so."""

    def __enter__(self):
        path = pathlib.Path(tempfile.gettempdir()) / NAME
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        except PermissionError:  # another user's
            self._file = os.open(path, os.O_RDONLY)
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            print("nightly.sh: another night is measured on this machine; waiting for its end",
                  file=sys.stderr)
            fcntl.flock(self._file, fcntl.LOCK_EX)
        return self

    def __exit__(self, *_):
        os.close(self._file)
