"""Exact values: those of a result folder with a fixed latency, and what differs between nights.

A night's values of a cell are flat, by name: `dn` is a mean over the measured frames, `dn.frames` a
hash of the column of the frame log, `picture.20` one of a picture's pixels. Nothing of it depends on
how long anything took; any difference is one.
"""

import csv
import hashlib

from result_folder import ResultError, read_run

from .errors import TrackingError

COUNTERS = ("dn", "rarn", "d", "delays", "queries", "triangles", "nodes_visited", "queries_wasted",
            "repeated_delays", "front_change")
HASH_LENGTH = 16
SAME, DIFFERENT, NEW = "SAME", "DIFFERENT", "NEW"


def read_exact(folder):
    """The values by strategy, and run.json. Raises TrackingError if the folder lacks any."""
    try:
        run = read_run(folder, frames=False)
    except ResultError as error:
        raise TrackingError(str(error)) from None
    values = {}
    for case in run.cases:
        if case.repetition != 0:
            continue
        if case.error or not case.summary:
            raise TrackingError(f"{folder}: {case.strategy}: {case.error or 'not measured'}")
        entry = next(c for c in run.data["cases"] if c["strategy"] == case.strategy)
        values[case.strategy] = {
            "scene": run.data["scene"].get("hash", ""),
            "session": run.data["session"].get("hash", ""),
            **_read_counters(case.summary), **_hash_columns(run.folder / str(entry.get("csv"))),
            **_read_pictures(run, case.strategy)}
    return values, run.data


def _read_counters(summary):
    counters = summary.get("counters") or {}
    return {key: counters[key]["mean"] for key in COUNTERS if key in counters}


def _hash_columns(path):
    """A hash of each exact column of a frame log, of its fields as they stand."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        columns = dict(zip(rows[0], zip(*rows[1:], strict=True)))
    except (OSError, ValueError, IndexError, csv.Error) as error:
        raise TrackingError(f"{path}: expected a frame log: {error}") from None
    return {f"{key}.frames": _hash(",".join(columns[key]).encode())
            for key in COUNTERS if any(columns.get(key, ()))}


def _read_pictures(run, strategy):
    """Mean PSNR, wrong and crack pixels, and a hash of each picture's pixels (of the file, its
    compression would be in it)."""
    if not run.images:
        return {}
    entry = next((s for s in run.images["strategies"] if s["strategy"] == strategy), None)
    if entry is None:
        raise TrackingError(f"{run.folder}: {strategy}: expected pictures, found none")
    values, summary = {}, entry.get("summary") or {}
    for against in ("vs_reference", "vs_full"):
        for plane, component in (summary.get(against) or {}).items():
            if component.get("mean") is not None:
                values[f"psnr_{against}_{plane}"] = component["mean"]
            values[f"identical_{against}_{plane}"] = component["identical"]
    wrong = (summary.get("wrong_share") or {}).get("mean")
    if wrong is not None:
        values["wrong_share"] = wrong
    if summary.get("crack_pixels") is not None:
        values["crack_pixels"] = summary["crack_pixels"]
    for frame in run.images["frames"]:
        pixels = run.image(strategy, frame)
        if pixels is None:
            raise TrackingError(run.problems[-1] if run.problems
                                else f"{run.folder}: {strategy}: no picture of frame {frame}")
        values[f"picture.{frame}"] = _hash(repr(pixels.shape).encode() + pixels.tobytes())
    return values


def _hash(data):
    return hashlib.sha256(data).hexdigest()[:HASH_LENGTH]


def find_differences(old, new):
    """What differs, as a list of {"key", "old", "new"}, old or new None where it is absent.

    A value that was not there before is no difference: a new counter says nothing of the old ones.
    One that is gone is: it may have a new name (migrate.RENAMED).
    """
    return [{"key": key, "old": value, "new": new.get(key)} for key, value in old.items()
            if new.get(key) != value]


def find_reference(history, cell):
    """(id, values) of the last accepted night of a cell; (None, None) if it has none.

    The first night is accepted as it stands, unless it says itself that it differs from one that is
    not readable any more. Later ones are where an acceptance names them; if that night is not readable
    any more, one that was the same stands in for it. Counters that came later are those of the first
    night that has them.
    """
    accepted = {}
    for entry in history.acceptances:
        if cell in entry.data["cells"]:
            accepted = entry.data
    verdicts = [(night.data["verdicts"].get(cell) or {}).get("exact") or {}
                for night in history.nights]
    nights = [(night, verdict) for night, verdict in zip(history.nights, verdicts)
              if cell in night.data["exact"]]
    start = None
    if accepted:
        start = next((i for i, (night, verdict) in enumerate(nights)
                      if accepted["night"] in (night.id, verdict.get("reference"))
                      and (night.id == accepted["night"] or verdict.get("verdict") == SAME)), None)
    if start is None:
        start = next((i for i, (_, verdict) in enumerate(nights)
                      if verdict.get("verdict") != DIFFERENT), None)
    if start is None:
        return None, None
    values = dict(nights[start][0].data["exact"][cell])
    for night, verdict in nights[start + 1:]:
        if verdict.get("verdict") == SAME:  # counters that came later
            values = {**night.data["exact"][cell], **values}
    return nights[start][0].id, values


def judge_exact(history, cell, values):
    """The member "exact" of a cell's verdict."""
    identity, old = find_reference(history, cell)
    if identity is None:
        return {"verdict": NEW, "reference": None, "differences": []}
    differences = find_differences(old, values)
    return {"verdict": DIFFERENT if differences else SAME, "reference": identity,
            "differences": differences}


def describe_difference(difference):
    """One of them as a text."""
    key, old, new = difference["key"], difference["old"], difference["new"]
    if new is None:
        return f"{key} {_text(old)} is gone"
    if isinstance(old, str) or isinstance(new, str) or not old:
        return f"{key} {_text(old)} -> {_text(new)}"
    return f"{key} {_text(old)} -> {_text(new)} ({100 * (new / old - 1):+.3g} %)"


def _text(value):
    return value if isinstance(value, str) else f"{value:.8g}"
