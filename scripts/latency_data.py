"""Counters and PSNR over the latency of query results, from the folder of a sweep.

Everything here is read from OUT/sweep.csv, but the spread of the driver's own latency over the
repetitions, which is in the result folders.
"""

import pathlib
from dataclasses import dataclass, field

import numpy as np
from result_folder import read_run
from sweeping.plan import CELLS
from sweeping.table import (OPTION, PARAMETERS, TABLE, bootstrap_interval, means_by_repetition,
                            read_table)

# key of the table -> what a figure calls it
VALUES = {
    "dn": "drawn nodes, DN",
    "queries": "queries",
    "rarn": "rendered, then refined, RARN",
    "d": "delayed, then drawn, D",
    "psnr_y": "PSNR Y against Bool, dB",
    "psnr_full_y": "PSNR Y against the full model, dB",
}
COUNTERS = ("dn", "queries", "rarn", "d")  # those with a value in each repetition
TELLING = ("rarn", "d", "dn")  # those by which a latency can be told
FREE = ("latency", "repetitions", "timing")  # what may differ within one figure
UNITS = ("draws", "frames")


@dataclass
class Driver:
    """What the driver's own latency (gl) gave."""

    means: dict = field(default_factory=dict)  # key of VALUES -> mean
    spreads: dict = field(default_factory=dict)  # of COUNTERS -> (low, high) or (None, None)
    repetitions: int = 0


@dataclass
class Curves:
    """One figure: every strategy of one scene and session over the latency."""

    parameters: dict  # all but FREE, as texts
    labels: dict = field(default_factory=dict)  # strategy -> label, in the table's order
    fixed: dict = field(default_factory=dict)  # (strategy, unit) -> [(latency, row)], ascending
    driver: dict = field(default_factory=dict)  # strategy -> Driver

    def points(self, strategy, unit, key):
        """(latencies, values), two float arrays; what has no value is left out."""
        pairs = [(latency, float(row[key])) for latency, row in self.fixed.get((strategy, unit), [])
                 if row.get(key)]
        return tuple(np.array(pairs, dtype=float).reshape(-1, 2).T)

    def delays_all(self, strategy):
        """Whether every node that it draws was delayed, as SW(B) has it by its nature: its D says
        nothing, and the paper's tables leave it out."""
        rows = [row for unit in UNITS for _, row in self.fixed.get((strategy, unit), [])]
        return bool(rows) and all(row.get("d") and row["d"] == row["dn"] for row in rows)

    def latencies(self, unit):
        """All of the unit, ascending."""
        return sorted({latency for (_, u), rows in self.fixed.items() if u == unit
                       for latency, _ in rows})


def read_curves(folder):
    """One Curves for each combination of the other parameters. Raises TableError, ResultError."""
    folder = pathlib.Path(folder)
    groups = {}
    for row in read_table(folder / TABLE):
        keys = [key for key in row if key in PARAMETERS or key.startswith(OPTION)]
        fixed = {key: row[key] for key in keys if key not in FREE}
        curves = groups.setdefault(tuple(fixed.items()), Curves(fixed))
        strategy = row["strategy"]
        curves.labels.setdefault(strategy, row["label"])
        if row["latency"] == "gl":
            curves.driver[strategy] = _read_driver(folder, row)
        else:
            unit, count = row["latency"].split(":")
            curves.fixed.setdefault((strategy, unit), []).append((int(count), row))
    for curves in groups.values():
        for rows in curves.fixed.values():
            rows.sort(key=lambda pair: pair[0])
    return list(groups.values())


def _read_driver(folder, row):
    run = read_run(folder / CELLS / row["cell"], frames=False)
    driver = Driver({key: float(row[key]) for key in VALUES if row.get(key)})
    for key in COUNTERS:
        means = means_by_repetition(run, row["strategy"], key)
        driver.spreads[key] = bootstrap_interval(means)
        driver.repetitions = max(driver.repetitions, len(means))
    return driver


def place(draws):
    """Where a latency in draws stands on a log-like axis that has a 0."""
    return np.log10(1 + np.asarray(draws, dtype=float))


def find_equivalent(latencies, values, target):
    """Latencies in draws at which the curve, straight between its points on the axis of place(),
    has the value `target`: a list of (below, at, above), the tested ones around it and the
    interpolated one, ascending. Empty if the curve does not reach it. A stretch at that very value
    counts with its first point."""
    places, found = place(latencies), []
    for i in range(len(values) - 1):
        a, b = values[i] - target, values[i + 1] - target
        if a == 0:
            if i == 0 or values[i - 1] != target:
                found.append((latencies[i], float(latencies[i]), latencies[i]))
        elif a * b < 0:
            at = places[i] + (places[i + 1] - places[i]) * a / (a - b)
            found.append((latencies[i], float(10**at - 1), latencies[i + 1]))
    if len(values) and values[-1] == target and (len(values) == 1 or values[-2] != target):
        found.append((latencies[-1], float(latencies[-1]), latencies[-1]))
    return found


def describe_equivalent(curves, strategy, key):
    """What latency the driver's value is worth, in words; None if there is nothing to compare."""
    driver = curves.driver.get(strategy)
    latencies, values = curves.points(strategy, "draws", key)
    if key == "d" and curves.delays_all(strategy):
        return None
    if driver is None or key not in driver.means or len(values) < 2 or values.min() == values.max():
        return None
    found = find_equivalent(latencies, values, driver.means[key])
    if len(found) == 1:
        below, at, above = found[0]
        if below == above:
            return f"{below:.0f} draws"
        return f"about {at:.0f} draws (between {below:.0f} and {above:.0f})"
    if found:
        return "several: " + ", ".join(f"{at:.0f}" for _, at, _ in found) + " draws"
    low, high = values.min(), values.max()
    side = "below" if driver.means[key] < low else "above"
    return f"none: {driver.means[key]:.4g} is {side} {low:.4g} to {high:.4g}"
