"""Sweeps in the report: what the page's heat-maps are drawn from."""

import re

from sweeping.plan import read_plan
from sweeping.table import (OPTION, PARAMETERS, PLACE, TABLE, TableError, is_fact, read_table,
                            swept_parameters)

from .series import describe_counter

# Names where series.COUNTERS has none; key -> (name, unit, digits).
VALUES = {
    "fps": ("FPS", "1/s", 1),
    "fps_low": ("FPS, low end of the 95 % interval", "1/s", 1),
    "fps_high": ("FPS, high end of the 95 % interval", "1/s", 1),
    "delayed_share": ("D/DN", "", 4),
    "psnr_y": ("PSNR Y against Bool", "dB", 2),
    "psnr_cb": ("PSNR Cb against Bool", "dB", 2),
    "psnr_cr": ("PSNR Cr against Bool", "dB", 2),
    "psnr_identical": ("pictures identical to Bool's", "", 0),
    "psnr_full_y": ("PSNR Y against the full model", "dB", 2),
    "wrong_share": ("share of wrong pixels", "", 5),
    "crack_pixels": ("crack pixels", "", 0),
}


def is_sweep(folder):
    """Whether a folder is that of a sweep."""
    return (folder / TABLE).is_file()


def read_sweeps(folders):
    """(sweeps, problems): what the page shows of each folder, and a line for each unusable one."""
    sweeps, problems = [], []
    for folder in folders:
        path = folder / TABLE
        try:
            rows = read_table(path)
        except TableError as error:
            problems.append(str(error))
            continue
        if rows:
            sweeps.append(make_sweep(f"sweep-{len(sweeps)}", folder, rows))
        else:
            problems.append(f"{path}: expected finished cells, found none")
    return sweeps, problems


def make_sweep(identity, folder, rows):
    """What the page shows of one sweep."""
    keys = swept_parameters(rows) or ["scene"]
    parameters = [{"key": key, "name": key.removeprefix(OPTION), "values": order_values(
        {row[key] for row in rows})} for key in keys]
    strategies = list(dict.fromkeys((row["strategy"], row["label"]) for row in rows))
    counters = [describe_value(key) for key in list_values(rows)]
    return {
        "id": identity,
        "name": read_name(folder),
        "folder": str(folder),
        "facts": describe_fixed(rows, keys),
        "parameters": parameters,
        "strategies": strategies,
        "counters": counters,
        "data": {"parameters": parameters, "counters": counters,
                 "strategies": [{"id": s, "label": label} for s, label in strategies],
                 "rows": [make_row(row, parameters, counters) for row in rows]},
    }


def read_name(folder):
    """What the sweep's description calls it; else the folder's name."""
    try:
        return read_plan(folder).name
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return folder.resolve().name


def make_row(row, parameters, counters):
    """One cell and strategy: places of its parameters' values, and its numbers."""
    return {"strategy": row["strategy"],
            "places": [p["values"].index(row[p["key"]]) for p in parameters],
            "values": [to_number(row[c["key"]]) for c in counters]}


def list_values(rows):
    """Columns that are results and have a number in some row."""
    head = {*PLACE, *PARAMETERS}
    return [key for key in rows[0] if key not in head and not key.startswith(OPTION)
            and not is_fact(key) and any(to_number(row[key]) is not None for row in rows)]


def to_number(text):
    """The number that a field holds; None for an empty one or what is no finite number."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) < float("inf") else None  # false for NaN, too


def describe_value(key):
    """Name, unit and digits of a column."""
    if key not in VALUES:
        return describe_counter(key)
    name, unit, digits = VALUES[key]
    return {"key": key, "name": name, "unit": unit, "digits": digits}


def order_values(values):
    """Numbers by size, within texts too: draws:5 before draws:20, 64x48 before 160x120."""
    def key(text):
        parts = re.split(r"(\d+(?:\.\d+)?(?:e[+-]?\d+)?)", text)
        return [(float(p), "") if i % 2 else (0.0, p) for i, p in enumerate(parts)]
    return sorted(values, key=key)


def describe_fixed(rows, swept):
    """What all cells share, as a sentence's part."""
    fixed = [f"{key.removeprefix(OPTION)} {rows[0][key]}" for key in rows[0]
             if (key in PARAMETERS or key.startswith(OPTION)) and key not in swept
             and rows[0][key] and len({row[key] for row in rows}) == 1]
    cells = len({row["cell"] for row in rows})
    return f"{cells} cells; all with " + ", ".join(fixed)
