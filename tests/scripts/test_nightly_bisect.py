"""The search of scripts/nightly.sh --bisect, and what decides it; nothing is built or run."""

import math

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")

from made_up_nights import make_verdict as verdict  # noqa: E402
from tracking.bisect import ON_BAD, ON_GOOD, Search, choose_quantity, decide  # noqa: E402
from tracking.bisect import search_all  # noqa: E402
from tracking.timing import FAST, SAME, SLOW, UNCLEAR  # noqa: E402
from tracking.timing_tier import CellResult  # noqa: E402


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


@pytest.mark.parametrize("sign", [1, -1])
def test_the_pairs_tell_where_the_interval_does_not(sign):
    """Of all attempts together, against the middle."""
    bad = verdict(SLOW if sign > 0 else FAST, *sorted((0.08 * sign, 0.12 * sign)))
    wide = verdict(UNCLEAR, -0.06, 0.06)

    def pairs(*changes):
        return [1 + sign * change / 100 for change in changes]

    near_good = pairs(-6, -4, -2, -1, 0, 1, 2, 4, 6)
    near_bad = pairs(4, 6, 8, 9, 10, 11, 12, 14, 16)
    assert decide(wide, bad, near_good) == ON_GOOD
    assert decide(wide, bad, near_bad) == ON_BAD
    assert decide(wide, bad, pairs(1, 3, 5, 7, 9)) is None
    assert decide(wide, bad, near_good[:3]) is None  # three are too few for any p below 0.05
    assert decide(wide, bad) is None


def test_what_was_not_measured_decides_nothing():
    assert decide(None, verdict(SLOW, 0.1, 0.2)) is None


def test_the_stage_decides_where_the_frame_did_not():
    slow, unclear = verdict(SLOW, 0.1, 0.2), verdict(UNCLEAR, -0.1, 0.2)
    for frame, expected in ((slow, "frame"), (unclear, "query")):
        result = CellResult(slow, {}, {"frame": frame, "query": slow}, "query")
        assert choose_quantity(result) == expected
