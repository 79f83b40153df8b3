"""One night, from building to the file in the history."""

import os
import pathlib
import shutil
import sys

from run_cells import ROOT

from . import exact, timing
from .build import Baseline, build_program, run
from .errors import TrackingError
from .history import append, now_utc, read_history
from .lock import MachineLock
from .machine import describe_machine
from .matrix import list_cells, list_scenes, strategies_of
from .measure import take_turns
from .output import write_night, write_report
from .program import TURN_FRAMES, Program
from .timing_tier import CellResult, TimingTier, describe_tier

LEAST_FREE = 512 << 20  # bytes, where results, history and builds go
CONTEXT = ("program", "distribution", "kernel", "cpu_governor", "load_average", "warnings")


def say(text):
    print(f"nightly.sh: {text}", file=sys.stderr)


def run_night(options):
    """Everything; the night as it stands in the history. Raises TrackingError."""
    cells = list_cells(options.paper, options.cell)
    make_folders(options)
    with MachineLock():
        # A baseline that cannot be had is no reason to measure half the night first.
        base = make_baseline(options)
        new = make_program(options)
        if options.paper:
            fetch_models(options)
        for program in filter(None, (new, base)):
            for scene in list_scenes(cells):
                say(f"hierarchy of {scene} ({program.name})")
                program.build_hierarchy(scene)
        night = measure_exact(options, new, cells)
        key = night["machine"]["key"]
        history = read_history(options.history, key)
        for problem in history.problems:
            say(problem)
        night["sequence"] = history.next_sequence
        night["verdicts"] = {
            cell: {"exact": exact.judge_exact(history, cell, night["exact"][cell]), "timing": None}
            for cell in cells}
        if options.timing:
            measure_timing(options, new, base, cells, night, history)
        write_night(options.out, night, history)
        if options.report:
            make_report(options, new, list_scenes(cells))
        path = append(options.history, key, night, night["revision"])
    say(f"added to the history: {path}")
    return night


def collect(lines):
    """A function that says a line and adds it to `lines`."""
    def note(line):
        say(line)
        lines.append(line)
    return note


def make_report(options, program, scenes):
    say("report of the exact tier")
    problem = write_report(options.out, program.path,
                           [program.exact_folder(scene) for scene in scenes])
    if problem:
        say(f"no report.html: {problem}")


def make_folders(options):
    """Makes those of results and history, and refuses too little space."""
    make_out(options.out)
    options.history.mkdir(parents=True, exist_ok=True)
    check_space([options.out, options.history] + ([] if options.program else [ROOT]))


def make_out(folder):
    """Makes the folder of results; refuses one that is in use."""
    folder.mkdir(parents=True, exist_ok=True)
    if any(folder.iterdir()):
        raise TrackingError(f"--out: expected an empty folder or none, found {folder} in use")


def check_space(places):
    """Refuses too little of it in one of these folders."""
    for place in places:
        free = shutil.disk_usage(place).free
        if free < LEAST_FREE:
            raise TrackingError(f"{place}: no space: expected {LEAST_FREE >> 20} MiB free, found "
                                f"{free >> 20}")


def cache_folder():
    """As of the other scripts (scripts/lib.sh)."""
    return pathlib.Path(os.environ.get("HLODBENCH_CACHE") or ROOT / ".cache").absolute()


def make_program(options):
    path = options.program
    if path is None:
        say("building this checkout in build/release")
        path = build_program(ROOT, options.out / "build.log", "this checkout")
    return Program(path, cache_folder(), "new", options.out, ROOT / "sessions", options.context)


def make_baseline(options):
    """The Program compared with, or None; its hierarchies are its own."""
    if not options.timing:
        return None
    if options.baseline_program:
        path, cache = options.baseline_program, options.out / "baseline-cache"
    elif options.baseline:
        baseline = Baseline(ROOT, options.baseline)
        say(f"building the baseline {baseline.revision} in {baseline.folder}")
        path = baseline.build(options.out / "baseline-build.log")
        cache = baseline.folder / ".cache"
    else:
        return None
    return Program(path, cache, "baseline", options.out, ROOT / "sessions", options.context)


def fetch_models(options):
    """The dragon of the paper's scenes, where the scene files look for it."""
    os.environ["HLODBENCH_CACHE"] = str(cache_folder())
    log = options.out / "fetch.log"
    if run([ROOT / "scripts" / "fetch_dragon.sh"], None, log) != 0:
        raise TrackingError(f"--paper: the dragon could not be fetched ({log})")


def measure_exact(options, program, cells):
    """The exact tier: a night without sequence, timing and verdicts."""
    values, context, crashes = {}, {}, []
    for scene in list_scenes(cells):
        strategies = strategies_of(cells, scene)
        say(f"exact values of {scene}: {', '.join(strategies)}")
        folder = program.run_exact(scene, strategies, collect(crashes))
        found, data = exact.read_exact(folder)
        context = context or data["context"]
        for strategy in strategies:
            if strategy not in found:
                raise TrackingError(f"{options.out}: {scene}/{strategy}: expected a case, found "
                                    "none")
            values[f"{scene}/{strategy}"] = found[strategy]
    return {"kind": "night", "sequence": 0, "time_utc": now_utc(),
            "revision": context.get("git_revision") or "unknown",
            "machine": describe_machine(context, options.machine),
            "context": {**{key: context.get(key) for key in CONTEXT},
                        # From the history: the trend page links to what is there.
                        "results": os.path.relpath(options.out, options.history)},
            "crashes": crashes, "exact": values, "timing": None, "verdicts": {}}


def measure_timing(options, new, base, cells, night, history):
    """The timing tier: fills in the night's timing and verdicts."""
    known = base.list_strategies() if base else None
    timed = [cell for cell in cells if known is None or cell.split("/")[1] in known]
    if base and not take_turns(new, base):
        say("one of the programs knows no --turns: they run one after the other, which tells less")
    tier = TimingTier(options, new, base, night["machine"]["gl_class"] == "gpu",
                      lambda cell, workload: list_samples(cell, night, history, workload))
    results = tier.run(timed, say, collect(night["crashes"]))
    for cell in cells:
        result = results.get(cell) or CellResult(
            timing.Verdict(timing.UNCLEAR, "the baseline has no such strategy"), {})
        night["verdicts"][cell]["timing"] = result.as_dict()
    night["timing"] = describe_tier(tier, results, options, base,
                                    TURN_FRAMES if take_turns(new, base) else None)


def list_samples(cell, night, history, workload):
    """Normalised frame times of earlier nights, oldest first: of the same hierarchy and session,
    from the night that was last accepted on, without those that were SLOW (a regression does not
    become the norm by itself). workload: of the calibration, or None if it does not matter."""
    accepted = None
    for entry in history.acceptances:
        if cell in entry.data["cells"]:
            accepted = entry.data["night"]
    nights = history.nights
    first = next((i for i, entry in enumerate(nights) if entry.id == accepted), 0)
    found = []
    for entry in nights[first:]:
        data = entry.data
        samples = ((data.get("timing") or {}).get("cells") or {}).get(cell)
        verdict = (data["verdicts"].get(cell) or {}).get("timing") or {}
        is_slow = verdict.get("verdict") == timing.SLOW and entry.id != accepted
        used = ((data.get("timing") or {}).get("calibration") or {}).get("workload")
        values = data["exact"].get(cell) or {}
        is_alike = all(values.get(k) == night["exact"][cell][k] for k in ("scene", "session"))
        if samples and not is_slow and is_alike and (workload is None or used == workload):
            factor = samples.get("calibration", 1.0)
            found.append([value / factor for value in samples["new"]])
    return found
