"""Runs the program: once a scene with a fixed latency, and pairs of runs for times."""

import pathlib
import random
import re
import subprocess
from dataclasses import dataclass

import sweeping.cell
from result_folder import ResultError, read_run

from . import timing
from .build import last_line, run
from .errors import TrackingError
from .matrix import LATENCY, PICTURES, REFERENCE

STAGES = (*timing.STAGES, timing.CPU)
NO_GL = 3
STRATEGY = re.compile(r"^  ([a-z][a-z0-9-]*) ", re.MULTILINE)


@dataclass
class Program:
    """hlodbench, and the hierarchies that it has built."""

    path: pathlib.Path
    cache: pathlib.Path
    name: str  # in messages
    out: pathlib.Path  # logs and results go here
    sessions: pathlib.Path
    context: str = "auto"

    def build_hierarchy(self, scene):
        """Makes cache/SCENE.hlod, unless it is there and up to date."""
        self.cache.mkdir(parents=True, exist_ok=True)
        log = self.out / f"{self.name}.{scene}.build.log"
        code = run([self.path, "build", self.sessions / f"{scene}.scene.json", "-o",
                    self._hierarchy(scene)], None, log)
        if code != 0:
            raise TrackingError(f"{self.name}: hierarchy of {scene}: hlodbench ended with code "
                                f"{code}: {last_line(log)}")

    def list_strategies(self):
        """Their ids."""
        try:
            done = subprocess.run([self.path, "list"], capture_output=True, text=True, check=False,
                                  stdin=subprocess.DEVNULL)
        except (OSError, UnicodeDecodeError) as error:
            raise TrackingError(f"{self.path}: cannot be run: {error}") from None
        section = done.stdout.partition("Strategies")[2].partition("\n\n")[0]
        found = STRATEGY.findall(section)
        if done.returncode != 0 or not found:
            raise TrackingError(f"{self.path} list: expected strategies, found none")
        return found

    def run_exact(self, scene, strategies):
        """The exact tier of a scene; its result folder."""
        folder = self.out / "exact" / scene
        self._run(scene, list(dict.fromkeys([REFERENCE, *strategies])), folder,
                  "--latency", LATENCY, "--images", PICTURES)
        return folder

    def run_timed(self, scene, strategy, folder):
        """One replay with the driver's latency: (ms a frame, {stage: ms a frame}).
        The processor's time is among the stages."""
        self._run(scene, [strategy], folder, "--latency", "gl", "--images", "none")
        try:
            (case,) = read_run(folder, frames=False).cases
        except (ResultError, ValueError) as error:
            raise TrackingError(f"{folder}: expected one replay: {error}") from None
        fps = (case.summary or {}).get("fps")
        if case.error or not fps:
            raise TrackingError(f"{folder}: {strategy}: {case.error or 'no frame rate'}")
        counters = case.summary.get("counters") or {}
        return 1000 / fps, {s: counters[s]["mean"] for s in STAGES if s in counters}

    def _hierarchy(self, scene):
        return self.cache / f"{scene}.hlod"

    def _run(self, scene, strategies, folder, *options):
        folder.parent.mkdir(parents=True, exist_ok=True)
        log = folder.with_name(f"{folder.name}.log")
        context = [] if self.context == "auto" else ["--context", self.context]
        command = [self.path, "run", "--scene", self._hierarchy(scene), "--session",
                   self.sessions / f"{scene}.session.json", "--strategy", ",".join(strategies),
                   "--repetitions", "1", *context, *options]
        try:
            with open(log, "wb") as file:
                sweeping.cell.run_whole(command, folder, stdout=file, stderr=file,
                                        stdin=subprocess.DEVNULL)
        except sweeping.cell.CellFailed as error:
            what = "no usable OpenGL" if error.code == NO_GL else str(error)
            raise TrackingError(f"{self.name}: {scene}/{','.join(strategies)}: {what}: "
                                f"{last_line(log)} ({log})") from None
        except OSError as error:
            raise TrackingError(f"{error.filename or self.path}: {error.strerror}") from None


class Times:
    """Frame times of cells, by cell: {"new": [ms], "base": [ms] or None, "stages": ...}."""

    def __init__(self, cells, with_base):
        self.cells = {cell: {"new": [], "base": [] if with_base else None,
                             "stages": {"new": {}, "base": {}}} for cell in cells}
        self.calibration = []  # seconds

    def add(self, cell, side, milliseconds, stages):
        self.cells[cell][side].append(milliseconds)
        for stage, value in stages.items():
            self.cells[cell]["stages"][side].setdefault(stage, []).append(value)


def measure_times(cells, new, base, repetitions, seed, out, calibrate, progress):
    """Times of cells over `repetitions`. base: a Program, or None.

    Every repetition has each cell once, in an order of chance, with new and base side by side, so
    that what changes slowly meets both alike; which goes first alternates. calibrate: gives the
    seconds of the calibration, measured once a repetition, or is None. progress: called with the
    number of each repetition, from 1.
    """
    rng = random.Random(seed)
    begins = {cell: rng.randrange(2) for cell in cells}
    times = Times(cells, base is not None)
    for repetition in range(repetitions):
        progress(repetition + 1)
        if calibrate:
            times.calibration.append(calibrate())
        order = list(cells)
        rng.shuffle(order)
        for cell in order:
            sides = [("new", new), ("base", base)] if base else [("new", new)]
            if (repetition + begins[cell]) % 2:
                sides.reverse()
            scene, strategy = cell.split("/")
            for side, program in sides:
                folder = out / scene / f"{strategy}.{repetition}.{side}"
                times.add(cell, side, *program.run_timed(scene, strategy, folder))
    return times
