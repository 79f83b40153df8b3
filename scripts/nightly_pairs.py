#!/usr/bin/env python3
"""Measures pairs of replays of one program with itself, as scripts/nightly.sh measures those of a new
program and its baseline, to learn how often its rule errs (scripts/nightly_rates.py).

Of each cell pairs of the same, and pairs with the second one slowed down (HLODBENCH_TEST_SLOWDOWN).
Each repetition has all of them once, in an order of chance; the file is written anew after each,
so that what is measured stays if it is stopped. Nothing else should run meanwhile.

Exit codes: 0 done; 2 wrong usage, or a run that failed; 130 interrupted.
"""

import argparse
import json
import os
import pathlib
import random
import sys
import tempfile
from dataclasses import replace

from atomic_file import write_text_atomically
from run_cells import ROOT
from tracking.cli import core, end_on_signals
from tracking.core import AUTO, choose_core
from tracking.errors import TrackingError
from tracking.measure import CellTimes, measure_cell
from tracking.night import cache_folder
from tracking.program import Program
from tracking.simulate import SAME_BUILD
from tracking.timing import STAGES
from tracking.timing_tier import compute_stage_means

PROGRAM = ROOT / "build" / "release" / "bench" / "hlodbench"
VARIABLE = "HLODBENCH_TEST_SLOWDOWN"
SLOWDOWNS = [f"{stage}={share}" for stage in STAGES for share in (2, 5, 10)]


def parse_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="JSON file to write")
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM, help="(%(default)s)")
    parser.add_argument("--cell", nargs="+", default=["courtyard/coh-b"],
                        help="SCENE/STRATEGY, of sessions/ (%(default)s)")
    parser.add_argument("--same", nargs="+", default=["courtyard/bool", "courtyard/sw-b"],
                        help="cells that are only measured with the same program (%(default)s)")
    parser.add_argument("--slowdown", nargs="*", default=SLOWDOWNS,
                        help="STAGE=PERCENT, with %(metavar)s of draw, query, traversal "
                             "(each by 2, 5 and 10)", metavar="STAGE")
    parser.add_argument("--core", type=core, default=AUTO, metavar="C",
                        help="of the processor: its number, any, or auto: one where a GPU draws "
                             "(%(default)s)")
    parser.add_argument("--repetitions", type=int, default=16, help="(%(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the order (%(default)s)")
    return parser.parse_args()


def main():
    """Measures, and writes the file."""
    end_on_signals()
    options = parse_arguments()
    try:
        with tempfile.TemporaryDirectory() as folder:
            measure(options, pathlib.Path(folder))
    except (TrackingError, OSError) as error:
        print(f"nightly_pairs.py: {error}", file=sys.stderr)
        return 2
    return 0


def measure(options, folder):
    """Everything. folder: for results, empty."""
    same = Program(options.program.absolute(), cache_folder(), "same", folder, ROOT / "sessions")
    if not same.takes_turns:
        raise TrackingError(f"{same.path}: expected a program that knows --turns")
    plan = [(cell, SAME_BUILD) for cell in [*options.cell, *options.same]]
    plan += [(cell, slowdown) for cell in options.cell for slowdown in options.slowdown]
    scenes = list(dict.fromkeys(cell.split("/")[0] for cell, _ in plan))
    for scene in scenes:
        same.build_hierarchy(scene)
    is_gpu = options.core == AUTO and same.draws_on_gpu(scenes[0])
    same = replace(same, core=choose_core(options.core, is_gpu))
    times = {entry: CellTimes(base=[]) for entry in plan}
    rng = random.Random(options.seed)
    for repetition in range(options.repetitions):
        for number, (cell, slowdown) in enumerate(rng.sample(plan, len(plan))):
            print(f"repetition {repetition + 1} of {options.repetitions}: {number + 1} of "
                  f"{len(plan)}, {cell} {slowdown or 'with itself'}", file=sys.stderr)
            new = replace(same, name="slowed", environment={**os.environ, VARIABLE: slowdown})
            base_first = (repetition + plan.index((cell, slowdown))) % 2 == 1
            times[cell, slowdown].add(*measure_cell(
                cell, new, same, folder / f"{repetition}.{number}", base_first,
                lambda line: print(line, file=sys.stderr)))
        write(options.out, times, folder)


def write(path, times, folder):
    """The file: {"context": of a run of them, "groups": [see tracking.simulate.Group]}."""
    run = next(folder.glob("*.base/run.json"))
    context = json.loads(run.read_text(encoding="utf-8"))["context"]
    groups = [{"cell": cell, "slowdown": slowdown,
               "ratios": {q: [round(v, 6) for v in values] for q, values in found.ratios.items()},
               "means": {s: round(v, 4) for s, v in compute_stage_means(found.means["base"]).items()}}
              for (cell, slowdown), found in times.items()]
    text = json.dumps({"context": context, "groups": groups})
    write_text_atomically(path, text.replace('{"cell"', '\n{"cell"').replace(', "ratios"', ',\n "ratios"') + "\n")


if __name__ == "__main__":
    sys.exit(main())
