"""The commits from a good one to a bad one, along first parents."""

import pathlib
import subprocess
from dataclasses import dataclass

from .commits import find_subjects
from .errors import TrackingError

SHORT = 12  # digits of a hash, in names of folders and in messages


@dataclass(frozen=True)
class Commit:
    """Hashes are whole."""

    hash: str
    subject: str
    parent: str | None  # the first one's hash; None for the good commit, whose does not matter

    @property
    def short(self):
        """As folders and messages have it."""
        return self.hash[:SHORT]

    def as_dict(self):
        return {"commit": self.hash, "subject": self.subject}


def run_git(root, *arguments):
    """A CompletedProcess, of text. Raises TrackingError without git."""
    try:
        return subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True,
                              errors="replace", check=False, stdin=subprocess.DEVNULL)
    except OSError as error:
        raise TrackingError(f"git: cannot be run: {error.strerror}") from None


def resolve_commit(root, revision, option):
    """The hash of a revision of the repository at `root`. option: which one names it, for the
    TrackingError if there is none."""
    done = run_git(root, "rev-parse", "--verify", "--quiet", "--end-of-options",
                   f"{revision}^{{commit}}")
    if done.returncode != 0:
        raise TrackingError(f"{option}: expected a revision of {root}, found '{revision}'")
    return done.stdout.strip()


def list_line(root, text):
    """The Commits from GOOD to BAD, both included, of "GOOD..BAD" or "GOOD", where BAD is HEAD.
    Raises TrackingError."""
    root = pathlib.Path(root)
    names = text.partition("..")
    good = resolve_commit(root, names[0], "--bisect")
    bad = resolve_commit(root, names[2] or "HEAD", "--bisect")
    if good == bad:
        raise TrackingError(f"--bisect: expected two commits, found {good[:SHORT]} twice")
    if run_git(root, "merge-base", "--is-ancestor", good, bad).returncode != 0:
        raise TrackingError(f"--bisect: expected an ancestor of {bad[:SHORT]}, found "
                            f"{good[:SHORT]}, which is none")
    done = run_git(root, "rev-list", "--first-parent", "--parents", "--reverse", f"{good}..{bad}")
    if done.returncode != 0 or not done.stdout:
        raise TrackingError(f"--bisect: git rev-list: {' '.join(done.stderr.split())}")
    parents = {good: None}
    for line in done.stdout.splitlines():
        commit, *others = line.split()
        parents[commit] = others[0] if others else None
    subjects = find_subjects(root, parents)
    return [Commit(commit, subjects.get(commit, ""), parent)
            for commit, parent in parents.items()]
