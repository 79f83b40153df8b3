"""The statistics and the decision rule of scripts/nightly.sh."""

import itertools
import json
import os
import subprocess

import pytest

np = pytest.importorskip("numpy", reason="needs python3-numpy")

import fake_run  # noqa: E402
from tracking import statistics  # noqa: E402
from tracking.statistics import (compute_change, compute_mann_whitney,  # noqa: E402
                                 compute_paired_change, compute_paired_mann_whitney,
                                 compute_spread)
from tracking.timing import (FAST, FRAME, SAME, SLOW, UNCLEAR, Rule, Verdict,  # noqa: E402
                             combine, confirm, confirm_quantities, find_noise, judge_history,
                             judge_pairs, judge_quantities)

RULE = Rule()


def count_pairs(a, b):
    """Pairs with b above a, ties counted half: the definition of U."""
    return sum(1.0 if y > x else 0.5 if y == x else 0.0 for x in a for y in b)


def enumerate_p(a, b):
    """p by dealing the values to the samples in every way there is."""
    values, ours = [*a, *b], count_pairs(a, b)
    below = above = ways = 0
    for chosen in itertools.combinations(range(len(values)), len(b)):
        dealt = [values[i] for i in chosen]
        others = [v for i, v in enumerate(values) if i not in chosen]
        u = count_pairs(others, dealt)
        below, above, ways = below + (u <= ours), above + (u >= ours), ways + 1
    return min(1.0, 2 * min(below, above) / ways)


@pytest.mark.parametrize("levels", [2, 4, 1000])
def test_u_test_is_what_enumeration_says(levels):
    rng = np.random.default_rng(levels)
    for n, m in itertools.product((1, 2, 4, 5), repeat=2):
        a, b = rng.integers(0, levels, n), rng.integers(0, levels, m)
        test = compute_mann_whitney(a, b)
        assert test.p == pytest.approx(enumerate_p(a, b), abs=1e-12)
        assert test.a12 == pytest.approx(count_pairs(a, b) / (n * m))


@pytest.mark.parametrize("levels", [1, 4, 100])
@pytest.mark.parametrize("n", [1, 2, 5, 9])
def test_paired_u_test_is_what_exchanging_within_pairs_says(levels, n):
    """U as of any two samples, of values from which what a pair has in common is taken off."""
    rng = np.random.default_rng(levels * 10 + n)
    logs = rng.integers(-levels, levels + 1, n).astype(float)

    def compute_u(logs):
        return count_pairs(-logs / 2, logs / 2)

    ours = compute_u(logs)
    others = [compute_u(logs * signs) for signs in itertools.product((1, -1), repeat=n)]
    shares = [np.mean(np.less_equal(others, ours)), np.mean(np.greater_equal(others, ours))]
    test = compute_paired_mann_whitney(np.exp2(logs))  # of which ties are exact
    assert test.a12 == pytest.approx(ours / n**2)
    assert test.p == pytest.approx(min(1, 2 * min(shares)), abs=1e-12)


def test_paired_u_test_is_that_of_wilcoxon_for_nine_pairs():
    """The largest sum of ranks that is significant on both sides, from the published table: 5 of
    nine pairs at 0.05, 3 at 0.02; ours is twice the sum less the number of its terms."""
    for negatives, largest in (((1,), 0.02), ((3,), 0.02), ((5,), 0.05)):
        logs = np.arange(1, 10) / 100
        logs[[rank - 1 for rank in negatives]] *= -1
        assert compute_paired_mann_whitney(np.exp(logs)).p <= largest
    logs[5] *= -1
    assert compute_paired_mann_whitney(np.exp(logs)).p > 0.05


def test_paired_u_test_of_many_is_near_the_exact_one(monkeypatch):
    ratios = np.exp(np.random.default_rng(1).normal(0.004, 0.02, 40))
    exact = compute_paired_mann_whitney(ratios).p
    monkeypatch.setattr(statistics, "MOST_EXACT", 0)
    assert 0 < exact < 1 and compute_paired_mann_whitney(ratios).p == pytest.approx(exact, rel=0.1)
    assert compute_paired_mann_whitney(np.ones(40)).p == 1


@pytest.mark.parametrize("n, m, u", [(4, 4, 0), (5, 5, 2), (9, 9, 17), (20, 20, 127), (10, 20, 55)])
def test_u_test_has_the_published_critical_values(n, m, u):
    """The largest U that is significant on both sides at 0.05."""

    def p_of(u):
        places = list(range(m))
        for i in range(m - 1, -1, -1):  # b takes the lowest places, then moves up
            step = min(u, n)
            places[i] += step
            u -= step
        return compute_mann_whitney([p for p in range(n + m) if p not in places], places).p

    assert p_of(u) <= 0.05 < p_of(u + 1)


def test_normal_approximation_is_near_the_exact_one(monkeypatch):
    rng = np.random.default_rng(1)
    for levels in (5, 10000):
        a, b = rng.integers(0, levels, 30), rng.integers(0, levels, 30) + levels // 8
        exact = compute_mann_whitney(a, b).p
        monkeypatch.setattr(statistics, "MOST_EXACT", 0)
        assert compute_mann_whitney(a, b).p == pytest.approx(exact, rel=0.1)
        monkeypatch.undo()


def test_u_test_agrees_with_the_program(tmp_path):
    """`hlodbench compare`, where it has been built, of the same frame rates."""
    program = os.environ.get("HLODBENCH_EXE")
    if not program:
        pytest.skip("HLODBENCH_EXE names no program")
    folders = []
    for number in range(2):
        run = fake_run.make_run(tmp_path / str(number), ("coh-b",), frames=20, repetitions=6,
                                seed=number + 1)
        folders.append([case["summary"]["fps"] for case in run.data["cases"]])
    done = subprocess.run([program, "compare", tmp_path / "0", tmp_path / "1", "--format", "json"],
                          capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    rows = {row["key"]: row for row in json.loads(done.stdout)["pairs"][0]["rows"]}
    ours = compute_mann_whitney(*folders)
    assert rows["fps"]["p"] == pytest.approx(ours.p, rel=1e-9)
    assert rows["fps"]["a12"] == pytest.approx(ours.a12, rel=1e-9)


def test_changes_are_of_their_size_whatever_the_unit_and_what_meets_both_alike():
    rng = np.random.default_rng(1)
    base = 10 * rng.uniform(0.99, 1.01, 9)
    change = compute_paired_change(base * 1.05 / base)
    assert (change.value, change.low, change.high) == pytest.approx((0.05,) * 3)
    drift = np.linspace(1, 3, 9)
    noisy = base * rng.uniform(0.99, 1.01, 9)
    still, drifting = (compute_paired_change((noisy * d) / (base * d)) for d in (1, drift))
    assert still.value == pytest.approx(drifting.value) and still.low < still.value < still.high
    alone = compute_change(base, noisy * 1.05)
    scaled = compute_change(base * 1000, noisy * 1050)
    assert alone.value == pytest.approx(scaled.value) and alone.low == pytest.approx(scaled.low)
    assert alone.value == pytest.approx(np.median(noisy) * 1.05 / np.median(base) - 1)


def test_spread_is_a_relative_standard_deviation_that_one_outlier_does_not_move():
    values = np.exp(np.random.default_rng(1).normal(0, 0.05, 4000))
    assert compute_spread(values) == pytest.approx(0.05, rel=0.05)
    assert compute_spread([10, 10.1, 9.9, 10.05, 1000]) < 0.02


# The rule


def pairs(change, noise=0.005, seed=1, count=9):
    return (1 + change) * np.exp(np.random.default_rng(seed).normal(0, noise, count))


@pytest.mark.parametrize("change, verdict", [
    (0, SAME), (0.01, SAME), (-0.01, SAME), (0.03, SLOW), (-0.03, FAST), (0.5, SLOW)])
def test_clear_samples_have_clear_verdicts(change, verdict):
    assert judge_pairs(pairs(change), RULE).verdict == verdict


def test_slow_and_fast_are_mirror_images():
    mirror = {SLOW: FAST, FAST: SLOW, SAME: SAME, UNCLEAR: UNCLEAR}
    for seed in range(60):
        ratios = pairs(0.015, 0.015, seed)
        there, back = judge_pairs(ratios, RULE), judge_pairs(1 / ratios, RULE)
        assert there.p == back.p and there.a12 == pytest.approx(1 - back.a12)
        # the least change is relative to the other side, so that only it may differ a little
        if abs(abs(there.change) - RULE.min_change) > 0.001:
            assert UNCLEAR in (there.verdict, back.verdict) or back.verdict == mirror[there.verdict]


def test_every_verdict_has_a_reason():
    for change, noise in itertools.product((0, 0.015, 0.1), (0.001, 0.05, 0.4)):
        for seed in range(5):
            assert judge_pairs(pairs(change, noise, seed), RULE).reason


def test_the_traversal_may_have_a_least_change_of_its_own():
    ratios = {quantity: pairs(0.03) for quantity in (FRAME, "draw", "traversal")}
    assert {v.verdict for v in judge_quantities(ratios, RULE).values()} == {SLOW}
    found = judge_quantities(ratios, Rule(min_traversal=0.05))
    assert {q: v.verdict for q, v in found.items()} == {FRAME: SLOW, "draw": SLOW, "traversal": SAME}


def test_noise_is_never_slow():
    assert judge_pairs(pairs(1.0, 0.5), RULE).reason.startswith("noisy machine")
    assert "other programs" in find_noise(RULE, others=0.5)
    assert "calibration" in find_noise(RULE, others=0.0, calibration=[1, 1.5, 2])
    assert find_noise(RULE, others=0.1, calibration=[1, 1.01]) is None
    assert find_noise(RULE) is None


@pytest.mark.parametrize("first, second, expected", [
    (SLOW, SLOW, SLOW), (SLOW, SAME, SAME), (SLOW, FAST, UNCLEAR), (SLOW, UNCLEAR, UNCLEAR),
    (FAST, FAST, FAST), (FAST, SLOW, UNCLEAR), (FAST, SAME, SAME)])
def test_the_second_sample_decides(first, second, expected):
    made = confirm(Verdict(first, "a", 0.5), Verdict(second, "b", 0.1))
    assert made.verdict == expected and made.change == 0.1 and first in made.reason


def verdicts_of(**changes):
    """SLOW, FAST or SAME by their changes."""
    return {quantity: Verdict(SLOW if c > 0 else FAST if c < 0 else SAME, quantity, c, c, c, 0.0, 1.0)
            for quantity, c in changes.items()}


@pytest.mark.parametrize("changes, verdict, stage", [
    ({"frame": 0.1, "draw": 0.2, "query": 0.3, "traversal": 0}, SLOW, "draw"),
    ({"frame": 0.1, "draw": 0, "query": 0, "traversal": 0}, SLOW, None),
    ({"frame": 0, "draw": 0, "query": 0, "traversal": 0.1}, SLOW, "traversal"),
    ({"frame": 0, "draw": -0.1, "query": 0.1, "traversal": 0}, SLOW, "query"),
    ({"frame": -0.1, "draw": -0.2, "query": 0, "traversal": 0}, FAST, "draw"),
    ({"frame": -0.1, "draw": 0, "query": 0, "traversal": 0.1}, SLOW, "traversal"),
    ({"frame": 0, "draw": 0, "query": 0, "traversal": 0}, SAME, None),
    ({"frame": 0.1}, SLOW, None)])
def test_a_cell_is_as_slow_as_its_slowest_part_and_the_stage_is_named(changes, verdict, stage):
    """The stage is the one that adds most time, not that with the largest share."""
    found, named = combine(verdicts_of(**changes), {"draw": 10.0, "query": 1.0, "traversal": 0.1})
    assert (found.verdict, named) == (verdict, stage)
    assert found.change == changes[FRAME]  # the cell's numbers are those of its frames
    assert found.verdict == SAME or changes[FRAME] or found.reason.startswith(f"{stage}: ")


def test_what_only_the_second_sample_shows_is_not_said():
    first = verdicts_of(frame=0, draw=0.1, query=0.1)
    made = confirm_quantities(first, verdicts_of(frame=0.1, draw=0.1, query=0))
    assert {q: v.verdict for q, v in made.items()} == {"frame": SAME, "draw": SLOW, "query": SAME}
    assert confirm_quantities(first, {})["draw"].verdict == UNCLEAR


# Without a baseline


def nights(count, between=0.01, within=0.01, seed=1):
    rng = np.random.default_rng(seed)
    return [list(np.exp(rng.normal(rng.normal(0, between), within, 9))) for _ in range(count)]


@pytest.mark.parametrize("change, verdict", [(1.0, SAME), (1.15, SLOW), (0.87, FAST)])
def test_a_night_is_compared_with_earlier_nights(change, verdict):
    found = judge_history(nights(20), change * np.array(nights(1, 0, seed=2)[0]), RULE)
    assert found.verdict == verdict, found


def test_nights_that_differ_among_themselves_are_no_norm():
    found = judge_history(nights(20, between=0.1), 1.15 * np.array(nights(1, 0, seed=2)[0]), RULE)
    assert found.verdict == UNCLEAR


def test_few_nights_are_too_few():
    assert "earlier nights to compare with, found 4" in judge_history(nights(4), nights(1)[0], RULE).reason


def test_only_the_last_nights_count():
    old = [[v * 2 for v in night] for night in nights(30)]
    tonight = nights(1, 0, 0.002, seed=3)[0]
    assert judge_history(old + nights(20, 0.002, 0.002), tonight, RULE).verdict == SAME
