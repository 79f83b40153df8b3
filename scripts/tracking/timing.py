"""Frame times to verdicts.

With a baseline, each repetition is a pair of replays, and the ratios new / base of the frame's time
and of its stages are judged, each by itself. SLOW needs a U test below alpha, an effect size of at
least `effect`, and a median over pairs of at least `min_change`; then it is measured again, and the
second sample alone decides, by the same rule. FAST likewise, so that neither is easier to get. Why
so, and what it misses: docs/nightly.md.

Without one, tonight's values are compared with those of earlier nights, each in units of what the
calibration took that night. Values of one night share that night's luck, so nights are the unit:
their medians say how much nights differ.
"""

from dataclasses import asdict, dataclass, replace

import numpy as np

from .statistics import (NORMAL_MAD, compute_change, compute_mann_whitney, compute_paired_change,
                         compute_paired_mann_whitney, compute_spread)

SAME, FAST, SLOW, UNCLEAR = "SAME", "FAST", "SLOW", "UNCLEAR"
FRAME, TRAVERSAL = "frame", "traversal"
# Of a frame, beside each other, and the columns of the frame log that are their time. Waiting for
# results is part of handling queries: what is asked earlier is waited for longer.
STAGES = {"draw": ("draw_ms",), "query": ("query_ms", "wait_ms"),
          TRAVERSAL: ("traversal_ms",)}
MOST_NIGHTS = 20  # earlier nights that are compared with: the last ones
FEWEST_NIGHTS = 10
NIGHT_DEVIATIONS = 5  # how far out of the earlier nights' medians a night must lie; measuring again
# in the same night does not undo that night's luck, so that this alone keeps false alarms away


@dataclass(frozen=True)
class Rule:
    """What a verdict needs; shares, not per cent."""

    alpha: float = 0.02
    effect: float = 0.71
    min_change: float = 0.015
    min_traversal: float | None = None  # the same of the traversal alone; None: min_change
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


def judge_pairs(ratios, rule):
    """A Verdict of one sample of pairs: new / base."""
    spread = compute_spread(ratios)
    if spread > rule.most_spread:
        return Verdict(UNCLEAR, f"noisy machine: ratios of runs side by side spread by "
                                f"{_percent(spread)}, more than {_percent(rule.most_spread)}")
    return _judge(compute_paired_change(ratios), compute_paired_mann_whitney(ratios), rule)


def judge_quantities(ratios, rule):
    """{quantity: Verdict} of {quantity: [new / base]}."""
    rules = {}
    if rule.min_traversal is not None:
        rules[TRAVERSAL] = replace(rule, min_change=rule.min_traversal)
    return {quantity: judge_pairs(values, rules.get(quantity, rule))
            for quantity, values in ratios.items()}


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


def confirm_quantities(first, second):
    """{quantity: Verdict} of a cell that was measured again. What was neither SLOW nor FAST at
    first does not become so by the second sample alone."""
    made = {}
    for quantity, verdict in first.items():
        again = second.get(quantity, Verdict(UNCLEAR, "not measured again"))
        if is_change(again) and not is_change(verdict):
            made[quantity] = verdict
        else:
            made[quantity] = confirm(verdict, again) if is_change(verdict) else again
    return made


def is_change(verdict):
    return verdict.verdict in (SLOW, FAST)


def combine(verdicts, means):
    """The Verdict of a cell, with the numbers of its frame time, and the quantity that decided:
    FRAME or a stage. verdicts: of its quantities; SLOW if one is, else FAST if one is. means: {stage:
    ms}, of the baseline, so that of several stages the one is named whose change is the largest
    part of a frame."""
    frame = verdicts[FRAME]
    for kind in (SLOW, FAST):
        stages = [q for q, v in verdicts.items() if q != FRAME and v.verdict == kind]
        stage = max(stages, key=lambda q: abs(verdicts[q].change) * means.get(q, 0), default=None)
        if frame.verdict == kind:
            return frame, stage
        if stage:
            reason = f"{stage}: {verdicts[stage].reason}"
            return Verdict(kind, reason, *_numbers(frame)), stage
    return frame, None


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


def describe_change(change, low, high):
    """A change and its interval, shares, in per cent."""
    return f"{100 * change:+.1f} % [{100 * low:+.1f}, {100 * high:+.1f}]"


def _percent(share):
    return f"{100 * share:.3g} %"
