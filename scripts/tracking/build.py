"""The programs: of this checkout, and of a baseline revision in a worktree of its own."""

import pathlib
import shutil
import subprocess

from sweeping import child

from .commit_line import SHORT, resolve_commit, run_git
from .errors import TrackingError

PRESET = "release"
PROGRAM = pathlib.Path("build") / PRESET / "bench" / "hlodbench"
WHOLE = ".nightly-complete"  # in a baseline's folder, when its program has been built

# Ends its whole process group when it is told to end: cmake does not pass signals on.
END_TOGETHER = """trap 'trap - TERM; kill 0' TERM; "$@" & wait $!"""


def build_program(source, log, what):
    """Builds the program of a source folder, and returns its path. log: a file that gets what CMake
    says. what: what to call it. Raises TrackingError."""
    steps = (["cmake", "--preset", PRESET],
             ["cmake", "--build", str(pathlib.Path("build") / PRESET), "--target", "hlodbench"])
    for step in steps:
        if run(step, source, log) != 0:
            raise TrackingError(f"{what}: `{' '.join(step)}` failed: {last_line(log)} ({log})")
    program = pathlib.Path(source) / PROGRAM
    if not program.is_file():
        raise TrackingError(f"{what}: expected {program} after the build, found none")
    return program


def run(command, folder, log):
    """Runs a command that ends with us, however we end, with all that it has started: a compiler
    that goes on would be in the next night's times. Its exit code; what it says goes to the log."""
    if shutil.which(command[0]) is None:
        raise TrackingError(f"{command[0]}: cannot be run: no such program")
    with open(log, "ab") as file:
        try:
            with child.start(["sh", "-c", END_TOGETHER, "sh", *map(str, command)], cwd=folder,
                             stdout=file, stderr=file, stdin=subprocess.DEVNULL,
                             start_new_session=True) as process:
                try:
                    return process.wait()
                except BaseException:
                    process.terminate()
                    raise
        except OSError as error:
            raise TrackingError(f"sh: cannot be run: {error.strerror}") from None


def last_line(log):
    """The last line of a log that says something, for an error of one line."""
    try:
        lines = pathlib.Path(log).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return "no log"
    lines = [line.strip() for line in lines if line.strip()]
    telling = [line for line in lines if "error:" in line.lower() or line.startswith("hlodbench: ")]
    return (telling or lines or ["it said nothing"])[-1][:200]


class Baseline:
    """A revision, built in ROOT/build/nightly/<its hash>, which stays until another one is wanted:
    the next night need not build it again."""

    def __init__(self, root, revision, option="--baseline"):
        """option: what names it, in messages. Raises TrackingError if there is no such revision."""
        self._root, self._option = pathlib.Path(root), option
        self.revision = resolve_commit(root, revision, option)[:SHORT]
        self.folder = self._root / "build" / "nightly" / self.revision

    def build(self, log, keep=()):
        """Builds it unless it is there; the program's path. Others are taken away, but not those in
        `keep`."""
        self._remove_others({self.folder, *(other.folder for other in keep)})
        if not (self.folder / WHOLE).is_file():
            self.remove()
            self.folder.parent.mkdir(parents=True, exist_ok=True)
            done = self._git("worktree", "add", "--detach", "--force", str(self.folder),
                             self.revision)
            if done.returncode != 0:
                raise TrackingError(f"{self._option}: git worktree add: {_one_line(done.stderr)}")
        program = build_program(self.folder, log, f"{self._option} {self.revision}")
        (self.folder / WHOLE).touch()
        return program

    def remove(self):
        """Takes it away."""
        self._remove(self.folder)

    def _remove_others(self, kept):
        folder = self.folder.parent
        for other in folder.iterdir() if folder.is_dir() else ():
            if other not in kept:
                self._remove(other)
        self._git("worktree", "prune")

    def _remove(self, folder):
        """Also what a killed attempt left of it."""
        self._git("worktree", "remove", "--force", "--force", str(folder))
        shutil.rmtree(folder, ignore_errors=True)
        self._git("worktree", "prune")

    def _git(self, *arguments):
        return run_git(self._root, *arguments)


def _one_line(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else "it said nothing"
