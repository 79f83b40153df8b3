"""The timing tier: measures cells, judges them, and measures again what seems to have changed."""

import statistics
from dataclasses import asdict, dataclass, field, replace

from . import calibration, timing
from .core import choose_core
from .load import OthersWatch
from .measure import measure_times


@dataclass
class CellResult:
    """What is said of a cell, and of what samples."""

    verdict: timing.Verdict
    samples: dict
    quantities: dict = field(default_factory=dict)  # {quantity: Verdict}; with a baseline
    decided_by: str | None = None  # of them, beside the frame's time: the stage
    has_same_tree: bool = True  # else times are also of other nodes

    def as_dict(self):
        """As the history has the verdict."""
        made = {**self.verdict.as_dict(), "stage": self._describe_stage()}
        if not self.has_same_tree:
            made["reason"] += "; the baseline has built another hierarchy"
        if self.quantities:
            made["quantities"] = {q: v.as_dict() for q, v in self.quantities.items()}
        return made

    def _describe_stage(self):
        if self.decided_by is None:
            return None
        decided = self.quantities[self.decided_by]
        return (f"{self.decided_by} "
                f"{timing.describe_change(decided.change, decided.low, decided.high)}")


class TimingTier:
    """Of one night. rule: a timing.Rule. find_norm: gives a cell's normalised samples of earlier
    nights, of the same workload of the calibration unless that is None; unused with a baseline."""

    def __init__(self, options, new, base, is_gpu, find_norm):
        self.core = choose_core(options.core, is_gpu)
        self._options = options
        self._new, self._base = (program and replace(program, core=self.core)
                                 for program in (new, base))
        self._is_gpu, self._find_norm = is_gpu, find_norm
        self._watch = OthersWatch()
        self.is_calibrated = options.calibration != calibration.NONE
        self.seconds = []  # of the calibration

    @property
    def others(self):
        """Share of the processors' time that other programs used so far."""
        return self._watch.share()

    def run(self, cells, say, note=None):
        """{cell: CellResult}. say: called with lines of progress; note, or say without it, with those
        of crashes."""
        times, factor = self._measure(cells, 0, say, note)
        results = {cell: self._judge(cell, times[cell], factor) for cell in cells}
        doubtful = [cell for cell, result in results.items() if is_doubtful(result)]
        if doubtful and not self._find_noise():
            say(f"measured again before anything is said: {', '.join(doubtful)}")
            times, factor = self._measure(doubtful, 1, say, note)
            for cell in doubtful:
                first = results[cell]
                results[cell] = confirm(first, self._judge(cell, times[cell], factor))
                results[cell].samples["first"] = first.samples
        noise = self._find_noise()
        if noise:
            return {cell: CellResult(timing.Verdict(timing.UNCLEAR, noise), result.samples)
                    for cell, result in results.items()}
        return results

    def _find_noise(self):
        # With a baseline the spread of the ratios tells more than that of the calibration.
        seconds = None if self._base else self.seconds
        return timing.find_noise(self._options.rule, self.others, seconds)

    def _measure(self, cells, again, say, note):
        options = self._options
        folder = options.out / ("timing-again" if again else "timing")
        times, seconds = measure_times(
            cells, self._new, self._base, options.repetitions, options.seed + again, folder,
            calibration.measure if self.is_calibrated else None,
            lambda n: say(f"times{' again' if again else ''}: repetition {n} of "
                          f"{options.repetitions}, {len(cells)} cells"),
            note or say)
        self.seconds += seconds
        # A processor's workload says nothing of a GPU.
        factor = 1.0 if self._is_gpu or not seconds else statistics.median(seconds)
        return times, factor

    def _judge(self, cell, times, factor):
        samples = {**times.as_dict(), "calibration": factor}
        if self._base is None:
            workload = calibration.WORKLOAD if factor != 1.0 else None
            tonight = [value / factor for value in times.new]
            return CellResult(timing.judge_history(self._find_norm(cell, workload), tonight,
                                                   self._options.rule), samples)
        result = combine(timing.judge_quantities(times.ratios, self._options.rule), samples)
        result.has_same_tree = times.has_same_tree
        return result


def is_doubtful(result):
    """Whether to measure a cell again."""
    return any(map(timing.is_change, [result.verdict, *result.quantities.values()]))


def confirm(first, second):
    """The CellResult of a cell that was measured again."""
    if not first.quantities:
        return CellResult(timing.confirm(first.verdict, second.verdict), second.samples)
    result = combine(timing.confirm_quantities(first.quantities, second.quantities),
                     second.samples)
    result.has_same_tree = second.has_same_tree
    return result


def combine(quantities, samples):
    """The CellResult of a cell's quantities."""
    verdict, stage = timing.combine(quantities, compute_stage_means(samples["stages"]["base"]))
    return CellResult(verdict, samples, quantities, stage)


def compute_stage_means(columns):
    """{stage: ms a frame} of {column of the frame log: [means of runs, ms]}."""
    return {stage: sum(statistics.median(columns.get(c) or [0.0]) for c in parts)
            for stage, parts in timing.STAGES.items()}


def describe_tier(tier, results, options, base, turn_frames):
    """The member "timing" of a night."""
    revision = None
    if base:
        revision = options.baseline or str(options.baseline_program)
    return {
        "mode": "baseline" if base else "history", "repetitions": options.repetitions,
        "seed": options.seed, "baseline": revision, "turn_frames": turn_frames,
        "core": tier.core,
        "calibration": {"workload": (calibration.WORKLOAD if tier.is_calibrated
                                     else calibration.NONE), "seconds": tier.seconds or [1.0]},
        "others_share": tier.others, "rule": asdict(options.rule),
        "cells": {cell: result.samples for cell, result in results.items()}}
