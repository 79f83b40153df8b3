"""Nights for the tests of the history: what a file of it holds, and folders with some."""

import copy

from tracking.history import append
from tracking.machine import describe_machine
from tracking.timing import Verdict

CONTEXT = {"cpu_model": "A processor", "cpu_cores": 2, "compiler": "GCC 12.2.0",
           "build_type": "Release",
           "gl": {"vendor": "Mesa", "renderer": "llvmpipe (LLVM 15)", "version": "4.5 Mesa 22.3.6"}}
MACHINE = describe_machine(CONTEXT)
KEY = MACHINE["key"]
CELL = "courtyard/coh-b"
SLOWER = {"verdict": "SLOW", "reason": "p = 0.001", "change": 0.1, "low": 0.08, "high": 0.12,
          "p": 0.001, "a12": 1.0, "stage": "draw_ms +2 ms"}


def make_night(sequence, time="2026-01-02T03:04:05Z", dn=100.0, exact="SAME", timing=None,
               reference=None):
    """The contents of a file, without `schema`."""
    differences = [{"key": "dn", "old": 100.0, "new": dn}] if exact == "DIFFERENT" else []
    return copy.deepcopy({
        "kind": "night", "sequence": sequence, "time_utc": time, "revision": "0123456789ab",
        "machine": MACHINE, "context": {"kernel": "Linux"},
        "exact": {CELL: {"dn": dn, "dn.frames": f"{dn}", "scene": "00"}},
        "timing": None,
        "verdicts": {CELL: {"exact": {"verdict": exact, "reference": reference,
                                      "differences": differences}, "timing": timing}},
    })


def make_times(mode="baseline", new=(10.0, 10.1, 10.2), base=(10.0, 10.1, 10.2)):
    """The member "timing" of a night."""
    samples = {"new": list(new), "base": list(base) if mode == "baseline" else None,
               "stages": {"new": {"draw_ms": [1.0]}, "base": {}}}
    if mode == "history":
        samples["calibration"] = 1.0
    return {"mode": mode, "repetitions": 3, "seed": 1,
            "baseline": "ba5e" if mode == "baseline" else None,
            "calibration": {"workload": "numpy-1", "seconds": [1.0, 1.1]}, "others_share": 0.01,
            "rule": {"min_change": 0.03}, "cells": {CELL: samples}}


def make_acceptance(sequence, night, cells=(CELL,)):
    """The contents of a file, without `schema`."""
    return {"kind": "acceptance", "sequence": sequence, "time_utc": "2026-01-02T04:00:00Z",
            "machine_key": KEY, "night": night, "cells": list(cells), "who": "A. Nother",
            "why": "wanted"}


def add_night(folder, *arguments, **options):
    """Writes a night into a history; its id."""
    return append(folder, KEY, make_night(*arguments, **options), "0123456789ab").stem


def make_verdict(kind, low=None, high=None):
    """Of a quantity, with this interval and a change in its middle."""
    change = None if low is None else (low + high) / 2
    return Verdict(kind, "", change, low, high)
