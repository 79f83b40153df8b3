"""scripts/nightly.sh --bisect: the search, what decides it, and bisections of a repository whose
commits say how fast a stand-in for the program is, built by a stand-in for CMake."""

import json
import math
import os
import pathlib
import shutil
import signal
import subprocess
import time

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")

import fake_nightly  # noqa: E402
from tracking import bisection  # noqa: E402
from tracking.bisect import ON_BAD, ON_GOOD, Search, choose_quantity, decide  # noqa: E402
from tracking.bisect import search_all  # noqa: E402
from tracking.bisect_report import as_data, make_summary  # noqa: E402
from tracking.commit_line import Commit, list_line  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402
from tracking.timing import FAST, SAME, SLOW, UNCLEAR, Rule, Verdict  # noqa: E402
from tracking.timing_tier import CellResult  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
CELL = "courtyard/coh-b"


# The search


class Oracle:
    """Knows the first changed commit of each cell, and which commits cannot be judged."""

    def __init__(self, last, changes, broken=()):
        self.changes, self.broken, self.tried = changes, set(broken), []
        self.searches = {cell: Search(last) for cell in changes}
        search_all(self.searches, self.judge)

    def judge(self, number, cells, steps):
        assert number not in self.tried and cells and steps >= 1
        self.tried.append(number)
        if number in self.broken:
            return dict.fromkeys(cells)
        return {cell: ON_BAD if number >= self.changes[cell] else ON_GOOD for cell in cells}

    def found(self):
        return {cell: search.list_candidates() for cell, search in self.searches.items()}


@pytest.mark.parametrize("last", [*range(1, 20), 64, 100])
def test_every_commit_is_found_in_few_steps(last):
    for first in range(1, last + 1):
        oracle = Oracle(last, {"a": first})
        assert oracle.found() == {"a": [first]}
        assert len(oracle.tried) <= math.ceil(math.log2(last)) + 1


@pytest.mark.parametrize("broken", [{4}, {5}, {1, 2, 3}, {3, 4, 6, 7}, set(range(1, 9)), {1, 8}])
def test_skipped_commits_leave_those_that_it_may_be(broken):
    for first in range(1, 10):
        before = max(n for n in range(first) if n not in broken)
        after = min(n for n in range(first, 10) if n not in broken)
        assert Oracle(9, {"a": first}, broken).found() == {"a": list(range(before + 1, after + 1))}


def test_a_run_of_commits_that_do_not_build_is_left_at_once():
    oracle = Oracle(1000, {"a": 100}, range(400, 600))
    assert oracle.found() == {"a": [100]} and len(oracle.tried) <= 11


def test_cells_that_changed_elsewhere_share_what_is_tried():
    for first in range(1, 17):
        for second in range(1, 17):
            oracle = Oracle(16, {"a": first, "b": second})
            assert oracle.found() == {"a": [first], "b": [second]}
            assert len(oracle.tried) <= 7 if first != second else 4


def test_the_steps_left_are_told():
    told = []
    search_all({"a": Search(16)}, lambda n, c, steps: told.append(steps) or {"a": ON_BAD})
    assert told == [4, 3, 2, 1]
    assert Search(1).count_steps() == 0


# What decides


def verdict(kind, low=None, high=None):
    change = None if low is None else (low + high) / 2
    return Verdict(kind, "", change, low, high)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("kind, low, high, side", [
    ("same as bad", 0.02, 0.03, ON_BAD),  # a change is one, however small
    ("same as bad", 0.08, 0.12, ON_BAD),
    (SAME, -0.01, 0.01, ON_GOOD),
    (SAME, 0.04, 0.06, ON_GOOD),  # of a large least change
    (SAME, 0.06, 0.08, ON_BAD),
    (UNCLEAR, -0.03, 0.04, ON_GOOD),
    (UNCLEAR, 0.06, 0.2, ON_BAD),
    (UNCLEAR, 0.01, 0.06, None),
    (UNCLEAR, -0.5, 0.5, None),
    ("other way", -0.1, -0.05, ON_GOOD),
    (UNCLEAR, None, None, None)])
def test_a_side_is_told_by_verdict_and_interval(kind, low, high, side, sign):
    bad = verdict(SLOW if sign > 0 else FAST, *sorted((sign * 0.08, sign * 0.12)))
    kind = {"same as bad": bad.verdict, "other way": FAST if sign > 0 else SLOW}.get(kind, kind)
    if low is not None:
        low, high = sorted((sign * low, sign * high))
    assert decide(verdict(kind, low, high), bad) == side


def test_what_was_not_measured_decides_nothing():
    assert decide(None, verdict(SLOW, 0.1, 0.2)) is None


def test_the_stage_decides_where_the_frame_did_not():
    slow, unclear = verdict(SLOW, 0.1, 0.2), verdict(UNCLEAR, -0.1, 0.2)
    for frame, expected in ((slow, "frame"), (unclear, "query")):
        result = CellResult(slow, {}, {"frame": frame, "query": slow}, "query")
        assert choose_quantity(result) == expected


# The order of things, with scripted measurements of commits "0" (good) to "4" (bad)


OTHER = "courtyard/bool"
SLOWER, UNCHANGED = verdict(SLOW, 0.09, 0.11), verdict(SAME, -0.01, 0.01)
DOUBTFUL = verdict(UNCLEAR, 0.0, 0.1)
CHANGED_AT_3 = {"1": UNCHANGED, "2": UNCHANGED, "3": SLOWER, "4": SLOWER, ("3", "2"): SLOWER}


class ScriptedPrograms:
    """strategies: {commit: ids}. fails: commits that do not build."""

    def __init__(self, fails=(), strategies=None):
        self.fails, self.strategies = fails, strategies or {}
        self.there, self.built = set(), []

    def get(self, commit):
        if commit in self.fails:
            raise TrackingError(f"{commit}:\nno such thing")
        if commit not in self.there:
            self.there.add(commit)
            self.built.append(commit)
        return fake_program(commit, self.strategies.get(commit, ["coh-b", "bool"]))

    def remove_others(self, kept):
        self.there &= set(kept)


def fake_program(commit, strategies):
    return type("P", (), {"name": commit, "takes_turns": commit != "1",
                          "list_strategies": lambda self: strategies})()


@pytest.fixture
def bisect(monkeypatch, tmp_path):
    """bisect(script, cells, **) gives a Bisection, its programs and what was measured: (new, base,
    cells, seed). script: {commit or (commit, base): Verdict, Verdicts of attempts, or {cell: one}}.
    """

    def run(script, cells=(CELL,), **programs):
        measured, programs = [], ScriptedPrograms(**programs)

        class Tier:
            def __init__(self, options, new, base, *_):
                self.what = new.name, base.name
                self.seed = options.seed
                assert {new.name, base.name} <= programs.there

            def run(self, able, say):
                say("progress")
                measured.append((*self.what, able, self.seed))
                said = script[self.what if self.what in script else self.what[0]]
                if isinstance(said, list):
                    said = said.pop(0)
                of_cell = said if isinstance(said, dict) else dict.fromkeys(able, said)
                return {cell: CellResult(of_cell[cell], {}, {"frame": of_cell[cell]})
                        for cell in able}

        monkeypatch.setattr(bisection, "TimingTier", Tier)
        line = [Commit(str(n), f"subject {n}", str(n - 1) if n else None) for n in range(5)]
        made = bisection.Bisection(line, Rule(), 9, 7)
        bisection.Run(made, programs, tmp_path).find(cells)
        json.dumps(as_data(made))
        return made, programs, measured

    return run


def found(made, cell=CELL):
    return [commit.hash for commit in made.culprits[cell].candidates]


def test_each_measurement_has_a_seed_and_only_what_is_needed_stays(bisect):
    made, programs, measured = bisect(CHANGED_AT_3)
    assert found(made) == ["3"] and "confirmed |" in make_summary(made)
    assert [m[:2] for m in measured] == [("4", "0"), ("2", "0"), ("3", "0"), ("3", "2")]
    assert measured[0][3] == 7 and measured[-1][3] not in (7, 8)
    assert programs.there == {"0", "2", "3", "4"}
    assert sorted(programs.built) == ["0", "2", "3", "4"]  # once, for the confirmation too
    made, programs, _ = bisect({"1": SLOWER, "2": SLOWER, "4": SLOWER})
    assert found(made) == ["1"] and programs.there == {"0", "1", "4"}


def test_programs_that_cannot_take_turns_are_named(bisect, capsys):
    bisect({"1": SLOWER, "2": SLOWER, "4": SLOWER})
    said = [line for line in capsys.readouterr().err.splitlines() if "--turns" in line]
    assert [line.split(":")[1] for line in said] == [" 1", " 1-parent"]


def test_what_cannot_be_told_is_measured_again_and_then_decided(bisect):
    made, _, measured = bisect({**CHANGED_AT_3, "2": [DOUBTFUL, UNCHANGED]})
    assert found(made) == ["3"]
    again = [m for m in measured if m[:2] == ("2", "0")]
    assert len(again) == 2 and abs(again[0][3] - again[1][3]) > 1  # a tier uses two seeds


def test_what_cannot_be_told_twice_is_skipped_with_the_reason(bisect):
    doubtful = Verdict(UNCLEAR, "the reason", 0.05, 0.0, 0.1)
    made, _, measured = bisect({**CHANGED_AT_3, "2": [doubtful, doubtful]})
    assert found(made) == ["2", "3"] and made.culprits[CELL].own is None
    assert len([m for m in measured if m[0] == "2"]) == 2
    assert f"- `2` subject 2: {CELL}: the reason" in make_summary(made)


def test_what_does_not_run_or_lacks_the_strategy_is_skipped(bisect):
    made, _, measured = bisect(CHANGED_AT_3, fails=("2",))
    assert found(made) == ["2", "3"]
    assert "- `2` subject 2: 2: no such thing" in make_summary(made)
    made, _, measured = bisect(CHANGED_AT_3, strategies={"2": ["bool"]})
    assert found(made) == ["2", "3"] and "2" not in [m[0] for m in measured]
    assert "no such strategy" in make_summary(made)


def test_a_strategy_that_the_good_commit_lacks_cannot_be_told(bisect):
    made, _, measured = bisect(CHANGED_AT_3, [CELL, OTHER], strategies={"0": ["coh-b"]})
    assert found(made) == ["3"] and OTHER not in made.culprits
    assert all(m[2] == [CELL] for m in measured)


def test_only_changed_cells_are_measured_and_each_has_its_commit(bisect):
    third = "courtyard/sw-b"
    programs = {str(n): ["coh-b", "bool", "sw-b"] for n in range(5)}
    both, one = {CELL: SLOWER, OTHER: SLOWER}, {CELL: UNCHANGED, OTHER: SLOWER}
    script = {"4": {**both, third: UNCHANGED}, "1": one, "2": one, "3": both,
              ("3", "2"): SLOWER, ("1", "0"): [one, SLOWER]}
    made, _, measured = bisect(script, [CELL, OTHER, third], strategies=programs)
    assert found(made) == ["3"] and found(made, OTHER) == ["1"]
    assert all(third not in m[2] for m in measured[1:])
    assert [m[2] for m in measured if m[0] == "2"] == [[CELL, OTHER]]


@pytest.mark.parametrize("own, said", [
    (verdict(SLOW, 0.02, 0.04), "less than half of the change: bisect from 3 for the rest"),
    (UNCHANGED, "not confirmed: against its parent SAME")])
def test_a_commit_that_is_not_all_of_it_is_said(bisect, own, said):
    made, _, _ = bisect({**CHANGED_AT_3, ("3", "2"): own})
    assert found(made) == ["3"] and said in make_summary(made) and made.is_slower


def test_a_full_disk_ends_it_and_is_no_reason_to_skip(bisect, monkeypatch):
    monkeypatch.setattr(bisection, "check_space", raise_no_space)
    with pytest.raises(TrackingError, match="no space"):
        bisect(CHANGED_AT_3)


def raise_no_space(_):
    raise TrackingError("no space")


# A repository


CMAKE = """#!/bin/sh
[ "$1" = --build ] || exit 0
[ ! -e broken ] || { echo "a.cpp:1: error: the reason why" >&2; exit 1; }
mkdir -p build/release/bench && cp "$FAKE" state build/release/bench &&
  mv build/release/bench/state build/release/bench/hlodbench.json
"""


class Repository:
    """With a copy of scripts/, which it ignores, so that it is what they measure."""

    def __init__(self, folder):
        self.folder, self.root, self.count, self.seed = folder, folder / "checkout", 0, 0
        (folder / "bin").mkdir()
        (folder / "bin/cmake").write_text(CMAKE, encoding="utf-8")
        (folder / "bin/cmake").chmod(0o755)
        (folder / "tmp").mkdir()
        fake = fake_nightly.add_program(folder / "hlodbench")
        self.environment = {**os.environ, "FAKE": str(fake), "TMPDIR": str(folder / "tmp"),
                            "HLODBENCH_CACHE": str(folder / "cache"),
                            "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}
        shutil.copytree(ROOT / "scripts", self.root / "scripts",
                        ignore=shutil.ignore_patterns("__pycache__"))
        self.git("init", "-q")
        (self.root / ".gitignore").write_text("/build/\n/results/\n/scripts/\n", encoding="utf-8")

    def git(self, *arguments):
        done = subprocess.run(["git", "-C", self.root, "-c", "user.name=A", "-c", "user.email=a@b",
                               "-c", "commit.gpgsign=false", *arguments], capture_output=True,
                              text=True, check=True)
        return done.stdout.strip()

    def commit(self, subject, broken=False, **state):
        """Its hash."""
        self.seed += 1  # no two programs have the same noise
        (self.root / "state").write_text(json.dumps({"seed": self.seed, **state}),
                                         encoding="utf-8")
        (self.root / "broken").unlink(missing_ok=True)
        if broken:
            (self.root / "broken").touch()
        self.git("add", "-A")
        self.git("commit", "-qm", subject)
        return self.git("rev-parse", "HEAD")

    def command(self, revisions, *arguments):
        self.count += 1
        self.out = self.folder / f"out-{self.count}"
        return [self.root / "scripts/nightly.sh", "--bisect", revisions, "--out", self.out,
                "--cell", CELL, "--max-others", "100", *arguments]

    def bisect(self, revisions, *arguments):
        return subprocess.run(self.command(revisions, *arguments), env=self.environment,
                              cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=300)

    def data(self):
        return json.loads((self.out / "bisect.json").read_text(encoding="utf-8"))

    def cell(self):
        return self.data()["cells"][CELL]

    def built(self):
        """Names of the folders of builds that are there."""
        return sorted(path.name for path in (self.root / "build/nightly").iterdir())


@pytest.fixture
def repository(tmp_path):
    return Repository(tmp_path)


def test_the_commit_that_made_a_cell_slower_is_found(repository):
    commits = [repository.commit("first"), repository.commit("a | second"),
               repository.commit("the culprit", slower=0.1),
               repository.commit("after it", slower=0.1)]
    (repository.root / "state").write_text("mine", encoding="utf-8")
    before = repository.git("status", "--porcelain"), repository.git("rev-parse", "HEAD")
    done = repository.bisect(commits[0])
    assert done.returncode == 1, done.stderr
    cell = repository.cell()
    assert cell["candidates"] == [commits[2]] and cell["error"] is None
    assert cell["change"]["verdict"] == cell["own_change"]["verdict"] == "SLOW"
    assert cell["own_change"]["change"] == pytest.approx(0.1, abs=0.02)
    assert cell["own_change"]["stage"].startswith("query ")
    assert done.stdout == (repository.out / "summary.md").read_text(encoding="utf-8")
    row = next(line for line in done.stdout.splitlines() if line.startswith(f"| {CELL}"))
    assert f"`{commits[2][:12]}` the culprit | SLOW +" in row and row.endswith("| confirmed |")
    data = repository.data()
    assert [c["commit"] for c in data["commits"]] == commits
    assert {p["commit"]: p["cells"][CELL][-1]["side"] for p in data["probes"]} == {
        commits[1]: "good", commits[2]: "bad"}
    assert "about 2 more builds; " in done.stderr and "about 1 more build; " in done.stderr
    assert repository.built() == [commits[0][:12]]
    assert len(repository.git("worktree", "list").splitlines()) == 2
    after = repository.git("status", "--porcelain"), repository.git("rev-parse", "HEAD")
    assert after == before
    assert not (repository.root / "results").exists()


def test_a_commit_that_does_not_build_is_skipped_and_a_faster_one_is_no_regression(repository):
    good = repository.commit("first")
    broken = repository.commit("broken", broken=True)
    bad = repository.commit("faster", slower=-0.1)
    repository.commit("not measured", code=1)
    done = repository.bisect(f"{good}..{bad}")
    assert done.returncode == 0, done.stderr
    assert repository.cell()["change"]["verdict"] == "FAST"
    assert repository.cell()["candidates"] == [broken, bad]
    (probe,) = repository.data()["probes"]
    assert probe["commit"] == broken and "error: the reason why" in probe["error"]
    assert f"one of: `{broken[:12]}` broken; `{bad[:12]}` faster" in done.stdout
    assert f"- `{broken[:12]}` broken: --bisect {broken[:12]}: " in done.stdout
    assert repository.built() == [good[:12]]


def test_no_change_is_said_and_nothing_is_searched(repository):
    good = repository.commit("first")
    repository.commit("second", broken=True)
    repository.commit("third")
    done = repository.bisect(good)
    assert done.returncode == 0, done.stderr
    assert "no cell is found to have changed" in done.stdout.splitlines()[0]
    assert f"| {CELL} | SAME |" in done.stdout
    assert repository.data()["probes"] == [] and repository.cell()["candidates"] == []


def test_killed_in_the_middle_the_next_one_works(repository):
    good = repository.commit("first", sleep=60)
    repository.commit("second", sleep=60)
    process = subprocess.Popen(repository.command(good), env=repository.environment,
                               cwd=repository.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    wait_for(repository.out, f"{repository.git('rev-parse', 'HEAD')[:12]}/timing")
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=30) == 143
    assert not (repository.out / "bisect.json").exists()
    assert repository.built() == [good[:12]]
    left = repository.root / "build/nightly/0123456789ab"
    left.mkdir()  # of one that ended at once
    good = repository.commit("third")
    culprit = repository.commit("fourth", slower=0.1)
    done = repository.bisect(good)
    assert done.returncode == 1, done.stderr
    assert repository.cell()["candidates"] == [culprit]
    assert repository.built() == [good[:12]]


def wait_for(folder, name):
    end = time.monotonic() + 60
    while not (folder / name).exists():
        assert time.monotonic() < end, name
        time.sleep(0.02)


def test_a_bad_commit_that_does_not_build_is_an_error(repository):
    good = repository.commit("first")
    repository.commit("second", broken=True)
    done = repository.bisect(good)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.splitlines()[-1].count("error: the reason why") == 1


def test_wrong_usage_is_one_line(repository):
    first, second = repository.commit("first"), repository.commit("second")
    for arguments, said in (
            (("HEAD",), "twice"), (("none",), "'none'"), ((f"{first}..none",), "'none'"),
            (("",), "found ''"), ((f"{second}..{first}",), "ancestor"),
            ((first, "--no-times"), "exclude"), ((first, "--program", "x"), "exclude"),
            ((first, "--baseline", "x"), "exclude"),
            ((first, "--baseline-program", "x"), "exclude"), ((first, "stray"), "'stray'")):
        done = repository.bisect(*arguments)
        assert done.returncode == 2 and done.stdout == "" and not repository.out.exists()
        assert len(done.stderr.splitlines()) == 1 and said in done.stderr, done.stderr


def test_the_line_is_that_of_first_parents(repository):
    good = repository.commit("first")
    branch = repository.git("rev-parse", "--abbrev-ref", "HEAD")
    repository.git("checkout", "-qb", "side")
    side = repository.commit("on a side")
    repository.git("checkout", "-q", branch)
    second = repository.commit("second")
    repository.git("merge", "-q", "-s", "ours", "-m", "merged", "side")
    merged = repository.git("rev-parse", "HEAD")
    line = list_line(repository.root, good)
    assert [commit.hash for commit in line] == [good, second, merged]
    assert [commit.parent for commit in line] == [None, good, second]
    assert line[2].subject == "merged"
    beside = list_line(repository.root, f"{side}..")
    assert [(c.hash, c.parent) for c in beside[1:]] == [(second, good), (merged, second)]
    with pytest.raises(TrackingError, match="ancestor"):
        list_line(repository.root, f"{second}..{side}")
