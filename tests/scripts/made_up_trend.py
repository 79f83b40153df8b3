"""A history of many nights on two machines, for the tests of the trend page."""

import copy
import datetime

import numpy as np
from made_up_nights import CONTEXT
from tracking.history import append
from tracking.machine import describe_machine

MACHINES = (describe_machine(CONTEXT), describe_machine(CONTEXT, "lab"))
KEYS = tuple(machine["key"] for machine in MACHINES)
STRATEGIES = {"bool": 24.0, "sw-b": 16.0, "coh-b": 10.0}  # ms
SLOWER_FROM, DN_FROM, UNTIMED = 25, 40, (10, 11, 33)
STAGES_FROM = 20  # before, only frames were compared
WHY = "Coh(B) pulls up <b>one</b> node less"


def make_night(number, rng, machine, slower_from=SLOWER_FROM, revision=None):
    """A night: coh-b is slower from `slower_from` on and draws less from DN_FROM on."""
    day = datetime.datetime(2026, 1, 1, 3) + datetime.timedelta(days=number)
    exact, verdicts, cells = {}, {}, {}
    for strategy, time in STRATEGIES.items():
        cell = f"courtyard/{strategy}"
        is_less = strategy == "coh-b" and number >= DN_FROM
        dn = (118.25 if is_less else 120.5) + len(strategy)
        exact[cell] = {"dn": dn, "triangles": 1000 * dn, "dn.frames": f"{dn}", "scene": "00",
                       "psnr_vs_reference_y": 41.5 - 0.25 * is_less, "crack_pixels": 3}
        is_first = is_less and number == DN_FROM
        differences = [{"key": "dn", "old": 125.5, "new": dn},
                       *({"key": f"picture.{i}", "old": "aa", "new": "bb"} for i in range(5))]
        verdicts[cell] = {"exact": {"verdict": "DIFFERENT" if is_first else "SAME",
                                    "reference": None,
                                    "differences": differences if is_first else []},
                          "timing": None}
        level = time * (1.12 if strategy == "coh-b" and number >= slower_from else 1.0)
        luck = 1 + rng.normal(0, 0.01)
        new, base = ([round(v, 4) for v in level_ * luck * (1 + rng.normal(0, 0.02, 9))]
                     for level_ in (level, time))
        cells[cell] = {"new": new, "base": base, "stages": {"new": {}, "base": {}},
                       "calibration": 1.5 * luck}
        if number >= STAGES_FROM:
            pairs = [a / b for a, b in zip(new, base)]
            cells[cell]["ratios"] = {"frame": pairs, "draw": [v ** 2 for v in pairs]}
        is_slow = strategy == "coh-b" and number == slower_from
        if number not in UNTIMED:
            verdicts[cell]["timing"] = {
                "verdict": "SLOW" if is_slow else "SAME",
                "reason": "p = 0.001, A12 = 1.00" if is_slow else "interval within +-3 %",
                "change": 0.12 if is_slow else 0.001, "low": 0.1 if is_slow else -0.01,
                "high": 0.13 if is_slow else 0.01, "p": 0.001, "a12": 1.0,
                "stage": "draw_ms +1 ms" if is_slow else None}
    timing = {"mode": "baseline", "repetitions": 9, "seed": 1, "baseline": "v0.1",
              "calibration": {"workload": "numpy-1/2", "seconds": [1.5]}, "others_share": 0.01,
              "rule": {"min_change": 0.03}, "cells": cells}
    return copy.deepcopy({
        "kind": "night", "sequence": number + 1, "time_utc": day.strftime("%Y-%m-%dT%H:%M:%SZ"),
        "revision": revision or f"{number:02d}cdef012345", "machine": machine,
        "context": {"kernel": "Linux"}, "exact": exact,
        "timing": None if number in UNTIMED else timing, "verdicts": verdicts})


def write_history(folder, nights=60, revision=None):
    """Fills a folder; ids of the nights of the first machine. The second machine has fewer, is not
    slower, and accepts nothing."""
    ids = []
    for machine, count in zip(MACHINES, (nights, (2 * nights + 2) // 3)):
        rng = np.random.default_rng(count)
        for number in range(count):
            is_first = machine is MACHINES[0]
            night = make_night(number, rng, machine, SLOWER_FROM if is_first else 10**6,
                               revision if number == 0 else None)
            if is_first:
                night["context"]["results"] = f"../nightly/{number}"
            path = append(folder, machine["key"], night, night["revision"])
            if is_first:
                ids.append(path.stem)
    if nights > DN_FROM:
        append(folder, KEYS[0], {
            "kind": "acceptance", "sequence": nights + 1, "time_utc": "2026-06-01T04:00:00Z",
            "machine_key": KEYS[0], "night": ids[DN_FROM], "cells": ["courtyard/coh-b"],
            "who": "A. Nother", "why": WHY}, "accept")
    return ids
