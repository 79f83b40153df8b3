"""OUT/sweep.csv: a row for each cell and strategy, with its parameters and what they gave.

Parameters are those in effect, defaults included. A counter is its mean over the measured frames of
all repetitions. What is not known is an empty field.
"""

import csv
import os
import pathlib

import numpy as np
from atomic_file import write_atomically
from result_folder import ResultError, read_run

from .plan import CELLS, name_of

TABLE = "sweep.csv"
PARQUET = "sweep.parquet"
OPTION = "option."
PARAMETERS = ("scene", "session", "size", "tau", "s", "t", "latency", "seed", "repetitions",
              "timing")
MEASURING = ("timing", "repetitions")
PLACE = ("cell", "strategy", "label")
FACTS = ("program", "revision", "scene_hash", "scene_triangles", "scene_nodes", "frames")
RATES = ("fps", "fps_low", "fps_high")
QUALITY = ("psnr_y", "psnr_cb", "psnr_cr", "psnr_identical", "psnr_full_y", "wrong_share",
           "crack_pixels")
RESAMPLES = 10_000


class TableError(Exception):
    """A table that cannot be read; the message is one line."""


def make_rows(plan, folder):
    """The rows of the cells whose results are there, in the plan's order; each {column: value}."""
    rows = []
    for identity, cell in plan.cells.items():
        path = pathlib.Path(folder, CELLS, identity)
        if not (path / "run.json").is_file():
            continue
        try:
            run = read_run(path, frames=False)
        except ResultError:
            continue
        strategies = dict.fromkeys(case.strategy for case in run.cases)
        planned = (run.data.get("options") or {}).get("strategies") or []
        for strategy in sorted(strategies, key=lambda s: planned.index(s) if s in planned else -1):
            rows.append(_make_row(identity, cell, plan, run, strategy))
    return rows


def is_fact(column):
    """Whether a column says what a cell ran on rather than what it gave."""
    return column in FACTS


def is_time(counter):
    """Whether a counter is a time, which depends on what else the machine did."""
    return counter.endswith("_ms")


def pooled_means(run, strategy):
    """{counter: mean over the frames of all repetitions}, as `hlodbench table` has it."""
    sums = {}
    for case in run.cases:
        if case.strategy != strategy or not case.summary:
            continue
        for key, summary in (case.summary.get("counters") or {}).items():
            total, count = sums.get(key, (0.0, 0))
            sums[key] = (total + summary["mean"] * summary["count"], count + summary["count"])
    return {key: total / count for key, (total, count) in sums.items() if count}


def means_by_repetition(run, strategy, counter):
    """The counter's mean in each repetition that has it."""
    summaries = [(case.summary or {}).get("counters", {}).get(counter) for case in run.cases
                 if case.strategy == strategy]
    return [summary["mean"] for summary in summaries if summary]


def bootstrap_interval(values):
    """The 95 % interval of the mean, (low, high); (None, None) of fewer than two values.

    Of two to five it is their whole range, as with the speedups in run.json.
    """
    values = np.asarray(values, dtype=float)
    if len(values) < 2:
        return None, None
    if len(values) <= 5:
        return float(values.min()), float(values.max())
    rng = np.random.default_rng(1)  # always the same resamples
    means = values[rng.integers(0, len(values), (RESAMPLES, len(values)))].mean(axis=1)
    low, high = np.percentile(means, (2.5, 97.5))
    return float(low), float(high)


def _make_row(identity, cell, plan, run, strategy):
    options, data = run.data.get("options") or {}, run.data
    viewport = options.get("viewport") or ["", ""]
    row = {"cell": identity, "strategy": strategy, "label": run.label(strategy),
           "scene": run.scene, "session": name_of(cell.session),
           "size": f"{viewport[0]}x{viewport[1]}", "timing": "true" if cell.timing else "false"}
    for key in ("tau", "s", "t", "latency", "seed"):
        row[key] = options.get(key, cell.parameters.get(key))
    row["repetitions"] = data.get("repetitions")
    row |= {key: value for key, value in cell.parameters.items() if key.startswith(OPTION)}
    row |= {"program": plan.program_hash[:16], "revision": data["context"].get("git_revision"),
            "scene_hash": data["scene"].get("hash"),
            "scene_triangles": data["scene"].get("triangles"),
            "scene_nodes": data["scene"].get("nodes"), "frames": data["session"]["frames"]}
    means = pooled_means(run, strategy)
    row |= {key: mean for key, mean in means.items() if cell.timing or not is_time(key)}
    if means.get("dn") and "d" in means:
        row["delayed_share"] = means["d"] / means["dn"]
    if cell.timing and means.get("frame_ms"):
        times = means_by_repetition(run, strategy, "frame_ms")
        low, high = bootstrap_interval(times)
        row["fps"] = 1000 / means["frame_ms"]
        row["fps_low"] = 1000 / high if high else None
        row["fps_high"] = 1000 / low if low else None
    row |= _quality(run, strategy)
    return row


def _quality(run, strategy):
    """PSNR and what goes with it, if there are pictures."""
    entries = run.images["strategies"] if run.images else []
    summary = next((e.get("summary") for e in entries if e["strategy"] == strategy), None) or {}
    reference, full = summary.get("vs_reference") or {}, summary.get("vs_full") or {}
    row = {f"psnr_{plane}": (reference.get(plane) or {}).get("mean") for plane in ("y", "cb", "cr")}
    row["psnr_identical"] = (reference.get("y") or {}).get("identical")
    row["psnr_full_y"] = (full.get("y") or {}).get("mean")
    row["wrong_share"] = (summary.get("wrong_share") or {}).get("mean")
    row["crack_pixels"] = summary.get("crack_pixels")
    return row


def order_columns(rows):
    """All columns of the rows: where, with what, and what it gave."""
    found = dict.fromkeys(key for row in rows for key, value in row.items() if value is not None)
    options = sorted(key for key in found if key.startswith(OPTION))
    head = [*PLACE, *PARAMETERS, *options, *FACTS]
    tail = [key for key in (*RATES, *QUALITY) if key in found]
    return [*head, *(key for key in found if key not in head and key not in tail), *tail]


def write_table(folder, rows):
    """Writes OUT/sweep.csv, and OUT/sweep.parquet if pyarrow is there; never half of one."""
    columns = order_columns(rows)
    with write_atomically(os.path.join(folder, TABLE)) as temporary, open(
            temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([format_number(row.get(column)) for column in columns] for row in rows)
    _write_parquet(os.path.join(folder, PARQUET), columns, rows)


def format_number(value):
    """The shortest text that is read as the same number; other values as text, None as none."""
    if value is None:
        return ""
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(value)
    return str(value)


def _write_parquet(path, columns, rows):
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        pathlib.Path(path).unlink(missing_ok=True)  # of an earlier attempt that had it
        return
    content = {}
    for column in columns:
        values = [row.get(column) for row in rows]
        is_number = all(isinstance(v, (int, float)) for v in values if v is not None)
        content[column] = [v if v is None else float(v) if is_number else str(v) for v in values]
    with write_atomically(path) as temporary:
        pyarrow.parquet.write_table(pyarrow.table(content), temporary)


def read_table(path):
    """The rows of a sweep.csv as dicts of texts. Raises TableError."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file, strict=True)
            rows = list(reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise TableError(f"{path}: expected the table of a sweep: "
                         f"{getattr(error, 'strerror', None) or error}") from None
    missing = [key for key in (*PLACE, *PARAMETERS) if key not in (reader.fieldnames or [])]
    if missing:
        raise TableError(f"{path}:1: expected a column {missing[0]!r}, found none")
    for number, row in enumerate(rows, 2):
        if None in row or None in row.values():
            raise TableError(f"{path}:{number}: expected {len(reader.fieldnames)} fields, "
                             f"found {'more' if None in row else 'fewer'}")
    return rows


def swept_parameters(rows):
    """The parameters that have more than one value in these rows, in the table's order.

    How a cell was measured is none of them where the others tell the cells apart without it.
    """
    keys = [*PARAMETERS, *(key for key in (rows[0] if rows else {}) if key.startswith(OPTION))]
    swept = [key for key in keys if len({row[key] for row in rows}) > 1]
    for key in MEASURING:
        others = [other for other in swept if other != key]
        if len({(row["strategy"], *(row[k] for k in others)) for row in rows}) == len(rows):
            swept = others
    return swept
