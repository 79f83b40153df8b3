"""How often the rule of scripts/nightly.sh errs, in a small seeded simulation from real replays."""

import pathlib
import subprocess
import sys

import pytest

np = pytest.importorskip("numpy", reason="needs python3-numpy")

import made_up_nights  # noqa: E402
from tracking import simulate as module  # noqa: E402
from tracking.history import append  # noqa: E402
from tracking.simulate import (Group, Setting, read_groups,  # noqa: E402
                               read_reference_groups, share_of_cells, share_of_nights, simulate)
from tracking.timing import (FAST, SAME, SLOW, Rule, confirm,  # noqa: E402
                             judge_history)

ROOT = pathlib.Path(__file__).resolve().parents[2]
RULE = Rule()


@pytest.fixture(scope="module")
def groups():
    return read_reference_groups(ROOT)


@pytest.fixture(scope="module")
def unchanged(groups):
    return simulate(groups, 0.0, Setting(nights=200), RULE)


def test_there_are_real_replays_enough(groups):
    assert sum(len(group.deviations) for group in groups) >= 30
    for group in groups:
        assert np.mean(group.deviations) == pytest.approx(0, abs=1e-12)


def test_of_the_same_build_at_most_one_night_in_a_hundred_is_slow(unchanged):
    slow, fast = share_of_nights(unchanged, SLOW), share_of_nights(unchanged, FAST)
    assert slow <= 0.01 and fast <= 0.01
    assert abs(slow - fast) <= 0.01


def test_larger_slowdowns_are_found_more_often_and_never_called_fast(groups):
    found = []
    for change in (0.02, 0.05, 0.10, 0.20):
        nights = simulate(groups, change, Setting(nights=60), RULE)
        found.append(share_of_cells(nights, SLOW))
        assert share_of_cells(nights, FAST) == 0
    assert found == sorted(found)
    assert found[1] > 0.15 and found[2] > 0.75 and found[3] > 0.95


def test_a_quieter_machine_tells_more(groups):
    """With a fifth of the noise of these replays 5 % are always found, and as fast is SAME."""
    quiet = [Group(g.name, tuple(d / 5 for d in g.deviations)) for g in groups]
    setting = Setting(nights=60)
    assert share_of_cells(simulate(quiet, 0.05, setting, RULE), SLOW) >= 0.95
    assert share_of_cells(simulate(quiet, 0.0, setting, RULE), SAME) >= 0.95


def test_measuring_again_is_what_keeps_false_alarms_away(groups, monkeypatch, unchanged):
    monkeypatch.setattr(module, "confirm", lambda first, second: first)
    careless = simulate(groups, 0.0, Setting(nights=200), RULE)
    assert share_of_nights(careless, SLOW) > 0.02 > share_of_nights(unchanged, SLOW)


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


def test_the_table_is_printed():
    done = subprocess.run([sys.executable, ROOT / "scripts/nightly_rates.py", "--nights", "3",
                           "--repetitions", "9", "--min-change", "3"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert len([line for line in done.stdout.splitlines() if line.startswith("| as")]) == 2


def test_nights_of_a_history_are_drawn_from(tmp_path):
    night = made_up_nights.make_night(1)
    night["timing"] = made_up_nights.make_times(base=[10.0, 11.0, 12.0], new=[20.0, 20.0, 20.0])
    path = append(tmp_path, made_up_nights.KEY, night, "a")
    append(tmp_path, made_up_nights.KEY, made_up_nights.make_acceptance(2, path.stem), "accept")
    (path.parent / "damaged.json").write_text("{", encoding="utf-8")
    (group,) = read_groups(tmp_path)
    assert len(group.deviations) == 3 and group.deviations[2] > 0.09 > group.deviations[0]


def test_too_few_replays_are_refused(tmp_path):
    done = subprocess.run([sys.executable, ROOT / "scripts/nightly_rates.py", tmp_path],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
