#!/usr/bin/env python3
"""Prints how often scripts/nightly.sh errs, as Markdown tables (docs/nightly.md).

Nights with a baseline are simulated by the rule that judges real ones, from measured pairs of
replays. From a file of scripts/nightly_pairs.py (that of results/reference by default): nights of
the same build (A/A), and of programs that were slowed down. From a history: of its own nights, as
if nothing had changed, and with all times made longer; so, too, from a file that has no slowed down
programs. Nothing is run.

Exit codes: 0 done; 2 wrong usage or too few pairs.
"""

import argparse
import math
import pathlib
import sys

from run_cells import ROOT
from tracking.errors import TrackingError
from tracking.simulate import (SAME_BUILD, Setting, read_history_groups, read_pairs,
                               share_of_cells, share_of_nights, share_of_stage, simulate,
                               slow_down)
from tracking.timing import FAST, SAME, SLOW, UNCLEAR, Rule

PAIRS = ROOT / "results" / "reference" / "llvmpipe" / "nightly" / "pairs.json"
MADE_UP = (0.02, 0.05, 0.10)
ALL = "all"  # times, of whatever stage
FEWEST = 9  # pairs in all


def parse_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", nargs="?", type=pathlib.Path, default=PAIRS,
                        help="a file of nightly_pairs.py, or a folder with nights (%(default)s)")
    parser.add_argument("--nights", type=int, default=1000, help="of each row (%(default)s)")
    parser.add_argument("--repetitions", type=int, nargs="+", default=[9],
                        help="of a cell (%(default)s)")
    parser.add_argument("--min-change", type=float, nargs="+", default=[100 * Rule.min_change],
                        help="per cent (%(default)s)")
    parser.add_argument("--cells", type=int, default=5, help="of a night (%(default)s)")
    return parser.parse_args()


def read_groups(source):
    """([Group of the same build], {slowdown: [Group]})."""
    if not source.is_dir():
        groups = read_pairs(source)
        names = dict.fromkeys(g.slowdown for g in groups if g.slowdown != SAME_BUILD)
        slowed = {name: [g for g in groups if g.slowdown == name] for name in names}
        same = [g for g in groups if g.slowdown == SAME_BUILD]
        if slowed:
            return same, slowed
    else:
        same = read_history_groups(source)
    names = {f"{ALL}={100 * share:g}": share for share in MADE_UP}
    return same, {name: [slow_down(group, name, share) for group in same]
                  for name, share in names.items()}


def main():
    """Prints the tables."""
    options = parse_arguments()
    try:
        same, slowed = read_groups(options.source)
    except TrackingError as error:
        print(f"nightly_rates.py: {error}", file=sys.stderr)
        return 2
    count = sum(map(len, same))
    if count < FEWEST:
        print(f"nightly_rates.py: {options.source}: expected {FEWEST} pairs of the same build or "
              f"more, found {count}", file=sys.stderr)
        return 2
    print(f"{count} pairs of the same build; {options.nights} nights of {options.cells} cells a "
          "row.\n")
    print_same(same, options)
    print()
    print_slowed(slowed, options)
    return 0


def list_rules(options):
    """(repetitions, least change in per cent, Setting, Rule) of the rows."""
    for repetitions in options.repetitions:
        for least in options.min_change:
            yield (repetitions, least, Setting(repetitions, options.cells, options.nights),
                   Rule(min_change=least / 100))


def print_same(groups, options):
    print("| N | least change | nights with a false SLOW | with a false FAST | cells SAME | "
          "UNCLEAR |\n|--:|--:|--:|--:|--:|--:|")
    for repetitions, least, setting, rule in list_rules(options):
        nights = simulate(groups, setting, rule)
        print_row(repetitions, f"{least:g} %", share_of_nights(nights, SLOW),
                  share_of_nights(nights, FAST), share_of_cells(nights, SAME),
                  share_of_cells(nights, UNCLEAR))


def print_slowed(slowed, options):
    print("| slowed down | pairs | N | least change | found | called FAST | stage named right |\n"
          "|---|--:|--:|--:|--:|--:|--:|")
    for name, groups in slowed.items():
        for repetitions, least, setting, rule in list_rules(options):
            nights = simulate(groups, setting, rule)
            stage = name.split("=")[0]
            named = math.nan if stage == ALL else share_of_stage(nights, SLOW, stage)
            print_row(describe_slowdown(name), sum(map(len, groups)), repetitions, f"{least:g} %",
                      share_of_cells(nights, SLOW), share_of_cells(nights, FAST), named)


def describe_slowdown(name):
    stage, _, share = name.partition("=")
    return f"{stage} by {share} %"


def print_row(*fields):
    print("| " + " | ".join(per_cent(f) if isinstance(f, float) else str(f) for f in fields)
          + " |", flush=True)


def per_cent(share):
    if share != share:  # of nothing
        return "–"
    return f"{100 * share:.2f} %" if 0 < share < 0.1 else f"{100 * share:.0f} %"


if __name__ == "__main__":
    sys.exit(main())
