"""The baseline of scripts/nightly.sh: a revision in a worktree, built by a stand-in for CMake."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")

from tracking.build import Baseline, build_program, last_line, run  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402

CMAKE = """#!/bin/sh
echo "$PWD $*" >>"$CMAKE_LOG"
case $1 in
  --build) [ ! -e broken ] || { echo "a.cpp:1: error: the reason why" >&2; exit 1; }
    mkdir -p build/release/bench && cp text build/release/bench/hlodbench ;;
esac
"""


def git(folder, *arguments):
    done = subprocess.run(["git", "-C", folder, "-c", "user.name=A", "-c", "user.email=a@b", "-c",
                           "commit.gpgsign=false", *arguments], capture_output=True, text=True,
                          check=True)
    return done.stdout.strip()


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """A repository with two commits and an uncommitted change; the last commit does not build."""
    bin_folder = tmp_path / "bin"
    bin_folder.mkdir()
    (bin_folder / "cmake").write_text(CMAKE, encoding="utf-8")
    (bin_folder / "cmake").chmod(0o755)
    monkeypatch.setenv("PATH", f"{bin_folder}:{os.environ['PATH']}")
    monkeypatch.setenv("CMAKE_LOG", str(tmp_path / "cmake.log"))
    root = tmp_path / "checkout"
    root.mkdir()
    git(root, "init", "-q")
    (root / ".gitignore").write_text("/build/\n", encoding="utf-8")
    (root / "text").write_text("first", encoding="utf-8")
    git(root, "add", "-A")
    git(root, "commit", "-qm", "first")
    (root / "broken").write_text("", encoding="utf-8")
    git(root, "add", "-A")
    git(root, "commit", "-qm", "second")
    (root / "text").write_text("mine", encoding="utf-8")
    return root


def builds(tmp_path):
    return (tmp_path / "cmake.log").read_text(encoding="utf-8").splitlines()


def test_a_baseline_is_built_beside_the_checkout_which_stays_as_it_is(checkout, tmp_path):
    before = git(checkout, "status", "--porcelain"), git(checkout, "rev-parse", "HEAD")
    baseline = Baseline(checkout, "HEAD~1")
    program = baseline.build(tmp_path / "log")
    assert program.read_text(encoding="utf-8") == "first"
    assert baseline.folder.parent == checkout / "build/nightly"
    assert (git(checkout, "status", "--porcelain"), git(checkout, "rev-parse", "HEAD")) == before
    assert (checkout / "text").read_text(encoding="utf-8") == "mine"
    assert git(baseline.folder, "rev-parse", "--short=12", "HEAD") == baseline.revision
    assert Baseline(checkout, "HEAD~1").build(tmp_path / "log") == program  # it is still there


@pytest.mark.parametrize("left", ["folder", "registration", "unfinished"])
def test_what_a_killed_attempt_left_is_no_obstacle(checkout, tmp_path, left):
    baseline = Baseline(checkout, "HEAD~1")
    if left == "folder":
        baseline.folder.mkdir(parents=True)
        (baseline.folder / "text").write_text("half", encoding="utf-8")
    else:
        git(checkout, "worktree", "add", "--detach", baseline.folder, baseline.revision)
        (baseline.folder / "text").write_text("half", encoding="utf-8")
    if left == "registration":
        subprocess.run(["rm", "-r", baseline.folder], check=True)
    assert baseline.build(tmp_path / "log").read_text(encoding="utf-8") == "first"


def test_only_the_last_baseline_is_kept(checkout, tmp_path):
    first = Baseline(checkout, "HEAD~1")
    first.build(tmp_path / "log")
    (checkout / "broken").unlink()
    git(checkout, "commit", "-qam", "third")
    Baseline(checkout, "HEAD").build(tmp_path / "log")
    assert not first.folder.exists()
    assert len(git(checkout, "worktree", "list").splitlines()) == 2


def test_a_baseline_that_does_not_build_is_said_in_one_line(checkout, tmp_path):
    with pytest.raises(TrackingError) as caught:
        Baseline(checkout, "HEAD").build(tmp_path / "log")
    assert "error: the reason why" in str(caught.value) and "\n" not in str(caught.value)
    with pytest.raises(TrackingError):  # and again, as it is not finished
        Baseline(checkout, "HEAD").build(tmp_path / "log")


@pytest.mark.parametrize("revision", ["none", "", "--help", "HEAD~9", "HEAD:text"])
def test_an_unknown_revision_is_refused(checkout, revision):
    with pytest.raises(TrackingError, match="expected a revision"):
        Baseline(checkout, revision)


def test_no_cmake_is_said(checkout, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "/nonexistent")
    with pytest.raises(TrackingError, match="cmake: cannot be run"):
        build_program(checkout, tmp_path / "log", "this")


RUN = """
import sys
sys.path.insert(0, sys.argv[1])
from tracking.build import run
run(["sh", "-c", "sleep 300 & echo $! >started; mv started pid; wait"], None, "log")
"""


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_what_a_build_has_started_ends_with_us(tmp_path, number):
    scripts = pathlib.Path(__file__).resolve().parents[2] / "scripts"
    process = subprocess.Popen([sys.executable, "-c", RUN, scripts], cwd=tmp_path)
    wait_until((tmp_path / "pid").exists)
    stat = pathlib.Path("/proc") / (tmp_path / "pid").read_text(encoding="ascii").strip() / "stat"
    assert stat.exists()
    process.send_signal(number)
    process.wait(timeout=30)

    def is_gone():
        try:
            return stat.read_text(encoding="ascii").split()[2] == "Z"
        except OSError:
            return True
    wait_until(is_gone)


def wait_until(condition):
    end = time.monotonic() + 30
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_a_command_has_its_own_exit_code(tmp_path):
    assert run(["sh", "-c", "echo said; exit 7"], tmp_path, tmp_path / "log") == 7
    assert last_line(tmp_path / "log") == "said"
    assert run(["true"], None, tmp_path / "log") == 0


def test_the_telling_line_is_an_error_and_no_file_of_that_name(tmp_path):
    log = pathlib.Path(tmp_path / "log")
    log.write_text("[1/2] building node_error.cpp\na.cpp:3: error: that\nninja: stopped\n",
                   encoding="utf-8")
    assert last_line(log) == "a.cpp:3: error: that"
    log.write_text("[1/2] building node_error.cpp\nstopped\n\n", encoding="utf-8")
    assert last_line(log) == "stopped"
