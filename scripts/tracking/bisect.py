"""Where along a line of commits the times of cells changed: which commit to try next, and on whose
side a commit that was tried is.

Commits are numbered from 0, the good one, to the last one, the bad one. Nothing is measured here.
"""

import math

from . import timing
from .statistics import compute_paired_mann_whitney

ON_GOOD, ON_BAD = "good", "bad"
SIDE_ALPHA = 0.05


def choose_quantity(result):
    """The quantity that made a cell SLOW or FAST, of its CellResult: the frame's time if it is so
    itself, else the stage whose change is the largest part of a frame."""
    if result.quantities[timing.FRAME].verdict == result.verdict.verdict:
        return timing.FRAME
    return result.decided_by


def decide(probe, bad, ratios=()):
    """ON_GOOD, ON_BAD, or None if it cannot be told: on whose side a commit is. Both are Verdicts
    of the same quantity against the good commit, `bad` (SLOW or FAST) that of the bad one; probe
    may be None. ratios: of all pairs that were measured of it, to the good commit.

    A verdict that is the bad one's puts it on that side. Else its interval does, if it does not
    contain the middle between no change and the bad one's, or the U test of the pairs against that
    middle; then SAME is on the good one's side.
    """
    if probe is None or probe.change is None:
        return None
    if probe.verdict == bad.verdict:
        return ON_BAD
    sign = math.copysign(1, bad.change)
    low, high = sorted((sign * probe.low, sign * probe.high))
    middle = abs(bad.change) / 2
    if high < middle:
        return ON_GOOD
    if low > middle:
        return ON_BAD
    if len(ratios) > 0:
        test = compute_paired_mann_whitney([ratio / (1 + bad.change / 2) for ratio in ratios])
        if test.p < SIDE_ALPHA:
            return ON_BAD if (test.a12 > 0.5) == (bad.change > 0) else ON_GOOD
    return ON_GOOD if probe.verdict == timing.SAME else None


class Search:
    """For the first commit on the bad one's side, of one cell."""

    def __init__(self, last):
        """last: the number of the bad commit, 1 or more."""
        self.good, self.bad = 0, last  # the nearest that are known
        self._skipped = set()

    def choose(self):
        """The commit to try next; None when there is none left."""
        untried = self._list_untried()
        # Commits that cannot be judged are often neighbours: after each the next one is elsewhere.
        skipped = sum(self.good < number < self.bad for number in self._skipped)
        return untried[int(len(untried) * _spread(skipped))] if untried else None

    def wants(self, number):
        """Whether it would help to know on whose side a commit is."""
        return self.good < number < self.bad and number not in self._skipped

    def record(self, number, side):
        """What decide() said of a commit that it wants; None skips it."""
        if side == ON_GOOD:
            self.good = number
        elif side == ON_BAD:
            self.bad = number
        else:
            self._skipped.add(number)

    def list_candidates(self):
        """The commits one of which is the first on the bad one's side; one, unless the search goes
        on or commits were skipped."""
        return list(range(self.good + 1, self.bad + 1))

    def count_steps(self):
        """About how many commits are yet to be tried."""
        return len(self._list_untried()).bit_length()

    def _list_untried(self):
        return [number for number in range(self.good + 1, self.bad) if self.wants(number)]


def search_all(searches, judge):
    """Ends all searches, {cell: Search}. judge(number, cells, steps) tries a commit, and gives
    {cell: side} as decide() does; cells are all those that want to know, and steps is about how
    many are to be tried, with this one. No commit is tried twice."""
    while True:
        number = next((found for found in (search.choose() for search in searches.values())
                       if found is not None), None)
        if number is None:
            return
        cells = [cell for cell, search in searches.items() if search.wants(number)]
        sides = judge(number, cells, count_steps(searches.values()))
        for cell in cells:
            searches[cell].record(number, sides[cell])


def count_steps(searches):
    """Of several searches; those in the same range try the same commits."""
    return sum({(search.good, search.bad): search.count_steps() for search in searches}.values())


def _spread(count):
    """1/2, 1/4, 3/4, 1/8, 5/8, ...: the van der Corput sequence, from 0 on."""
    count, share, value = count + 1, 0.5, 0.0
    while count:
        value += share * (count & 1)
        count, share = count >> 1, share / 2
    return value
