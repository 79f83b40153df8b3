"""How often the rule errs: nights that never were, of frame times that were.

The samples are relative deviations of replays from the mean of their group, a group being the
replays of one strategy in one result folder: what is left when nothing has changed. They are
widened by sqrt(n / (n - 1)), since the mean is their own. A night draws from them with replacement:
that is a bootstrap, and it knows only the noise that these replays had. It takes replays for
independent; a slow drift, which pairs are for, is in none of it.
"""

import json
import pathlib
from dataclasses import dataclass

import numpy as np

from result_folder import ResultError, read_run

from .migrate import VERSION
from .shapes import find_damage
from .timing import FAST, SLOW, confirm, judge_pairs

FEWEST = 3  # replays of a group

# The runs behind the table of docs/nightly.md, below results/reference: named one by one, so that a
# record that is added there changes neither the table nor the tests.
REFERENCE_RUNS = ("llvmpipe/reuse/times/courtyard", "llvmpipe/reuse/times/scene1",
                  "llvmpipe/reuse/times/scene2", "llvmpipe/scene1", "llvmpipe/scene2")


@dataclass(frozen=True)
class Group:
    """Deviations of one strategy's replays in one folder: natural logarithms."""

    name: str
    deviations: tuple


def read_reference_groups(root):
    """The groups of REFERENCE_RUNS; root: of the repository."""
    reference = root / "results" / "reference"
    return [group for run in REFERENCE_RUNS for group in read_groups(reference / run)]


def read_groups(folder):
    """The groups of all result folders below `folder`, without those with a fixed latency, and of
    all nights there (a history, or night.json): the baseline's frame times, or tonight's."""
    groups = []
    for path in sorted(pathlib.Path(folder).rglob("*.json")):
        if path.name == "run.json":
            samples = _read_run(path.parent)
        else:
            samples = _read_night(path)
        for name, times in samples.items():
            if len(times) >= FEWEST:
                logs = np.log(times)
                widened = (logs - logs.mean()) * np.sqrt(len(times) / (len(times) - 1))
                groups.append(Group(f"{path}:{name}", tuple(widened)))
    return groups


def _read_run(folder):
    """Frame times by strategy."""
    samples = {}
    try:
        run = read_run(folder, frames=False)
    except ResultError:
        return samples
    if (run.data.get("options") or {}).get("latency", "gl") != "gl":
        return samples
    for case in run.cases:
        if case.summary and case.summary.get("fps"):
            samples.setdefault(case.strategy, []).append(1000 / case.summary["fps"])
    return samples


def _read_night(path):
    """Frame times by cell."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    if not isinstance(data, dict) or data.get("schema") != VERSION or find_damage(data):
        return {}
    cells = (data.get("timing") or {}).get("cells") or {}
    return {cell: samples.get("base") or samples["new"] for cell, samples in cells.items()}


@dataclass(frozen=True)
class Setting:
    """Of a simulation."""

    repetitions: int = 9
    cells: int = 5
    nights: int = 1000
    pooled: bool = True  # each cell draws from all groups together; else from one group of chance
    seed: int = 1


def simulate(groups, change, setting, rule):
    """Verdicts of nights whose new program takes 1 + change times as long in every cell:
    [[verdict of each cell] of each night]."""
    rng = np.random.default_rng(setting.seed)
    together = np.concatenate([group.deviations for group in groups])
    nights = []
    for _ in range(setting.nights):
        night = []
        for _ in range(setting.cells):
            pool = (together if setting.pooled
                    else np.array(groups[rng.integers(len(groups))].deviations))
            night.append(_decide(rng, pool, change, setting.repetitions, rule))
        nights.append(night)
    return nights


def _decide(rng, pool, change, repetitions, rule):
    def measure():
        base, new = np.exp(rng.choice(pool, (2, repetitions)))
        return judge_pairs(base, new * (1 + change), rule)

    first = measure()
    if first.verdict not in (SLOW, FAST):
        return first.verdict
    return confirm(first, measure()).verdict


def share_of_cells(nights, verdict):
    """The share of all cells with a verdict."""
    return float(np.mean([cell == verdict for night in nights for cell in night]))


def share_of_nights(nights, verdict):
    """The share of nights with a cell of that verdict."""
    return float(np.mean([verdict in night for night in nights]))
