"""Counters by frame, as the plots and the tables of single frames want them."""

import math

from .styles import make_styles

# key -> name, unit where the name does not say it, digits behind the point (stored and shown)
COUNTERS = {
    "dn": ("DN: drawn nodes", "", 2),
    "rarn": ("RARN: rendered, then refined", "", 2),
    "d": ("D: delayed, then drawn", "", 2),
    "delays": ("all delayed nodes", "", 2),
    "queries": ("queries issued", "", 2),
    "triangles": ("triangles drawn", "", 2),
    "nodes_visited": ("nodes visited", "", 2),
    "queries_wasted": ("queries that confirmed a Stop", "", 2),
    "repeated_delays": ("delays that repeated the last frame", "", 2),
    "front_change": ("nodes drawn in one of two frames only", "", 2),
    "frame_ms": ("frame time", "ms", 3),
    "cpu_ms": ("processor time", "ms", 3),
    "wait_ms": ("waiting for queries", "ms", 3),
    "gpu_ms": ("GPU time", "ms", 3),
    "missing_nodes": ("nodes not on the GPU, drawn as an ancestor", "", 2),
    "loads": ("nodes loaded", "", 2),
    "evictions": ("nodes evicted", "", 2),
    "resident_mib": ("geometry on the GPU", "MiB", 2),
    "predicted_right": ("predictions: right", "", 2),
    "too_conservative": ("predictions: too conservative", "", 2),
    "too_aggressive": ("predictions: too aggressive", "", 2),
    "needless_delays": ("predictions: needless delay", "", 2),
    "invisible_nodes": ("nodes drawn, nothing seen", "", 2),
    "visible_triangles": ("triangles seen", "", 2),
    "invisible_triangles": ("triangles drawn, not seen", "", 2),
}
OTHER_DIGITS = 3
NO_COUNTERS = ("frame", "warm_up")


def list_counters(run):
    """Keys of the counters that any case has, in the order of the frame logs."""
    keys = dict.fromkeys(key for case in run.cases for key in case.columns)
    return [key for key in keys if key not in NO_COUNTERS]


def describe_counter(key):
    """What the page needs to know of a counter."""
    name, unit, digits = COUNTERS.get(key, (key, "", OTHER_DIGITS))
    return {"key": key, "name": name, "unit": unit, "digits": digits}


def make_series(run, strategy, counter):
    """The counter by frame: one number or None for each frame of the session, rounded to the
    digits shown, so that what is seen is what is stored."""
    digits = describe_counter(counter)["digits"]
    values = [round(float(v), digits) if math.isfinite(v) else None
              for v in run.frame_means(strategy, counter)]
    frames = run.data["session"]["frames"]
    values += [None] * (frames - len(values))
    # Whole numbers without ".0" make the file a good deal smaller.
    return [int(v) if v is not None and v == int(v) else v for v in values[:frames]]


def make_scene_data(run):
    """The numbers of one scene for the page's scripts."""
    counters = [describe_counter(key) for key in list_counters(run)]
    strategies = run.strategies()
    shown = strategies + [s for s in run.image_strategies() if s not in strategies]
    styles = make_styles(shown)
    return {
        "name": run.scene,
        "frames": run.data["session"]["frames"],
        "counters": counters,
        "strategies": [{"id": s, "label": run.label(s), **styles[s]} for s in shown],
        "plotted": strategies,
        "series": {c["key"]: {s: make_series(run, s, c["key"]) for s in strategies}
                   for c in counters},
    }
