"""How often the rule errs: nights that never were, of pairs of replays that were.

A night's cell draws its pairs with replacement from real ones, each with all its quantities, as
they were measured together: that is a bootstrap, and it knows only the noise that these pairs had.
The cell is judged, and measured again, by the code that judges real ones.
"""

import json
import pathlib
from dataclasses import dataclass

import numpy as np

from .errors import TrackingError
from .migrate import VERSION
from .shapes import find_damage
from .timing import (FRAME, combine, confirm_quantities, is_change, judge_quantities)

SAME_BUILD = ""  # the slowdown of pairs of the same program with itself


@dataclass(frozen=True)
class Group:
    """Pairs of one cell: new / base by quantity, all of equal length."""

    cell: str
    slowdown: str  # as HLODBENCH_TEST_SLOWDOWN of new, or SAME_BUILD
    ratios: dict
    means: dict  # {stage: ms} of base

    def __len__(self):
        return len(self.ratios[FRAME])

    def draw(self, rng, count):
        """Some of its pairs, {quantity: [ratios]}. Which one of the same build is called new is
        drawn, too: else each night would have what chance left in so few pairs."""
        chosen = rng.integers(0, len(self), count)
        powers = rng.choice((-1, 1), count) if self.slowdown == SAME_BUILD else np.ones(count)
        return {quantity: values[chosen] ** powers for quantity, values in self.ratios.items()}


def read_pairs(path):
    """The groups of a file of scripts/nightly_pairs.py. Raises TrackingError."""
    try:
        data = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        return [Group(group["cell"], group["slowdown"],
                      {q: np.array(values) for q, values in group["ratios"].items()},
                      group["means"]) for group in data["groups"]]
    except OSError as error:
        raise TrackingError(f"{path}: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise TrackingError(f"{path}: expected pairs of nightly_pairs.py, found {error!r}") from None


def read_history_groups(folder, fewest=9):
    """Groups of the nights below `folder` that had a baseline, a cell of a night each: as if
    nothing had changed (by their own median), and without stages' part of a frame."""
    groups = []
    for path in sorted(pathlib.Path(folder).rglob("*.json")):
        try:
            data = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            continue
        if not isinstance(data, dict) or data.get("schema") != VERSION or find_damage(data):
            continue
        for cell, samples in ((data.get("timing") or {}).get("cells") or {}).items():
            ratios = {q: np.array(values) / np.median(values)
                      for q, values in (samples.get("ratios") or {}).items()}
            counts = {len(values) for values in ratios.values()}
            if FRAME in ratios and counts == {len(ratios[FRAME])} and min(counts) >= fewest:
                groups.append(Group(cell, SAME_BUILD, ratios, {}))
    return groups


def slow_down(group, slowdown, share):
    """The group with all its times made longer by a share, from what their median is: what chance
    left in so few pairs would be a change, too."""
    return Group(group.cell, slowdown,
                 {q: v / np.median(v) * (1 + share) for q, v in group.ratios.items()}, group.means)


@dataclass(frozen=True)
class Setting:
    """Of a simulation."""

    repetitions: int = 9
    cells: int = 5
    nights: int = 1000
    seed: int = 1


def simulate(groups, setting, rule):
    """[[(verdict, stage or None) of each cell] of each night]. Each cell draws from one of the
    groups by chance."""
    rng = np.random.default_rng(setting.seed)
    return [[_decide(rng, groups[rng.integers(len(groups))], setting.repetitions, rule)
             for _ in range(setting.cells)] for _ in range(setting.nights)]


def _decide(rng, group, repetitions, rule):
    verdicts = judge_quantities(group.draw(rng, repetitions), rule)
    if any(map(is_change, verdicts.values())):
        again = judge_quantities(group.draw(rng, repetitions), rule)
        verdicts = confirm_quantities(verdicts, again)
    verdict, stage = combine(verdicts, group.means)
    return verdict.verdict, stage


def share_of_cells(nights, verdict):
    """The share of all cells with a verdict."""
    return float(np.mean([found == verdict for night in nights for found, _ in night]))


def share_of_nights(nights, verdict):
    """The share of nights with a cell of that verdict."""
    return float(np.mean([any(found == verdict for found, _ in night) for night in nights]))


def share_of_stage(nights, verdict, stage):
    """The share of the cells with a verdict in which that stage is named; NaN if there are none."""
    named = [found == stage for night in nights for v, found in night if v == verdict]
    return float(np.mean(named)) if named else float("nan")
