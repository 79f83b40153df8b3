"""scripts/nightly.sh: which core of the processor timed replays run on."""

import os

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")

import fake_nightly  # noqa: E402
from nightly_machine import CELL  # noqa: E402
from tracking.core import ANY, AUTO, choose_core, list_cores, on_core  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402

GPU = "NVIDIA H200/PCIe/SSE2"
CORES = list_cores()
pytestmark = pytest.mark.skipif(len(CORES) < 2, reason="needs two cores to choose from")


def timed_cores(machine):
    """Of all timed replays of both programs, sorted out: each once."""
    found = [tuple(cores) for path in (machine.new, machine.base)
             for cores in fake_nightly.read_timed_cores(path)]
    assert len(found) >= 2 * 9
    return set(found)


def test_on_a_gpu_both_programs_of_a_pair_have_the_same_core(machine):
    assert machine.compare(renderer=GPU).returncode == 0
    assert timed_cores(machine) == {(CORES[-1],)}
    assert machine.night()["timing"]["core"] == CORES[-1]
    exact = fake_nightly.read_lines(machine.new.with_name("new.cores"))[0]
    assert exact == CORES  # what is not timed has all


def test_a_software_rasteriser_has_all_cores(machine):
    assert machine.compare().returncode == 0
    assert timed_cores(machine) == {tuple(CORES)}
    assert machine.night()["timing"]["core"] is None


def test_the_core_can_be_chosen(machine):
    assert machine.compare("--core", str(CORES[0])).returncode == 0
    assert timed_cores(machine) == {(CORES[0],)}


def test_any_core_can_be_left_to_a_program_that_draws_on_a_gpu(machine):
    assert machine.compare("--core", "any", renderer=GPU).returncode == 0
    assert timed_cores(machine) == {tuple(CORES)}


def test_without_a_baseline_it_is_the_same_core_every_night(machine):
    assert machine.run("--cell", CELL, renderer=GPU).returncode == 0
    assert {tuple(c) for c in fake_nightly.read_timed_cores(machine.new)} == {(CORES[-1],)}


@pytest.mark.parametrize("core, said", [("4321", "expected one of 0, "), ("last", "expected a number"),
                                        ("-1", "expected a number")])
def test_a_core_that_there_is_not_is_refused_in_one_line(machine, core, said):
    done = machine.run("--core", core)
    assert done.returncode == 2 and said in done.stderr
    assert len(done.stderr.splitlines()) == 1 and not machine.out.exists()


def test_what_is_chosen():
    assert choose_core(AUTO, True) == CORES[-1]
    for wanted, is_gpu in ((AUTO, False), (ANY, True), (ANY, False)):
        assert choose_core(wanted, is_gpu) is None
    assert choose_core(CORES[0], False) == CORES[0]
    with pytest.raises(TrackingError, match="--core: expected one of .*, found 4321"):
        choose_core(4321, True)


def test_afterwards_there_are_all_cores_again_whatever_happens():
    with pytest.raises(ValueError), on_core(CORES[0]):
        assert os.sched_getaffinity(0) == {CORES[0]}
        raise ValueError
    with on_core(None):
        assert list_cores() == CORES
    assert list_cores() == CORES
