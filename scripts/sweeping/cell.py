"""A result folder that appears when it is complete, or not at all."""

import os
import pathlib
import shutil
import socket

from result_folder import ResultError, read_run

from . import child


class CellFailed(Exception):
    """The folder could not be made; the message is one line. `code` is the program's exit code."""

    def __init__(self, message, code=None):
        super().__init__(message)
        self.code = code


class Attempt:
    """A run of `command` with `--out` and a folder beside `folder`, which becomes `folder` when it
    has finished well. A context manager: at its end the program is ended, and what is unfinished
    goes.

    If another process fills `folder` in the meantime, that one stays.
    """

    def __init__(self, command, folder, **options):
        """options: of subprocess.Popen. Raises OSError if the program cannot be started."""
        self._folder = pathlib.Path(folder)
        self._partial = self._folder.with_name(
            f".{self._folder.name}.{socket.gethostname()}.{os.getpid()}")
        self._process = child.start([*map(str, command), "--out", str(self._partial)], **options)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._process.poll() is None:
            self._process.terminate()
            self._process.wait()
        shutil.rmtree(self._partial, ignore_errors=True)

    def finish(self, check=lambda _: None):
        """Waits for its end. Raises CellFailed unless the program ends with 0 and check(folder)
        finds no flaw."""
        code = self._process.wait()
        if code != 0:
            raise CellFailed(f"hlodbench ended with code {code}", code)
        flaw = check(self._partial)
        if flaw:
            raise CellFailed(flaw)
        try:
            self._partial.rename(self._folder)
        except OSError:
            if not self._folder.is_dir() or not any(self._folder.iterdir()):
                raise


def run_whole(command, folder, check=lambda _: None, **options):
    """An Attempt, from its start to its end."""
    with Attempt(command, folder, **options) as attempt:
        attempt.finish(check)


def find_flaw(folder):
    """Why a result folder does not count, as one line; None if it is whole."""
    try:
        run = read_run(folder, frames=False)
    except ResultError as error:
        return str(error)
    options = run.data.get("options") or {}
    failed = [case for case in run.cases if case.error]
    if run.data.get("complete") is not True:
        return f"{folder}: the run was interrupted"
    if failed:
        return (f"{folder}: {failed[0].strategy}, repetition {failed[0].repetition}, failed: "
                f"{failed[0].error}")
    if not run.cases or not all(case.summary for case in run.cases):
        return f"{folder}: expected the summary of every case, found none"
    gone = [case["csv"] for case in run.data["cases"]
            if not (run.folder / str(case.get("csv"))).is_file()]
    if gone:
        return f"{folder / str(gone[0])}: expected a frame log, found none"
    wants_images = options.get("images", "none") != "none"
    if wants_images and not (run.images and run.images.get("complete", True)):
        return f"{folder}: expected pictures, found none or a part"
    return None
