"""Runs of hlodbench that are the cells of a table, for the scripts that make such tables.

A cell is a result folder. It appears when its run is complete, so that a folder that is there is a
finished cell, and an interrupted script goes on where it stopped.
"""

import csv
import io
import json
import pathlib
import subprocess
import sys
import time

import sweeping.cell
from atomic_file import write_atomically

ROOT = pathlib.Path(__file__).resolve().parents[1]
DEFAULT_PROGRAM = ROOT / "build/release/bench/hlodbench"


class BadInput(Exception):
    """What cannot be run or read; the message is one line."""


class CellFailed(BadInput):
    """A run that ended with an error; what it said stands on stderr."""


def run_cell(program, arguments, folder, name):
    """Runs `hlodbench run` with these arguments into `folder`. Raises CellFailed, which calls the
    cell `name`, if the run fails, and BadInput if there is no such program."""
    try:
        sweeping.cell.run_whole([program, "run", *arguments], folder)
    except sweeping.cell.CellFailed as error:
        raise CellFailed(f"{name}: {error}") from None
    except OSError as error:
        raise BadInput(f"{program}: cannot be run: {error.strerror}") from None


def read_table(program, folder, strategies):
    """Rows of `hlodbench table` by strategy; the folder must have all of these strategies."""
    output = _ask(program, "table", folder, "--format", "csv")
    rows = {row["strategy"]: row for row in csv.DictReader(io.StringIO(output))}
    if not set(strategies) <= rows.keys():
        raise BadInput(f"{folder}: expected a run of {' and '.join(strategies)}, "
                       f"found {', '.join(rows)}")
    return rows


def read_comparison(program, a, b, strategy):
    """Rows of `hlodbench compare` by key, of one strategy in two folders."""
    output = _ask(program, "compare", f"{a}:{strategy}", f"{b}:{strategy}", "--format", "json",
                  codes=(0, 1))
    return {row["key"]: row for row in json.loads(output)["pairs"][0]["rows"]}


def _ask(program, *arguments, codes=(0,)):
    """What the program prints; `codes` are the exit codes that are no failure."""
    result = subprocess.run([str(part) for part in (program, *arguments)],
                            capture_output=True, text=True, check=False)
    if result.returncode not in codes:
        raise BadInput(result.stderr.strip())
    return result.stdout


class Progress:
    """Says on stderr which cell is run, and how long the others may take."""

    def __init__(self, total):
        self.total, self.start, self.done = total, time.monotonic(), 0

    def begin(self, number, name):
        """Before cell `number` (from 1) is run."""
        estimate = ""
        if self.done:
            left = (time.monotonic() - self.start) / self.done * (self.total - number + 1)
            estimate = f", about {left / 60:.0f} min left"
        print(f"{number}/{self.total} {name}{estimate}", file=sys.stderr)

    def end(self):
        """After it."""
        self.done += 1


def write_rows(path, columns, rows):
    """Writes rows, dicts by column, as CSV; nobody ever sees half of them."""
    with write_atomically(path) as temporary, open(temporary, "w", newline="",
                                                   encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
