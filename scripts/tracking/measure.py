"""Measures times: replays of two programs side by side, or of one."""

import random
import socket
from contextlib import ExitStack
from dataclasses import dataclass, field

import numpy as np

from . import timing
from .errors import run_again_once

BEGIN = b"t"  # hlodbench run --turns: whoever reads a byte has the turn
CPU = "cpu_ms"  # of the traversing thread, across the stages
COLUMNS = ("draw_ms", "query_ms", "wait_ms", "traversal_ms", CPU)


@dataclass(frozen=True)
class Replay:
    """Of one strategy, without the warm-up."""

    frame_ms: float  # mean
    means: dict  # {column: mean, ms}
    stages: dict  # {stage of timing.STAGES: (frames,) ms}; those that were logged
    tree: str | None = None  # hash of the hierarchy


def read_replay(case, tree=None):
    """The Replay of a case of a result folder; None if it has no frame rate."""
    fps = (case.summary or {}).get("fps")
    if not fps:
        return None
    counters = case.summary.get("counters") or {}
    means = {c: counters[c]["mean"] for c in COLUMNS if c in counters}
    columns = case.columns
    counts = columns["warm_up"] == 0 if "warm_up" in columns else slice(None)
    stages = {stage: sum(columns[c][counts] for c in parts)
              for stage, parts in timing.STAGES.items() if all(c in columns for c in parts)}
    return Replay(1000 / fps, means, stages, tree)


def compute_ratios(base, new):
    """{quantity: new / base} of two Replays of the same session: "frame", of the mean times, as
    frame rates are; and of each stage the median over frames of the ratio of the same frame, which
    frames in which the thread did not run do not move."""
    ratios = {timing.FRAME: new.frame_ms / base.frame_ms}
    for stage, times in base.stages.items():
        others = new.stages.get(stage)
        if others is None or others.shape != times.shape:
            continue
        known = (times > 0) & (others > 0)
        if known.any():
            ratios[stage] = float(np.exp(np.median(np.log(others[known] / times[known]))))
    return ratios


@dataclass
class CellTimes:
    """Of one cell: by run, or by pair of runs. As the history has it, less what is empty."""

    new: list = field(default_factory=list)  # ms a frame
    base: list | None = None
    means: dict = field(default_factory=lambda: {"new": {}, "base": {}})  # {side: {column: [ms]}}
    ratios: dict = field(default_factory=dict)  # {quantity: [new / base]}
    has_same_tree: bool = True  # whether both programs built the same hierarchy

    def add(self, new, base=None):
        """Replays of one repetition."""
        for side, replay in (("new", new), ("base", base)):
            if replay is not None:
                getattr(self, side).append(replay.frame_ms)
                for column, mean in replay.means.items():
                    self.means[side].setdefault(column, []).append(mean)
        if base is not None:
            self.has_same_tree &= new.tree == base.tree
            for quantity, ratio in compute_ratios(base, new).items():
                self.ratios.setdefault(quantity, []).append(ratio)

    def as_dict(self):
        found = {"new": self.new, "base": self.base, "stages": self.means}
        return {**found, "ratios": self.ratios} if self.base is not None else found


def measure_times(cells, new, base, repetitions, seed, out, calibrate, progress, note):
    """Times of cells over `repetitions`: ({cell: CellTimes}, [seconds of the calibration]).
    base: a Program, or None.

    Every repetition has each cell once, in an order of chance. New and base replay it at the same
    time and take turns in it, or one after the other if one of them cannot; which begins
    alternates. calibrate: gives the seconds of the calibration, measured once a repetition, or is
    None. progress: called with the number of each repetition, from 1; note: with lines of what else
    happened.
    """
    rng = random.Random(seed)
    begins = {cell: rng.randrange(2) for cell in cells}
    times = {cell: CellTimes(base=None if base is None else []) for cell in cells}
    seconds = []
    for repetition in range(repetitions):
        progress(repetition + 1)
        if calibrate:
            seconds.append(calibrate())
        order = list(cells)
        rng.shuffle(order)
        for cell in order:
            place = (out / cell).with_name(f"{cell.split('/')[1]}.{repetition}")
            base_first = (repetition + begins[cell]) % 2 == 1
            times[cell].add(*measure_cell(cell, new, base, place, base_first, note))
    return times, seconds


def take_turns(new, base):
    """Whether both programs can."""
    return base is not None and new.takes_turns and base.takes_turns


def measure_cell(cell, new, base, place, base_first, note):
    """Replays of one repetition: (new's, base's), or (new's, None) without base. place: what names of
    folders begin with. note: called with a line if a program crashed and was run again."""
    def measure(again):
        sides = [(program, place.with_name(f"{place.name}{again}.{side}"))
                 for program, side in ((new, "new"), (base, "base")) if program is not None]
        if base is None:
            return new.run_timed(cell, sides[0][1]), None
        first, second = _measure_pair(cell, *(reversed(sides) if base_first else sides))
        return (second, first) if base_first else (first, second)

    return run_again_once(measure, note)


def _measure_pair(cell, first, second):
    """Replays of one cell by two programs, (Program, folder) each, which take turns if they can."""
    if not take_turns(first[0], second[0]):
        return tuple(program.run_timed(cell, folder) for program, folder in (first, second))
    with ExitStack() as stack:
        ends = [stack.enter_context(end) for end in socket.socketpair()]
        ends[1].send(BEGIN)
        attempts = [stack.enter_context(program.start_timed(cell, folder, end.fileno()))
                    for (program, folder), end in zip((first, second), ends)]
        for end in ends:  # so that one program's end is known to the other
            end.close()
        return tuple(attempt.finish() for attempt in attempts)
