"""Where a series of nights changes its level: change points.

PELT [KFE]: of all ways to cut the series into segments, the one whose segments are closest to their
means, at a price for each cut. The price is the modified BIC [ZS]: 3 log n a cut, and the logarithm
of each segment's length. The noise is the robust one of the differences between neighbours, which a
few steps do not enlarge; what stands out of the median of five neighbours by more than five of it
is replaced by that (a Hampel filter [H]), so that one bad night is no change.

[KFE] R. Killick, P. Fearnhead, I. A. Eckley: Optimal Detection of Changepoints With a Linear
      Computational Cost. Journal of the American Statistical Association 107, 2012.
[ZS]  N. R. Zhang, D. O. Siegmund: A Modified Bayes Information Criterion with Applications to the
      Analysis of Comparative Genomic Hybridization Data. Biometrics 63, 2007.
[H]   F. R. Hampel: The Influence Curve and Its Role in Robust Estimation. Journal of the American
      Statistical Association 69, 1974.
"""

from dataclasses import dataclass

import numpy as np

from .statistics import NORMAL_MAD

FEWEST_NIGHTS = 12  # fewer tell too little of the noise
FEWEST_IN_SEGMENT = 3
NEIGHBOURS = 2  # on either side
MOST_DEVIATIONS = 5
LEAST_NOISE = 1e-6  # relative: a series that only steps has no noise at all


@dataclass(frozen=True)
class ChangePoint:
    """A change of level."""

    index: int  # of the first value of the new level, in the series that was given
    before: float  # the levels
    after: float


def find_steps(values):
    """ChangePoints of a series without noise: every value that is not the one before. None and NaN
    are nights without a value."""
    values = _to_array(values)
    found, last = [], None
    for index in np.flatnonzero(np.isfinite(values)):
        if last is not None and values[index] != last:
            found.append(ChangePoint(int(index), float(last), float(values[index])))
        last = values[index]
    return found


def find_change_points(values):
    """ChangePoints of a series with noise, values above 0; levels are geometric means. None and NaN
    are nights without a value."""
    values = _to_array(values)
    places = np.flatnonzero(np.isfinite(values))
    if len(places) < FEWEST_NIGHTS:
        return []
    scale = float(np.median(values[places]))
    logs = np.log(values[places] / scale)  # near 0, where squares lose nothing
    noise = max(NORMAL_MAD * float(np.median(np.abs(np.diff(logs)))) / np.sqrt(2), LEAST_NOISE)
    logs = drop_outliers(logs, noise)
    cuts = cut(logs / noise, 3 * np.log(len(logs)), FEWEST_IN_SEGMENT)
    bounds = [0, *cuts, len(logs)]
    levels = [scale * float(np.exp(logs[a:b].mean())) for a, b in zip(bounds, bounds[1:])]
    return [ChangePoint(int(places[at]), before, after)
            for at, before, after in zip(cuts, levels, levels[1:])]


def drop_outliers(values, noise):
    """The values, with their neighbours' median for those that are more than MOST_DEVIATIONS of the
    noise from it. Steps of more than NEIGHBOURS values stay where they are."""
    kept = np.array(values, dtype=float)
    for i, value in enumerate(values):
        middle = np.median(values[max(0, i - NEIGHBOURS) : i + NEIGHBOURS + 1])
        if abs(value - middle) > MOST_DEVIATIONS * noise:
            kept[i] = middle
    return kept


def cut(values, price, shortest):
    """Where segments begin, but for the first: indices, rising. values: in units of the noise.
    price: of a cut. shortest: values in a segment, at least."""
    count = len(values)
    sums = np.concatenate([[0.0], np.cumsum(values)])
    squares = np.concatenate([[0.0], np.cumsum(np.square(values))])
    best = np.full(count + 1, np.inf)  # cost of the first so many values
    best[0] = -price
    previous = np.zeros(count + 1, dtype=int)
    starts = np.array([], dtype=int)  # where the last segment can begin
    # A segment's cost can fall below that of its two parts by this much, of their log lengths.
    slack = np.log(count)
    for end in range(shortest, count + 1):
        begin = end - shortest
        if np.isfinite(best[begin]):
            starts = np.append(starts, begin)
        length = end - starts
        sum_ = sums[end] - sums[starts]
        costs = (best[starts] + squares[end] - squares[starts] - sum_ * sum_ / length
                 + np.log(length))
        least = int(np.argmin(costs))
        best[end], previous[end] = costs[least] + price, starts[least]
        starts = starts[costs - slack <= best[end]]
    found, end = [], count
    while previous[end] > 0:
        end = int(previous[end])
        found.append(end)
    return found[::-1]


def _to_array(values):
    return np.array([np.nan if value is None else value for value in values], dtype=float)
