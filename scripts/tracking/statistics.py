"""The few statistics that timing needs, as `hlodbench compare` has them (src/metrics).

They are here again because a night's samples are no two result folders: they are pairs of runs of
two programs, and values of other nights. tests/scripts/test_nightly_statistics.py holds them to the
definitions.
"""

import math
from dataclasses import dataclass

import numpy as np

MOST_EXACT = 60  # values of both samples together, or pairs; above, the normal approximation
RESAMPLES = 2000
CONFIDENCE = 0.95
NORMAL_MAD = 1.4826  # standard deviation over median absolute deviation, of a normal distribution


@dataclass(frozen=True)
class Test:
    """Two-sided Mann-Whitney U test, and the effect size of Vargha and Delaney."""

    p: float
    a12: float  # how likely a value of b is above one of a, ties counted half


def compute_mann_whitney(a, b):
    """Of two samples that are not empty. Exact up to MOST_EXACT values together, ties included: of
    all ways to deal the values, the share with a U as rare as ours on its side, times two."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    n, m = len(a), len(b)
    _, inverse, counts = np.unique(np.concatenate([a, b]), return_inverse=True, return_counts=True)
    ends = np.cumsum(counts)
    doubled = (2 * ends - counts + 1)[inverse]  # twice the middle rank, whole numbers
    sum_of_b = int(doubled[n:].sum())
    u = 0.5 * sum_of_b - 0.5 * m * (m + 1)
    if n + m <= MOST_EXACT:
        p = _exact_p(doubled, m, sum_of_b)
    else:
        p = _normal_p(u, n, m, float((counts.astype(float) ** 3 - counts).sum()))
    return Test(p, u / (n * m))


def compute_paired_mann_whitney(ratios):
    """The same of n pairs, new / base, above 0: of their logarithms, aligned by pair (what both of
    a pair have in common is taken off, [Hodges and Lehmann 1962]), so that pairs measured in
    different states of the machine compare. p: exact, of all 2^n ways to exchange new and base
    within pairs, which is all that chance may do to values that belong together; ties included."""
    logs = np.log(np.asarray(ratios, dtype=float))
    n = len(logs)
    _, inverse, counts = np.unique(np.abs(logs), return_inverse=True, return_counts=True)
    # Aligned values are +-logs / 2. One above 0 exceeds all of the other sample that are nearer to 0
    # than it, and likewise is exceeded by none of them: twice its rank less 1 in all.
    weights = (2 * np.cumsum(counts) - counts)[inverse]
    u = float(weights[logs > 0].sum() + 0.5 * weights[logs == 0].sum())
    moving = weights[logs != 0]
    ours = int(weights[logs > 0].sum())
    return Test((_exact_sign_p if n <= MOST_EXACT else _normal_sign_p)(moving, ours), u / n**2)


def _exact_sign_p(weights, ours):
    chances = np.zeros(int(weights.sum()) + 1)  # of each sum, where every weight counts or does not
    chances[0] = 1
    for weight in map(int, weights):
        chances[weight:] += chances[: len(chances) - weight].copy()
        chances /= 2
    return min(1.0, 2 * min(chances[: ours + 1].sum(), chances[ours:].sum()))


def _normal_sign_p(weights, ours):
    variance = float((weights.astype(float) ** 2).sum()) / 4
    if variance <= 0:
        return 1.0
    return math.erfc(max(0.0, abs(ours - weights.sum() / 2) - 0.5) / math.sqrt(2 * variance))


def _exact_p(doubled, chosen, ours):
    ways = np.zeros((chosen + 1, int(doubled.sum()) + 1))
    ways[0, 0] = 1
    for rank in map(int, doubled):
        for k in range(chosen, 0, -1):
            ways[k, rank:] += ways[k - 1, : ways.shape[1] - rank]
    last = ways[chosen]
    return min(1.0, 2 * min(last[: ours + 1].sum(), last[ours:].sum()) / last.sum())


def _normal_p(u, n, m, ties):
    count = n + m
    variance = n * m / 12 * (count + 1 - ties / (count * (count - 1)))
    if variance <= 0:
        return 1.0  # all values are equal
    return math.erfc(max(0.0, abs(u - 0.5 * n * m) - 0.5) / math.sqrt(2 * variance))


@dataclass(frozen=True)
class Change:
    """A relative change, 0.03 for 3 % more, with a percentile bootstrap interval."""

    value: float
    low: float
    high: float


def compute_paired_change(ratios, seed=1):
    """The median over pairs, new / base, less 1; pairs are resampled. Values above 0."""
    logs = np.log(np.asarray(ratios, dtype=float))
    drawn = logs[_draw(seed, len(logs))]
    return _make_change(np.median(logs), np.median(drawn, axis=1))


def compute_change(base, new, seed=1):
    """The ratio of the medians, less 1; each sample is resampled by itself. Values above 0."""
    base, new = np.log(np.asarray(base, dtype=float)), np.log(np.asarray(new, dtype=float))
    drawn = (np.median(new[_draw(seed + 1, len(new))], axis=1)
             - np.median(base[_draw(seed, len(base))], axis=1))
    return _make_change(np.median(new) - np.median(base), drawn)


def compute_interval(values, seed=1):
    """(median, low, high) of a sample, with a percentile bootstrap interval. Values above 0."""
    logs = np.log(np.asarray(values, dtype=float))
    change = _make_change(np.median(logs), np.median(logs[_draw(seed, len(logs))], axis=1))
    return 1 + change.value, 1 + change.low, 1 + change.high


def compute_spread(values):
    """A robust standard deviation of the values' logarithms, which is a relative one: 0.05 is 5 %."""
    logs = np.log(np.asarray(values, dtype=float))
    return float(NORMAL_MAD * np.median(np.abs(logs - np.median(logs))))


def _draw(seed, count):
    return np.random.default_rng(seed).integers(0, count, (RESAMPLES, count))


def _make_change(value, resamples):
    tail = (1 - CONFIDENCE) / 2
    low, high = np.quantile(resamples, (tail, 1 - tail))
    return Change(*(float(math.expm1(v)) for v in (value, low, high)))
