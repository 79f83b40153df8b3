"""scripts/nightly.sh with a stand-in for the program: the exact tier, exit codes, kills."""

import json
import signal
import subprocess
import sys
import time

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
jsonschema = pytest.importorskip("jsonschema", reason="needs python3-jsonschema")

import fake_nightly  # noqa: E402
from nightly_machine import CELL, EXACT, ROOT, SCHEMA, TIMED  # noqa: E402
from tracking import night as night_module  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402


# The exact tier


def test_the_same_is_the_same_and_every_file_is_what_the_schema_says(machine):
    for _ in range(2):
        done = machine.run(*EXACT)
        assert done.returncode == 0, done.stderr
    night = machine.night()
    assert {v["exact"]["verdict"] for v in night["verdicts"].values()} == {"SAME"}
    assert len(night["exact"]) == 5
    assert done.stdout == (machine.out / "summary.md").read_text(encoding="utf-8")
    assert "nothing worse" in done.stdout
    files = machine.files()
    assert len(files) == 2
    for path in files:
        jsonschema.Draft7Validator(SCHEMA).validate(json.loads(path.read_text(encoding="utf-8")))
    assert json.loads(files[-1].read_text(encoding="utf-8")) == night
    (call,) = [c for c in fake_nightly.read_calls(machine.new) if c[0] == "run"][1:]
    values = dict(zip(call[1::2], call[2::2]))
    assert values["--latency"] == "draws:12" and values["--images"] == "10"
    assert values["--strategy"] == "bool,sw-b,simp-b,coh-b,reuse-b"


@pytest.mark.parametrize("state, keys", [
    ({"add": {"queries": 1}}, {"queries", "queries.frames"}),
    ({"add": {"rarn": 2, "dn": 1}}, {"rarn", "rarn.frames", "dn", "dn.frames"}),
    ({"picture": 1}, {"picture.6", "picture.9"}),
    ({"drop": "triangles"}, {"triangles"})])
def test_a_change_is_one_counter_by_counter_until_it_is_accepted(machine, state, keys):
    assert machine.run(*EXACT).returncode == 0
    for _ in range(2):  # a night later, too
        done = machine.run(*EXACT, **state)
        assert done.returncode == 1, done.stderr
        verdict = machine.night()["verdicts"][CELL]["exact"]
        found = {d["key"] for d in verdict["differences"]}
        assert keys <= found and (found == keys or "picture" in state), found
        assert all(f"- {key} " in done.stdout for key in keys)
    accepted = machine.accept("--why", "wanted", "--who", "A. Nother")
    assert accepted.returncode == 0, accepted.stderr
    assert len(accepted.stdout.splitlines()) == 5
    assert machine.run(*EXACT, **state).returncode == 0
    is_new = "drop" in state  # a counter that was not there says nothing of the others
    assert machine.run(*EXACT).returncode == (0 if is_new else 1)


def test_one_cell_is_accepted_and_the_others_stay_changes(machine):
    machine.run(*EXACT)
    machine.run(*EXACT, add={"dn": 1})
    assert machine.accept("--why", "x", "--who", "y", "--cell", CELL).returncode == 0
    assert machine.run(*EXACT, add={"dn": 1}).returncode == 1
    verdicts = machine.night()["verdicts"]
    assert [c for c, v in verdicts.items() if v["exact"]["verdict"] == "SAME"] == [CELL]


def test_a_gpu_and_a_software_rasteriser_never_meet(machine):
    assert machine.run(*EXACT).returncode == 0
    done = machine.run(*EXACT, renderer="NVIDIA H100", add={"dn": 1})
    assert done.returncode == 0
    assert {v["exact"]["verdict"] for v in machine.night()["verdicts"].values()} == {"NEW"}
    assert machine.run(*EXACT, "--machine", "lab", add={"dn": 1}).returncode == 0
    assert len(list(machine.history.iterdir())) == 3
    refused = machine.accept("--why", "x", "--who", "y")
    assert refused.returncode == 2 and len(refused.stderr.splitlines()) == 1


def test_a_damaged_row_is_named_and_the_rest_is_compared_with(machine):
    machine.run(*EXACT)
    (machine.files()[0].parent / "20260101T000000Z-x-y.json").write_text("{", encoding="utf-8")
    done = machine.run(*EXACT, add={"dn": 1})
    assert done.returncode == 1
    assert "20260101T000000Z-x-y.json" in done.stderr and "Problem: " in done.stdout


def test_a_night_leaves_a_report_of_its_pictures_and_does_without(machine):
    pytest.importorskip("jinja2", reason="needs python3-jinja2")
    machine.run(*EXACT)
    assert not (machine.out / "report.html").exists()
    machine.options = ()
    done = machine.run(*EXACT)
    if "dygraph" in done.stderr:
        pytest.skip("needs libjs-dygraphs")
    text = (machine.out / "report.html").read_text(encoding="utf-8")
    assert "courtyard" in text and "data:image/" in text
    machine.environment["PYTHONPATH"] = str(machine.folder)
    (machine.folder / "jinja2.py").write_text("raise ImportError(name='jinja2')", encoding="utf-8")
    done = machine.run(*EXACT)
    assert done.returncode == 0 and "no report.html: report.py: needs jinja2" in done.stderr


# What cannot run


@pytest.mark.parametrize("code, words", [(1, "the reason why"), (3, "no usable OpenGL"),
                                         (139, "code 139")])
def test_a_program_that_fails_is_no_night(machine, code, words):
    machine.run(*EXACT)
    before = machine.files()
    done = machine.run(*EXACT, code=code)
    assert done.returncode == 2 and words in done.stderr.splitlines()[-1]
    assert done.stdout == "" and machine.files() == before


def test_a_baseline_that_fails_is_no_night(machine):
    fake_nightly.set_state(machine.base, code=1)
    done = machine.compare()
    assert done.returncode == 2 and "baseline" in done.stderr.splitlines()[-1]
    assert machine.files() == []


def test_no_space_is_said_before_anything_is_run(machine, monkeypatch, tmp_path):
    monkeypatch.setattr(night_module.shutil, "disk_usage", lambda _: type("U", (), {"free": 5}))
    options = type("O", (), {"out": tmp_path / "a", "history": tmp_path / "b", "program": "x"})
    with pytest.raises(TrackingError, match="no space"):
        night_module.make_folders(options)


def test_a_history_that_is_a_file_is_refused_in_one_line(machine):
    machine.history.write_text("", encoding="utf-8")
    done = machine.run(*EXACT)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1


@pytest.mark.parametrize("arguments", [
    ("--no-such-option",), ("stray",), ("",), ("--repetitions", "8"), ("--repetitions", "x"),
    ("--min-change", "-1"), ("--cell", "courtyard/none"), ("--context", "glx"), ("--out", ""),
    ("--baseline", "a", "--baseline-program", "b"), ("--seed",)])
def test_wrong_usage_is_one_line(machine, arguments):
    done = machine.run(*arguments)
    assert done.returncode == 2 and done.stdout == ""
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert not machine.history.exists() or machine.files() == []


# Kills, and two at once


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
@pytest.mark.parametrize("when", ["exact", "timing"])
def test_killed_in_the_middle_nothing_is_added_and_the_next_night_works(machine, number, when):
    if when == "timing":
        fake_nightly.set_state(machine.base, sleep=60)
        arguments = (*TIMED, "--baseline-program", machine.base)
        fake_nightly.set_state(machine.new, sleep=60)
    else:
        arguments = EXACT
        fake_nightly.set_state(machine.new)
    process = subprocess.Popen(machine.command(*arguments), env=machine.environment,
                               cwd=machine.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    wait_for(machine.out / (when if when == "timing" else "exact"))
    process.send_signal(number)
    expected = {signal.SIGKILL: -9, signal.SIGTERM: 143, signal.SIGINT: 130}
    assert process.wait(timeout=30) == expected[number]
    assert machine.files() == []
    fake_nightly.set_state(machine.base, seed=1)
    done = machine.compare()  # the lock is free, no run of the killed one is in the way
    assert done.returncode == 0, done.stderr
    assert len(machine.files()) == 1


DROPPED = """
import os, signal, sys, time
sys.path.insert(0, sys.argv[1])
from tracking import cli
cli.RETRY_S = 0.1
cli.end_on_signals()
os.register_at_fork(after_in_parent=lambda: os.kill(os.getpid(), signal.SIGTERM))
if os.fork() == 0:
    os._exit(0)
print("dropped", flush=True)
try:
    time.sleep(60)
finally:  # as main() does: at its end Python gives signals their defaults back
    signal.setitimer(signal.ITIMER_REAL, 0)
"""


def test_a_signal_that_python_drops_around_a_fork_ends_it_all_the_same():
    done = subprocess.run([sys.executable, "-c", DROPPED, ROOT / "scripts"], capture_output=True,
                          text=True, check=False, timeout=50)
    assert done.returncode == 143 and done.stdout == "dropped\n"


def wait_for(path):
    end = time.monotonic() + 60
    while not path.exists():
        assert time.monotonic() < end, path
        time.sleep(0.02)


def test_two_at_once_measure_in_turn_and_are_both_added(machine):
    fake_nightly.set_state(machine.new, sleep=0.05)
    processes = [subprocess.Popen(machine.command(*TIMED), env=machine.environment,
                                  cwd=machine.folder, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True) for _ in range(2)]
    said = [process.communicate(timeout=120)[1] for process in processes]
    assert [process.returncode for process in processes] == [0, 0], said
    assert sum("waiting for its end" in text for text in said) == 1
    files = [json.loads(path.read_text(encoding="utf-8")) for path in machine.files()]
    assert sorted(data["sequence"] for data in files) == [1, 2]


# The help


def test_every_option_stands_in_the_help():
    from tracking.cli import make_accept_parser, make_run_parser
    done = subprocess.run([ROOT / "scripts/nightly.sh", "--help"], capture_output=True, text=True,
                          check=True)
    for parser in (make_run_parser(), make_accept_parser()):
        for action in parser._actions:  # pylint: disable=protected-access
            assert f"{action.option_strings[0]} " in done.stdout
