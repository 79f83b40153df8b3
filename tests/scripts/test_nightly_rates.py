"""How often the rule of scripts/nightly.sh errs, in a small seeded simulation from real pairs."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

np = pytest.importorskip("numpy", reason="needs python3-numpy")

import fake_nightly  # noqa: E402
import made_up_nights  # noqa: E402
from tracking import simulate as module  # noqa: E402
from tracking.core import list_cores  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402
from tracking.history import append  # noqa: E402
from tracking.simulate import (SAME_BUILD, Group, Setting, read_history_groups,  # noqa: E402
                               read_pairs, share_of_cells, share_of_nights, share_of_stage,
                               simulate, slow_down)
from tracking.timing import FAST, SAME, SLOW, UNCLEAR, Rule, confirm, judge_history  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAIRS = ROOT / "results/reference/llvmpipe/nightly/pairs.json"
RULE = Rule()
STAGES = ("draw", "query", "traversal")


@pytest.fixture(scope="module")
def pairs():
    return read_pairs(PAIRS)


@pytest.fixture(scope="module")
def same(pairs):
    return [group for group in pairs if group.slowdown == SAME_BUILD]


@pytest.fixture(scope="module")
def unchanged(same):
    return simulate(same, Setting(nights=200), RULE)


def test_there_are_real_pairs_enough(pairs, same):
    assert sum(map(len, same)) >= 30
    for group in pairs:
        assert {len(values) for values in group.ratios.values()} == {len(group)}
        assert set(group.ratios) == {"frame", *STAGES}


def test_of_the_same_build_at_most_one_night_in_a_hundred_is_slow(unchanged):
    slow, fast = share_of_nights(unchanged, SLOW), share_of_nights(unchanged, FAST)
    assert slow <= 0.01 and fast <= 0.01


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("share, least", [(2, 0.3), (5, 0.95), (10, 1.0)])
def test_slowdowns_of_the_program_are_found_and_their_stage_is_named(pairs, stage, share, least):
    groups = [group for group in pairs if group.slowdown == f"{stage}={share}"]
    nights = simulate(groups, Setting(nights=60), RULE)
    assert share_of_cells(nights, SLOW) >= least
    assert share_of_cells(nights, FAST) == 0
    assert share_of_stage(nights, SLOW, stage) >= 0.95


def test_measuring_again_is_what_keeps_false_alarms_away(same, monkeypatch, unchanged):
    monkeypatch.setattr(module, "confirm_quantities", lambda first, second: first)
    # with no least change, which keeps most of them away by itself
    rule = Rule(min_change=0.0, alpha=0.05)
    careless = share_of_nights(simulate(same, Setting(nights=200), rule), SLOW)
    monkeypatch.undo()
    careful = share_of_nights(simulate(same, Setting(nights=200), rule), SLOW)
    assert careless > 3 * careful


def test_a_quieter_machine_tells_more(same):
    quiet = [Group(g.cell, "", {q: v ** 0.2 for q, v in g.ratios.items()}, g.means) for g in same]
    nights = simulate(quiet, Setting(nights=60), RULE)
    assert share_of_cells(nights, SAME) >= 0.95 and share_of_cells(nights, UNCLEAR) <= 0.05


@pytest.mark.parametrize("between", [0.0, 0.02, 0.05])
def test_nights_that_differ_by_themselves_are_seldom_slow(between):
    """Without a baseline; there are no real nights yet, so these are made up."""
    rng = np.random.default_rng(1)

    def measure(luck):
        return np.exp(rng.normal(luck, 0.05, 9))

    slow = 0
    for _ in range(150):
        luck = rng.normal(0, between)
        earlier = [list(measure(rng.normal(0, between))) for _ in range(20)]
        first, second = (judge_history(earlier, measure(luck), RULE) for _ in range(2))
        slow += first.verdict == SLOW and confirm(first, second).verdict == SLOW
    assert slow <= 1


def rates(*arguments):
    return subprocess.run([sys.executable, ROOT / "scripts/nightly_rates.py", *arguments],
                          capture_output=True, text=True, check=False)


def test_the_tables_are_printed():
    done = rates("--nights", "3")
    assert done.returncode == 0, done.stderr
    rows = [line for line in done.stdout.splitlines() if line.startswith("|")]
    assert len(rows) == 2 + 1 + 2 + 9


def test_nights_of_a_history_are_drawn_from(tmp_path):
    night = made_up_nights.make_night(1)
    night["timing"] = made_up_nights.make_times(base=[10.0] * 9, new=[20.0] * 9)
    ratios = [2.0, 2.1, 1.9] * 3
    (samples,) = night["timing"]["cells"].values()
    samples["ratios"] = {"frame": ratios, "draw": ratios}
    path = append(tmp_path, made_up_nights.KEY, night, "a")
    append(tmp_path, made_up_nights.KEY, made_up_nights.make_acceptance(2, path.stem), "accept")
    (path.parent / "damaged.json").write_text("{", encoding="utf-8")
    (group,) = read_history_groups(tmp_path)
    assert len(group) == 9 and np.median(group.ratios["frame"]) == 1
    assert np.median(slow_down(group, "", 0.1).ratios["draw"]) == pytest.approx(1.1)
    done = rates(tmp_path, "--nights", "3")
    assert done.returncode == 0 and "all by 5 %" in done.stdout


@pytest.mark.parametrize("content", ["{", "[]", '{"groups": [{"cell": "a"}]}', '{"groups": 5}'])
def test_what_is_no_file_of_pairs_is_refused_in_one_line(tmp_path, content):
    (tmp_path / "a.json").write_text(content, encoding="utf-8")
    with pytest.raises(TrackingError, match="a.json: expected pairs"):
        read_pairs(tmp_path / "a.json")
    done = rates(tmp_path / "a.json")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1


def test_too_few_pairs_are_refused(tmp_path):
    for source in (tmp_path, tmp_path / "none.json"):
        done = rates(source)
        assert done.returncode == 2 and len(done.stderr.splitlines()) == 1


def measure_pairs(folder, *arguments, **state):
    program = fake_nightly.add_program(folder / "hlodbench", **state)
    return subprocess.run([sys.executable, ROOT / "scripts/nightly_pairs.py", "--out",
                           folder / "pairs.json", "--program", program, *arguments],
                          env={**os.environ, "HLODBENCH_CACHE": str(folder / "cache")},
                          capture_output=True, text=True, check=False)


def test_pairs_are_measured_of_one_program_and_of_it_slowed_down(tmp_path):
    done = measure_pairs(tmp_path, "--same", "courtyard/bool", "--slowdown", "query=25",
                         "--repetitions", "2")
    assert done.returncode == 0, done.stderr
    groups = {(g.cell, g.slowdown): g for g in read_pairs(tmp_path / "pairs.json")}
    assert set(groups) == {("courtyard/coh-b", ""), ("courtyard/coh-b", "query=25"),
                           ("courtyard/bool", "")}
    for (_, slowdown), group in groups.items():
        assert len(group) == 2 and group.means["draw"] == pytest.approx(3, rel=0.02)
        assert np.median(group.ratios["query"]) == pytest.approx(1.25 if slowdown else 1, abs=0.02)
    assert list(tmp_path.glob("*.tmp")) == []


def test_pairs_of_a_program_that_draws_on_a_gpu_have_one_core(tmp_path):
    done = measure_pairs(tmp_path, "--same", "courtyard/bool", "--slowdown", "--repetitions", "1",
                         renderer="NVIDIA H200/PCIe/SSE2")
    assert done.returncode == 0, done.stderr
    cores = fake_nightly.read_timed_cores(tmp_path / "hlodbench")
    assert len(cores) == 4 and set(map(tuple, cores)) == {(list_cores()[-1],)}


def test_what_has_no_slowed_down_pairs_is_made_longer(tmp_path):
    groups = [{"cell": "courtyard/bool", "slowdown": "", "means": {"draw": 1.0},
               "ratios": {"frame": [1.001, 0.999, 1.0] * 3, "draw": [1.001, 0.999, 1.0] * 3}}]
    (tmp_path / "a.json").write_text(json.dumps({"groups": groups}), encoding="utf-8")
    done = rates(tmp_path / "a.json", "--nights", "3")
    assert done.returncode == 0, done.stderr
    assert "| all by 5 % | 9 | 9 | 1.5 % | 100 % | 0 % | – |" in done.stdout


def test_pairs_want_a_program_that_takes_turns(tmp_path):
    done = measure_pairs(tmp_path, turns=False)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "pairs.json").exists()
