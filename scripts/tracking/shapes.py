"""What readers rely on in a file of the history (results/night.schema.json has all of it)."""

import math

from result_members import find_flaw

NIGHT = {
    "kind": str, "sequence": int, "time_utc": str, "revision": str,
    "machine": {"key": str, "gl_class": str},
    "exact": {}, "verdicts": {}, "timing?": {"mode": str, "cells": {}},
}
ACCEPTANCE = {"kind": str, "sequence": int, "time_utc": str, "machine_key": str, "night": str,
              "cells": [str], "who": str, "why": str}
SAMPLES = ("new", "base")


def find_damage(data):
    """Why a file of the present version cannot be used, as one line; None if it can."""
    if data.get("kind") == "acceptance":
        return find_flaw(data, ACCEPTANCE)
    if data.get("kind") != "night":
        return f"kind: expected night or acceptance, found {str(data.get('kind'))[:40]!r}"
    return find_flaw(data, NIGHT) or _check_exact(data) or _check_timing(data)


def _check_exact(data):
    for cell, values in data["exact"].items():
        if not isinstance(values, dict):
            return f"exact.{cell}: expected an object, found {str(values)[:40]!r}"
        for key, value in values.items():
            if not isinstance(value, str) and not is_number(value):
                return f"exact.{cell}.{key}: expected a number or text, found {str(value)[:40]!r}"
    for cell, verdict in data["verdicts"].items():
        flaw = find_flaw(verdict, {"exact?": {"verdict": str}, "timing?": {"verdict": str}},
                         f"verdicts.{cell}")
        if flaw:
            return flaw
    return None


def _check_timing(data):
    timing = data.get("timing")
    if not timing:
        return None
    for cell, samples in timing["cells"].items():
        if not isinstance(samples, dict):
            return f"timing.cells.{cell}: expected an object, found {str(samples)[:40]!r}"
        for side in SAMPLES:
            values = samples.get(side)
            if values is None and side == "base":
                continue
            if not _is_sample(values):
                return (f"timing.cells.{cell}.{side}: expected frame times above 0, "
                        f"found {str(values)[:40]!r}")
        if not is_number(samples.get("calibration", 1)) or samples.get("calibration", 1) <= 0:
            return f"timing.cells.{cell}.calibration: expected seconds above 0"
        ratios = samples.get("ratios", {})
        if not isinstance(ratios, dict) or not all(map(_is_sample, ratios.values())):
            return f"timing.cells.{cell}.ratios: expected lists of numbers above 0"
    return None


def _is_sample(values):
    return (isinstance(values, list) and len(values) > 0
            and all(is_number(v) and v > 0 for v in values))


def is_number(value):
    """Whether it is a finite number, and no whole one that is too large for a float."""
    if not isinstance(value, (int, float)) or isinstance(value, bool):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False
