"""scripts/nightly.sh with a stand-in for the program: the timing tier."""

import json
import subprocess

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
jsonschema = pytest.importorskip("jsonschema", reason="needs python3-jsonschema")

import fake_nightly  # noqa: E402
from nightly_machine import CELL, SCHEMA, TIMED  # noqa: E402
from tracking.history import append  # noqa: E402


def test_as_fast_is_the_same(machine):
    done = machine.compare()
    assert done.returncode == 0, done.stderr
    assert machine.timing()["verdict"] == "SAME"
    samples = machine.night()["timing"]["cells"][CELL]
    assert len(samples["new"]) == len(samples["base"]) == 9 and "first" not in samples
    assert {q: len(r) for q, r in samples["ratios"].items()} == {
        "frame": 9, "draw": 9, "query": 9, "traversal": 9}
    assert not (machine.out / "timing-again").exists()


def test_runs_of_both_programs_take_turns(machine):
    """Each has a turn every eight of ten frames, or it would wait for ever."""
    machine.compare()
    assert machine.night()["timing"]["turn_frames"] == 8
    for program in (machine.new, machine.base):
        calls = [c for c in fake_nightly.read_calls(program) if "gl" in c]
        assert len(calls) == 9 and all("--turns" in c for c in calls)


def test_a_program_that_ends_early_does_not_keep_the_other_one_waiting(machine):
    fake_nightly.set_state(machine.base, code=1)
    done = machine.compare()
    assert done.returncode == 2 and done.stderr.splitlines()[-1].startswith("nightly.sh: baseline: ")


@pytest.mark.parametrize("which", ["new", "base"])
def test_runs_of_programs_that_cannot_take_turns_alternate(machine, which):
    state = {"turns": which != "new"}
    fake_nightly.set_state(machine.base, seed=1, turns=which != "base")
    done = machine.compare(**state)
    assert "one after the other" in done.stderr
    assert machine.night()["timing"]["turn_frames"] is None
    folders = sorted((machine.out / "timing/courtyard").glob("coh-b.*.*/run.json"),
                     key=lambda path: path.stat().st_mtime_ns)
    order = [path.parent.name.split(".")[1:] for path in folders]
    assert [int(repetition) for repetition, _ in order] == [i // 2 for i in range(18)]
    firsts = [side for _, side in order[::2]]
    assert all(a != b for a, b in zip(firsts, firsts[1:]))


@pytest.mark.parametrize("share, verdict, code", [(0.1, "SLOW", 1), (-0.1, "FAST", 0)])
def test_slower_or_faster_is_measured_again_before_it_is_said(machine, share, verdict, code):
    done = machine.compare(slower=share)
    assert done.returncode == code, done.stderr
    found = machine.timing()
    assert found["verdict"] == verdict and f"measured again after {verdict}" in found["reason"]
    assert abs(found["change"] - share) < 0.01
    # all of it is added to a stage with 14 of 20 ms
    assert found["stage"].startswith("query ")
    assert found["quantities"]["query"]["change"] == pytest.approx(share * 20 / 16, abs=0.01)
    assert {found["quantities"][q]["verdict"] for q in ("draw", "traversal")} == {"SAME"}
    samples = machine.night()["timing"]["cells"][CELL]
    assert len(samples["first"]["new"]) == len(samples["new"]) == 9
    assert samples["first"]["new"] != samples["new"]
    assert (machine.out / "timing-again").is_dir()
    jsonschema.Draft7Validator(SCHEMA).validate(machine.night())
    assert f"{verdict} | {found['change']*100:+.1f}" in done.stdout.replace("**", "")
    assert f"most of it in {found['stage']}" in done.stdout


def test_less_than_the_least_change_is_not_slow(machine):
    assert machine.compare(slower=0.01, noise=0.001).returncode == 0
    assert machine.timing()["verdict"] == "SAME"
    assert machine.compare("--min-change", "0.5", slower=0.01, noise=0.001).returncode == 1


def test_a_noisy_machine_says_so(machine):
    done = machine.compare(slower=0.5, noise=0.4)
    assert done.returncode == 0, done.stderr
    assert machine.timing()["verdict"] == "UNCLEAR"
    assert "noisy machine" in done.stdout
    done = machine.compare(slower=0.5, noise=0.4)
    assert "night 2 in a row that cannot tell" in done.stdout


def test_other_programs_are_noise(machine):
    busy = subprocess.Popen(["sh", "-c", "while :; do :; done"])
    try:
        done = machine.compare("--max-others", "0", slower=0.5)
    finally:
        busy.kill()
        busy.wait()
    assert done.returncode == 0, done.stderr
    assert machine.timing()["reason"].startswith("noisy machine: other programs used")


def test_a_strategy_that_the_baseline_lacks_cannot_be_told(machine):
    fake_nightly.set_state(machine.base, strategies=["bool"])
    done = machine.compare()
    assert done.returncode == 0, done.stderr
    assert "no such strategy" in machine.timing()["reason"]


def test_times_of_another_hierarchy_are_told_apart(machine):
    machine.compare()
    assert "hierarchy" not in machine.timing()["reason"]
    machine.compare(tree="ff", slower=0.1)
    assert machine.timing()["reason"].endswith("; the baseline has built another hierarchy")


@pytest.mark.parametrize("side", ["new", "base"])
def test_a_program_that_crashes_once_is_run_again_and_it_is_said(machine, side):
    """Mesa's llvmpipe does so, seldom."""
    state = {"crash": [1, 4]}  # the exact tier, too
    if side == "base":
        fake_nightly.set_state(machine.base, seed=1, crash=[3])
        state = {}
    done = machine.compare(**state)
    assert done.returncode == 0, done.stderr
    assert len(machine.night()["timing"]["cells"][CELL]["new"]) == 9
    lines = [line for line in done.stdout.splitlines() if line.startswith("Crashed: ")]
    assert all("ended by signal 9" in line and "run again" in line for line in lines)
    assert len(lines) == len(machine.night()["crashes"]) == (2 if side == "new" else 1)
    jsonschema.Draft7Validator(SCHEMA).validate(machine.night())


def test_a_program_that_crashes_twice_is_no_night(machine):
    fake_nightly.set_state(machine.base, crash=[3, 4])
    done = machine.compare()
    assert done.returncode == 2 and "ended by signal 9" in done.stderr.splitlines()[-1]
    assert machine.files() == []


def test_without_a_baseline_nights_are_compared_with_earlier_nights(machine):
    assert machine.run(*TIMED).returncode == 0
    assert machine.timing()["reason"].endswith("found 0")
    night = machine.night()
    for number in range(2, 11):
        earlier = json.loads(json.dumps({**night, "sequence": number}))
        samples = earlier["timing"]["cells"][CELL]
        samples["new"] = [value * (1 + 0.001 * number) for value in samples["new"]]
        del earlier["schema"]
        append(machine.history, night["machine"]["key"], earlier, "a")
    assert machine.run(*TIMED).returncode == 0
    assert machine.timing()["verdict"] == "SAME"
    for _ in range(2):  # it does not become the norm by itself
        assert machine.run(*TIMED, slower=0.1).returncode == 1
        assert machine.timing()["verdict"] == "SLOW"
        assert machine.night()["timing"]["mode"] == "history"
        jsonschema.Draft7Validator(SCHEMA).validate(machine.night())
    machine.accept("--why", "x", "--who", "y")
    assert machine.run(*TIMED, slower=0.1).returncode == 0
    assert machine.timing()["reason"].endswith("found 1")


def test_the_calibration_is_measured_in_every_repetition(machine):
    done = machine.run(*TIMED, "--calibration", "numpy")
    assert done.returncode == 0, done.stderr
    timing = machine.night()["timing"]
    seconds = timing["calibration"]["seconds"]
    assert len(seconds) == 9 and min(seconds) > 0
    assert timing["calibration"]["workload"].startswith("numpy-1/")
    assert timing["cells"][CELL]["calibration"] == sorted(seconds)[4]
    machine.run(*TIMED, "--calibration", "numpy", renderer="NVIDIA H100")
    assert machine.night()["timing"]["cells"][CELL]["calibration"] == 1.0
