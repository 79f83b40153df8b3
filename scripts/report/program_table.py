"""Table 1 of the report: the numbers are those that `hlodbench table` prints, none is computed
again here but the ratios of ours over the paper's."""

import csv
import io
import json
import re
import subprocess
from dataclasses import dataclass, field

from .values import DASH, format_fixed, to_number

FORMATS = ("csv", "markdown", "latex")
TIMEOUT_S = 60
RATIOS = "Ratios of DN"  # how the program's line of them begins
# key of the CSV, heading, digits of ours behind the point (as `hlodbench table` prints them)
COLUMNS = (
    ("dn", "DN", 1),
    ("rarn", "RARN", 2),
    ("d", "D", 2),
    ("fps", "FPS", 1),
    ("speedup", "Speedup of Coh(B)", 2),
)


@dataclass
class Table:
    """What the program printed."""

    texts: dict = field(default_factory=dict)  # format -> text; empty if the program cannot be run
    rows: dict = field(default_factory=dict)  # folder as text -> list of rows for the page
    scenes: dict = field(default_factory=dict)  # folder as text -> the paper's scene, or ""
    ratios: dict = field(default_factory=dict)  # folder as text -> the program's line of ratios
    problems: list = field(default_factory=list)  # of str, one line each


class ProgramError(Exception):
    """The program is not there or refused; the message is one line."""


def run_table(program, folders, style):
    """The text of `hlodbench table` for these folders in one format."""
    command = [str(program), "table", "--format", style, "--", *map(str, folders)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8",
                              timeout=TIMEOUT_S, check=False)
    except (OSError, UnicodeDecodeError, subprocess.TimeoutExpired) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ProgramError(f"{program}: expected the program hlodbench: {reason}") from None
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [f"ended with code {done.returncode}"]
        raise ProgramError(f"`hlodbench table` refused: {lines[-1]}")
    return done.stdout


def make_table(program, folders, paper):
    """Table 1 of the folders that the program accepts; the others become problems.

    paper: results/paper_table1.json as a dict, or None.
    """
    table = Table()
    accepted = list(folders)
    try:
        table.texts["csv"] = run_table(program, accepted, "csv")
    except ProgramError:
        # One folder that is refused must not take the others' numbers away.
        accepted = []
        for folder in folders:
            try:
                run_table(program, [folder], "csv")
                accepted.append(folder)
            except ProgramError as error:
                if str(error) not in table.problems:
                    table.problems.append(str(error))
        if not accepted:
            return table
    try:
        for style in FORMATS:
            table.texts[style] = run_table(program, accepted, style)
        read_rows(table, paper)
    except (ProgramError, KeyError, ValueError) as error:
        table.problems.append(f"Table 1 cannot be shown: {error}")
        table.texts, table.rows = {}, {}
    return table


def read_rows(table, paper):
    """Turns the program's CSV into the rows of the page."""
    for record in csv.DictReader(io.StringIO(table.texts["csv"])):
        folder = record["folder"]
        table.rows.setdefault(folder, []).append(make_row(record, paper))
        table.scenes[folder] = table.scenes.get(folder) or record["paper_scene"]
    lines = [line for line in table.texts["markdown"].splitlines() if line.startswith(RATIOS)]
    if len(lines) == len(table.rows):  # one a folder, in the same order
        unescaped = [re.sub(r"\\(\W)", r"\1", line) for line in lines]
        table.ratios = dict(zip(table.rows, unescaped))


def make_row(record, paper):
    """One strategy: label, cells (ours, paper, ratio) by column, and the mean of frames' FPS."""
    cells = []
    for key, _, digits in COLUMNS:
        ours = parse(record[f"ours_{key}"])
        printed = record[f"paper_{key}"]
        reference = parse(printed)
        if is_dash(record["strategy"], key, paper):
            cells.append((DASH, DASH, DASH))
            continue
        shown = format_fixed(ours, digits)
        low, high = parse(record.get("ours_speedup_low")), parse(record.get("ours_speedup_high"))
        if key == "speedup" and low is not None and high is not None:
            shown += f" [{low:.2f}, {high:.2f}]"
        ratio = ours / reference if ours is not None and reference else None
        cells.append((shown, format_printed(key, printed), format_fixed(ratio, 2)))
    return {
        "strategy": record["strategy"],
        "label": record["label"],
        "cells": cells,
        "frame_fps": format_fixed(parse(record["ours_fps_frame_mean"]), 1),
        "limit_share": format_share(record),
        "repetitions": record["repetitions"],
        "failures": int(record["failures"]),
    }


def format_share(record):
    """The share of Oracle's FPS with its interval, per cent; empty where the run has none."""
    share, low, high = (parse(record.get(f"ours_limit_share{end}", ""))
                        for end in ("", "_low", "_high"))
    if share is None:
        return ""
    interval = "" if low is None or high is None else f" [{100 * low:.1f}, {100 * high:.1f}]"
    return f"{100 * share:.1f} %{interval}"


def format_printed(key, text):
    """A value of the paper with the digits that it prints: 217, 0.1, but 1.10 and 92.9."""
    number = parse(text)
    if number is None:
        return DASH
    return f"{number:.2f}" if key == "speedup" else f"{number:.1f}" if key == "fps" else text


def is_dash(strategy, key, paper):
    """Whether the paper prints a dash because the counter says nothing of the strategy: SW(B), for
    one, delays every node by its nature."""
    rows = [row for scene in (paper or {}).get("scenes", []) for row in scene.get("rows", [])
            if row.get("strategy") == strategy]
    return bool(rows) and all(key in row and row[key] is None for row in rows)


def parse(text):
    """A number of the CSV, or None for an empty field."""
    return to_number(float(text)) if text else None


def read_paper(path):
    """results/paper_table1.json, or None if it cannot be read."""
    try:
        paper = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, json.JSONDecodeError):
        return None
    return paper if isinstance(paper, dict) else None
