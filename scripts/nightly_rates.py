#!/usr/bin/env python3
"""Prints how often scripts/nightly.sh errs, as a Markdown table (docs/nightly.md).

Nights are simulated from the replays of result folders and of nights (five runs of
results/reference by default; or a history) by the rule that judges real ones: with nothing changed (A/A), and with frame
times that are longer by some share in every cell. Nothing is run.

Exit codes: 0 done; 2 wrong usage or too few replays.
"""

import argparse
import pathlib
import sys

from run_cells import ROOT
from tracking.simulate import (Setting, read_groups, read_reference_groups, share_of_cells,
                               share_of_nights, simulate)
from tracking.timing import FAST, SAME, SLOW, UNCLEAR, Rule

CHANGES = (0.02, 0.05, 0.10)


def parse_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path,
                        help="folder with result folders or nights (five of results/reference)")
    parser.add_argument("--nights", type=int, default=1000, help="of each row (1000)")
    parser.add_argument("--repetitions", type=int, nargs="+", default=[9, 15, 30])
    parser.add_argument("--min-change", type=float, nargs="+", default=[3.0, 1.0], help="per cent")
    parser.add_argument("--cells", type=int, default=5, help="of a night (5)")
    parser.add_argument("--quiet-by", type=float, nargs="+", default=[1.0],
                        help="divide the replays' deviations by this: a machine so much quieter")
    return parser.parse_args()


def per_cent(share):
    return f"{100 * share:.2f} %" if share < 0.1 else f"{100 * share:.0f} %"


def main():
    """Prints the table."""
    options = parse_arguments()
    groups = read_groups(options.folder) if options.folder else read_reference_groups(ROOT)
    count = sum(len(group.deviations) for group in groups)
    if count < 10:
        print(f"nightly_rates.py: {options.folder or 'results/reference'}: expected 10 replays or more with the driver's "
              f"latency, found {count}", file=sys.stderr)
        return 2
    print(f"{count} replays in {len(groups)} groups; {options.nights} nights of {options.cells} "
          "cells a row.\n")
    print("| noise | N | least change | drawn from | nights with a false SLOW | with a false FAST | "
          "A/A cells SAME | UNCLEAR | " + " | ".join(f"{100 * c:.0f} % found" for c in CHANGES)
          + " |")
    print("|---|--:|--:|---|" + "--:|" * (4 + len(CHANGES)))
    for quiet in options.quiet_by:
        quieter = [type(g)(g.name, tuple(d / quiet for d in g.deviations)) for g in groups]
        for repetitions in options.repetitions:
            for least in options.min_change:
                for pooled in (True, False):
                    print_row(quieter, quiet, repetitions, least, pooled, options)
    return 0


def print_row(groups, quiet, repetitions, least, pooled, options):
    rule = Rule(min_change=least / 100)
    setting = Setting(repetitions, options.cells, options.nights, pooled)
    same = simulate(groups, 0.0, setting, rule)
    found = [share_of_cells(simulate(groups, change, setting, rule), SLOW) for change in CHANGES]
    row = ["as measured" if quiet == 1 else f"1/{quiet:g}", str(repetitions), f"{least:g} %",
           "all" if pooled else "one group a cell", per_cent(share_of_nights(same, SLOW)),
           per_cent(share_of_nights(same, FAST)), per_cent(share_of_cells(same, SAME)),
           per_cent(share_of_cells(same, UNCLEAR)), *map(per_cent, found)]
    print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
