"""The programs of a bisection: of commits, in worktrees as baselines are."""

from run_cells import ROOT

from .build import Baseline
from .program import Program


class Programs:
    """Built when they are first asked for, each with hierarchies of its own. say: called with lines
    of progress. kept: Commits whose builds are used again if an earlier bisection left them."""

    def __init__(self, out, scenes, context, say, kept):
        self._out, self._scenes, self._context, self._say = out, scenes, context, say
        self._baselines = {commit.hash: Baseline(ROOT, commit.hash, "--bisect") for commit in kept}
        self._programs = {}  # {hash: Program}

    def get(self, commit):
        """The Program of a commit, a hash, with hierarchies. Raises TrackingError."""
        if commit not in self._programs:
            baseline = Baseline(ROOT, commit, "--bisect")
            self._baselines[commit] = baseline
            self._say(f"building {baseline.revision} in {baseline.folder}")
            path = baseline.build(self._out / f"{baseline.revision}.build.log",
                                  self._baselines.values())
            program = Program(path, baseline.folder / ".cache", baseline.revision, self._out,
                              ROOT / "sessions", self._context)
            for scene in self._scenes:
                self._say(f"hierarchy of {scene} ({program.name})")
                program.build_hierarchy(scene)
            self._programs[commit] = program
        return self._programs[commit]

    def remove_others(self, kept):
        """Takes away those whose hash is not among `kept`, with what is unfinished of them."""
        for commit in self._baselines.keys() - set(kept):
            self._programs.pop(commit, None)
            self._baselines.pop(commit).remove()
