"""How often the rule errs: nights that never were, of frame times that were.

The samples are relative deviations of replays from the mean of their group, a group being the
replays of one strategy in one result folder: what is left when nothing has changed. They are
widened by sqrt(n / (n - 1)), since the mean is their own. A night draws from them with replacement:
that is a bootstrap, and it knows only the noise that these replays had. It takes replays for
independent; a slow drift, which pairs are for, is in none of it.
"""

import pathlib
from dataclasses import dataclass

import numpy as np

from result_folder import ResultError, read_run

from .timing import FAST, SLOW, confirm, judge_pairs

FEWEST = 3  # replays of a group


@dataclass(frozen=True)
class Group:
    """Deviations of one strategy's replays in one folder: natural logarithms."""

    name: str
    deviations: tuple


def read_groups(folder):
    """The groups of all result folders below `folder`, without those with a fixed latency."""
    groups = []
    for path in sorted(pathlib.Path(folder).rglob("run.json")):
        try:
            run = read_run(path.parent, frames=False)
        except ResultError:
            continue
        if (run.data.get("options") or {}).get("latency", "gl") != "gl":
            continue
        rates = {}
        for case in run.cases:
            if case.summary and case.summary.get("fps"):
                rates.setdefault(case.strategy, []).append(case.summary["fps"])
        for strategy, values in rates.items():
            if len(values) >= FEWEST:
                logs = -np.log(values)
                widened = (logs - logs.mean()) * np.sqrt(len(values) / (len(values) - 1))
                groups.append(Group(f"{path.parent}:{strategy}", tuple(widened)))
    return groups


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
