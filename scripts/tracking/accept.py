"""Who took a change for good, and why: a file of its own, as nothing in the history is changed."""

import subprocess

from .errors import TrackingError
from .exact import DIFFERENT
from .history import append, choose_machine, now_utc, read_history


def accept(folder, wanted, cells, who, why):
    """Accepts the newest night of a machine, for some cells or for all that changed in it.

    wanted: the beginning of the machine's key, or None if there is only one. cells: none for all.
    Returns (path, cells, problems). Raises TrackingError.
    """
    if not why or not why.strip():
        raise TrackingError("accept: --why expects a reason, found none")
    key = choose_machine(folder, wanted)
    history = read_history(folder, key)
    if not history.nights:
        raise TrackingError(f"{folder}/{key}: expected a night, found none that is readable")
    night = history.nights[-1]
    unknown = [cell for cell in cells if cell not in night.data["exact"]]
    if unknown:
        raise TrackingError(f"accept: --cell {unknown[0]}: expected one of "
                            f"{', '.join(night.data['exact'])}")
    cells = list(dict.fromkeys(cells)) or list_changed(night)
    if not cells:
        raise TrackingError(f"accept: nothing to accept: {night.id} has no cell that changed")
    data = {"kind": "acceptance", "sequence": history.next_sequence, "time_utc": now_utc(),
            "machine_key": key, "night": night.id, "cells": cells,
            "who": who or find_user(), "why": why.strip()}
    return append(folder, key, data, "accept"), cells, history.problems


def list_changed(night):
    """Cells of a night that are DIFFERENT, SLOW or FAST."""
    changed = []
    for cell, verdict in night.data["verdicts"].items():
        exact, timing = verdict.get("exact") or {}, verdict.get("timing") or {}
        if exact.get("verdict") == DIFFERENT or timing.get("verdict") in ("SLOW", "FAST"):
            changed.append(cell)
    return changed


def find_user():
    """Git's user, as commits have it."""
    parts = []
    for name in ("user.name", "user.email"):
        try:
            done = subprocess.run(["git", "config", name], capture_output=True, text=True,
                                  check=False)
        except OSError:
            break
        parts.append(done.stdout.strip())
    if not parts or not parts[0]:
        raise TrackingError("accept: git knows no user.name; say who accepts it by --who")
    return f"{parts[0]} <{parts[1]}>" if len(parts) > 1 and parts[1] else parts[0]
