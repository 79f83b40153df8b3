"""Change points of the nightly trends: tracking/change_points.py."""

import itertools

import pytest

np = pytest.importorskip("numpy", reason="needs python3-numpy")

from tracking.change_points import (ChangePoint, cut, drop_outliers,  # noqa: E402
                                    find_change_points, find_steps)

NIGHTS = 60


def make_noise(seed, count=NIGHTS, spread=0.01):
    return 20 * np.exp(np.random.default_rng(seed).normal(0, spread, count))


def places(values):
    return [point.index for point in find_change_points(values)]


@pytest.mark.parametrize("find", [find_steps, find_change_points])
@pytest.mark.parametrize("count", [0, 1, 2, 11, 12, 60, 400])
def test_a_constant_series_has_none(find, count):
    assert find([3.25] * count) == []
    assert find([None] * count) == []


@pytest.mark.parametrize("at", [3, 10, 30, 57])
@pytest.mark.parametrize("factor", [0.8, 1.1])
def test_one_clear_step_is_found_where_it_is(at, factor):
    for seed in range(10):
        values = make_noise(seed)
        values[at:] *= factor
        (point,) = find_change_points(values)
        assert point.index == at
        assert point.after / point.before == pytest.approx(factor, rel=0.03)


def test_both_of_two_steps_are_found():
    for seed in range(10):
        values = make_noise(seed)
        values[20:] *= 1.1
        values[33:] *= 0.93
        assert places(values) == [20, 33]


def test_steps_without_noise_are_found_where_they_are():
    values = [5.0] * 10 + [5.01] * 8 + [4.0] * 12
    found = find_change_points(values)
    assert [point.index for point in found] == [10, 18]
    assert found[0].before == pytest.approx(5) and found[1].after == pytest.approx(4)
    assert find_steps(values) == [ChangePoint(10, 5.0, 5.01), ChangePoint(18, 5.01, 4.0)]


@pytest.mark.parametrize("count, most", [(12, 0.15), (20, 0.12), (60, 0.05), (400, 0.02)])
def test_noise_has_hardly_any(count, most):
    runs = 100
    false = sum(bool(places(make_noise(seed, count))) for seed in range(runs))
    assert false <= most * runs


def test_a_bad_night_is_no_change():
    for seed in range(20):
        values = make_noise(seed)
        values[15] *= 2
        values[59] *= 3
        assert places(values) == []


def test_nights_without_a_value_change_nothing():
    rng = np.random.default_rng(4)
    for seed in range(10):
        values = make_noise(seed)
        values[30:] *= 1.1
        expected = places(values)
        assert expected == [30]
        for absent in (None, float("nan"), float("inf")):
            spread, at = [], {}
            for index, value in enumerate(values):
                spread += [absent] * int(rng.integers(0, 3))
                at[index] = len(spread)
                spread.append(value)
            assert places(spread) == [at[index] for index in expected]


def test_scale_and_direction_do_not_matter():
    values = make_noise(7)
    values[25:] *= 1.08
    assert places(values) == places(values * 1e-6) == [25]
    assert places(values[::-1]) == [NIGHTS - 25]
    assert places(1 / values) == [25]


def cost_of(values, cuts, price):
    bounds = [0, *cuts, len(values)]
    parts = [values[a:b] for a, b in zip(bounds, bounds[1:])]
    return price * len(cuts) + sum(np.square(p - p.mean()).sum() + np.log(len(p)) for p in parts)


@pytest.mark.parametrize("shortest", [1, 2, 3])
def test_no_other_segments_are_cheaper(shortest):
    """Pruning loses nothing: against all ways to cut."""
    rng = np.random.default_rng(shortest)
    for _ in range(20):
        values = rng.normal(0, 1, 11) + 4 * (np.arange(11) >= rng.integers(1, 11))
        for price in (0.5, 3.0, 7.0):
            found = cut(values, price, shortest)
            ways = (c for k in range(5) for c in itertools.combinations(range(1, 11), k)
                    if all(b - a >= shortest for a, b in zip((0, *c), (*c, 11))))
            least = min(cost_of(values, c, price) for c in ways)
            assert cost_of(values, found, price) <= least + 1e-9
            assert all(b - a >= shortest for a, b in zip((0, *found), (*found, 11)))


def test_only_what_stands_out_is_dropped():
    values = np.array([0.0, 1, 0, 100, 1, 1, 0, 50, 50, 50, 50])
    kept = drop_outliers(values, 1.0)
    assert kept[3] == 1.0 and list(kept[7:]) == [50] * 4
    assert list(kept[:3]) == [0, 1, 0]
