"""What a bisection leaves in its folder of results: summary.md and bisect.json."""

import json
from dataclasses import asdict

from atomic_file import write_text_atomically

from . import timing
from .summary import escape

VERSION = 1  # of bisect.json: docs/nightly.md


def write_bisection(folder, made):
    """Both, of a Bisection."""
    write_text_atomically(folder / "bisect.json", json.dumps(as_data(made), indent=1) + "\n")
    write_text_atomically(folder / "summary.md", make_summary(made))


def as_data(made):
    """What bisect.json has."""
    return {
        "schema": VERSION, "good": made.line[0].hash, "bad": made.line[-1].hash,
        "commits": [commit.as_dict() for commit in made.line],
        "repetitions": made.repetitions, "seed": made.seed, "rule": asdict(made.rule),
        "cells": {cell: _cell_data(made, cell) for cell in made.changes},
        "probes": [{"commit": probe.commit.hash, "error": probe.error,
                    "cells": {cell: [{"side": side, **result.as_dict()}
                                     for result, side in attempts]
                              for cell, attempts in probe.cells.items()}}
                   for probe in made.probes]}


def _cell_data(made, cell):
    culprit = made.culprits.get(cell)
    own = culprit and culprit.own
    return {"change": made.changes[cell].as_dict(), "decided_by": made.quantities.get(cell),
            "candidates": [commit.hash for commit in culprit.candidates] if culprit else [],
            "own_change": own.as_dict() if own else None,
            "error": culprit.error if culprit else None}


def make_summary(made):
    """The text."""
    good, bad = made.line[0], made.line[-1]
    lines = [f"# Bisection of `{good.short}..{bad.short}`: {_describe(made)}", "",
             "| Cell | bad against good | change [95 %] | first commit | its own change [95 %] "
             "| why |", "|---|---|--:|---|--:|---|"]
    for cell, result in made.changes.items():
        culprit = made.culprits.get(cell)
        lines.append(f"| {cell} | {result.verdict.verdict} | {_change(result)} "
                     f"| {_describe_candidates(culprit)} | {_describe_own(culprit)} "
                     f"| {escape(_explain(made, cell))} |")
    if made.probes:
        lines += ["", "Commits that were tried, each against the good one:", "",
                  "| Commit | cell | verdict | change [95 %] | side |", "|---|---|---|--:|---|"]
    for probe in made.probes:
        for cell, attempts in probe.cells.items():
            lines += [f"| {_commit(probe.commit)} | {cell} | {result.verdict.verdict} "
                      f"| {_change(result)} | {side or 'cannot be told'} |"
                      for result, side in attempts]
        if probe.error:
            lines.append(f"| {_commit(probe.commit)} | – | could not be measured | – | – |")
    skipped = list_skipped(made)
    if skipped:
        lines += ["", "Skipped:", ""]
        lines += [f"- {_commit(commit)}: {escape(reason)}" for commit, reason in skipped]
    lines += ["", f"{len(made.line) - 1} commits, {made.repetitions} repetitions. Changes are of "
              f"frame times, or of the stage that is named: above 0 is slower. Least change: "
              f"{100 * made.rule.min_change:g} %."]
    return "\n".join(lines) + "\n"


def list_skipped(made):
    """(Commit, reason) of commits that could not be judged, of all cells or of some."""
    found = []
    for probe in made.probes:
        if probe.error:
            found.append((probe.commit, probe.error))
        for cell, attempts in probe.cells.items():
            result, side = attempts[-1]
            if side is None and not probe.error:
                found.append((probe.commit, f"{cell}: {result.verdict.reason}"))
    return found


def _describe(made):
    """All of it in a few words."""
    kinds = [result.verdict.verdict for result in made.changes.values()]
    counts = [f"{kinds.count(kind)} {kind}" for kind in (timing.SLOW, timing.FAST, timing.UNCLEAR)
              if kind in kinds]
    said = "changed" if made.culprits else "no cell is found to have changed"
    return said + (f" ({', '.join(counts)})" if counts else "")


def _explain(made, cell):
    """The last column."""
    culprit, bad = made.culprits.get(cell), made.changes[cell].verdict
    if culprit is None:
        return bad.reason
    if culprit.error:
        return f"not measured against its parent: {culprit.error}"
    if culprit.own is None:
        return "those between could not be judged"
    own = culprit.own.verdict
    if own.verdict != bad.verdict:
        return f"not confirmed: against its parent {own.verdict}, {own.reason}"
    if is_part(made, cell):
        return (f"confirmed, but less than half of the change: bisect from "
                f"{culprit.candidates[0].short} for the rest")
    return "confirmed"


def is_part(made, cell):
    """Whether a commit that was found makes less than half of a cell's change."""
    quantity = made.quantities[cell]
    own = made.culprits[cell].own.quantities.get(quantity)
    whole = made.changes[cell].quantities[quantity].change
    return own is not None and own.change is not None and abs(own.change) < abs(whole) / 2


def _describe_candidates(culprit):
    if culprit is None:
        return "–"
    return ("one of: " * (len(culprit.candidates) > 1)
            + "; ".join(map(_commit, culprit.candidates)))


def _describe_own(culprit):
    if culprit is None or culprit.own is None:
        return "–"
    return f"{culprit.own.verdict.verdict} {_change(culprit.own)}"


def _change(result):
    """Of the frame's time, and of the stage that has most of it."""
    verdict = result.verdict
    if verdict.change is None:
        return "–"
    stage = result.as_dict()["stage"]
    change = timing.describe_change(verdict.change, verdict.low, verdict.high)
    return change + (f"; {stage}" if stage else "")


def _commit(commit):
    return f"`{commit.short}` {escape(commit.subject)}"
