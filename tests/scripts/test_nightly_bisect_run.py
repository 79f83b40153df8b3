"""scripts/nightly.sh --bisect in a repository whose commits say how fast a stand-in for the program is,
built by a stand-in for CMake."""

import json
import os
import shutil
import signal
import subprocess
import time

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")

import fake_nightly  # noqa: E402
from nightly_machine import CELL, ROOT  # noqa: E402
from tracking.commit_line import list_line  # noqa: E402
from tracking.core import list_cores  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402

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


def test_on_a_gpu_all_have_the_same_core(repository):
    good = repository.commit("first", renderer="NVIDIA H200/PCIe/SSE2")
    repository.commit("second", renderer="NVIDIA H200/PCIe/SSE2")
    assert repository.bisect(good).returncode == 0
    program = repository.root / f"build/nightly/{good[:12]}/build/release/bench/hlodbench"
    assert {tuple(cores) for cores in fake_nightly.read_timed_cores(program)} == {
        (list_cores()[-1],)}


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
