"""Frame times to verdicts.

With a baseline, each repetition is a pair of runs, one right after the other. SLOW needs a U test
below alpha, an effect size of at least `effect`, and a median over pairs of at least `min_change`;
then it is measured again, and the second sample alone decides, by the same rule. FAST likewise, so
that neither is easier to get. Why so, and what it misses: docs/nightly.md.

Without one, tonight's values are compared with those of earlier nights, each in units of what the
calibration took that night. Values of one night share that night's luck, so nights are the unit:
their medians say how much nights differ.
"""

from dataclasses import asdict, dataclass

import numpy as np

from .statistics import (NORMAL_MAD, compute_change, compute_mann_whitney, compute_paired_change,
                         compute_spread)

SAME, FAST, SLOW, UNCLEAR = "SAME", "FAST", "SLOW", "UNCLEAR"
STAGES = ("draw_ms", "query_ms", "wait_ms", "traversal_ms")  # of a frame, beside each other
CPU = "cpu_ms"  # of the traversing thread, across them
MOST_NIGHTS = 20  # earlier nights that are compared with: the last ones
FEWEST_NIGHTS = 10
NIGHT_DEVIATIONS = 5  # how far out of the earlier nights' medians a night must lie; measuring again
# in the same night does not undo that night's luck, so that this alone keeps false alarms away


@dataclass(frozen=True)
class Rule:
    """What a verdict needs; shares, not per cent."""

    alpha: float = 0.05
    effect: float = 0.71
    min_change: float = 0.03
    most_spread: float = 0.15  # of the ratios of pairs, or of the calibration
    most_others: float = 0.25  # of the processors' time, used by other programs


@dataclass(frozen=True)
class Verdict:
    """Of one cell. change and its interval are relative, of frame times: above 0 is slower."""

    verdict: str
    reason: str
    change: float | None = None
    low: float | None = None
    high: float | None = None
    p: float | None = None
    a12: float | None = None

    def as_dict(self):
        return asdict(self)


def judge_pairs(base, new, rule):
    """A Verdict of one sample of pairs: frame times, ms, of equal number."""
    spread = compute_spread(np.asarray(new) / np.asarray(base))
    if spread > rule.most_spread:
        return Verdict(UNCLEAR, f"noisy machine: ratios of runs side by side spread by "
                                f"{_percent(spread)}, more than {_percent(rule.most_spread)}")
    return _judge(compute_paired_change(base, new), compute_mann_whitney(base, new), rule)


def _judge(change, test, rule):
    numbers = (change.value, change.low, change.high, test.p, test.a12)
    said = f"p = {test.p:.2g}, A12 = {test.a12:.2f}"
    is_significant = test.p < rule.alpha
    is_large = max(test.a12, 1 - test.a12) >= rule.effect
    is_change = abs(change.value) >= rule.min_change
    is_agreed = (change.value > 0) == (test.a12 > 0.5)
    if is_significant and is_large and is_change and is_agreed:
        return Verdict(SLOW if change.value > 0 else FAST, said, *numbers)
    most = f"+-{_percent(rule.min_change)}"
    if -rule.min_change <= change.low and change.high <= rule.min_change:
        return Verdict(SAME, f"interval within {most}", *numbers)
    if not is_significant:
        return Verdict(UNCLEAR, f"p = {test.p:.2g}, and the interval reaches beyond {most}",
                       *numbers)
    if not is_large:
        return Verdict(UNCLEAR, f"{said}: no effect of {rule.effect:g}", *numbers)
    if not is_change:
        return Verdict(UNCLEAR, f"{said}, a change within {most}, but the interval reaches beyond",
                       *numbers)
    return Verdict(UNCLEAR, f"{said}, but pairs and samples go different ways", *numbers)


def confirm(first, second):
    """The Verdict of a cell that was SLOW or FAST at first and was measured again: the second
    sample's, which nobody has selected. Its size is no winner's curse either."""
    if second.verdict in (first.verdict, SAME):
        return Verdict(second.verdict, f"{second.reason}, measured again after {first.verdict}",
                       *_numbers(second))
    said = (second.reason if second.verdict == UNCLEAR
            else f"{second.verdict}, {second.reason}")
    return Verdict(UNCLEAR, f"{first.verdict} at first, not when measured again: {said}",
                   *_numbers(second))


def _numbers(verdict):
    return verdict.change, verdict.low, verdict.high, verdict.p, verdict.a12


def judge_history(nights, tonight, rule):
    """A Verdict of tonight's normalised frame times against those of earlier nights, oldest first,
    a list of samples."""
    nights = nights[-MOST_NIGHTS:]
    if len(nights) < FEWEST_NIGHTS:
        return Verdict(UNCLEAR, f"expected {FEWEST_NIGHTS} earlier nights to compare with, "
                                f"found {len(nights)}")
    medians = np.log([np.median(night) for night in nights])
    middle = np.median(medians)
    spread = NORMAL_MAD * np.median(np.abs(medians - middle))
    verdict = _judge(compute_change(np.concatenate(nights), tonight),
                     compute_mann_whitney(np.concatenate(nights), tonight), rule)
    distance = abs(np.log(np.median(tonight)) - middle)
    limit = max(NIGHT_DEVIATIONS * spread, np.log1p(rule.min_change))
    if verdict.verdict in (SLOW, FAST) and distance < limit:
        return Verdict(UNCLEAR, f"{verdict.reason}, but nights differ as much: their medians "
                                f"spread by {_percent(spread)}", *_numbers(verdict))
    return verdict


def find_noise(rule, others=None, calibration=None):
    """Why the machine is too noisy for any verdict, or None. others: share of the processors' time
    that other programs used. calibration: seconds, several of the same night."""
    if others is not None and others > rule.most_others:
        return (f"noisy machine: other programs used {_percent(others)} of the processors, more "
                f"than {_percent(rule.most_others)}")
    if calibration and compute_spread(calibration) > rule.most_spread:
        return (f"noisy machine: the calibration spread by {_percent(compute_spread(calibration))},"
                f" more than {_percent(rule.most_spread)}")
    return None


def find_stage(samples):
    """What took longer, of the stages of a frame, as one text; None if that is not known. samples:
    {"base": {stage: [ms]}, "new": ...}; the largest growth of a median."""
    base, new = samples.get("base") or {}, samples.get("new") or {}
    growth = {stage: float(np.median(new[stage]) - np.median(base[stage]))
              for stage in STAGES if new.get(stage) and base.get(stage)}
    stage = max(growth, key=growth.get, default=None)
    if stage is None or growth[stage] <= 0:
        return None
    return f"{stage} +{growth[stage]:.3g} ms"


def _percent(share):
    return f"{100 * share:.3g} %"
