"""Files of the history that an earlier version wrote, and counters that had another name.

To change the format: raise VERSION, add a function that turns a file of the version before into
the next to STEPS, and leave the old ones: a file goes up step by step. To rename a counter of the
program: add the old name and the new one to RENAMED, in the same commit.
"""

VERSION = 1
RENAMED = {}  # old key of a counter -> its key now


class UnknownVersion(Exception):
    """A version that cannot be read; the message is the rest of a line."""


def migrate(data, key):
    """A file's contents in the present version, and what was done to it as texts. key: of the
    machine, the folder that it lies in. Raises UnknownVersion."""
    version = data.get("schema")
    if isinstance(version, bool) or not isinstance(version, int) or version < 0:
        raise UnknownVersion(f"schema: expected a whole number, found {str(version)[:40]!r}")
    if version > VERSION:
        raise UnknownVersion(f"schema: this version reads up to {VERSION}, found {version}; "
                             "skipped: a newer nightly.sh wrote it")
    notes = []
    while version < VERSION:
        data = STEPS[version](data, key)
        notes.append(f"schema: read version {version} as {version + 1}")
        version += 1
    renamed = rename_counters(data, RENAMED)
    notes += [f"counter {old} is now called {RENAMED[old]}" for old in renamed]
    return data, notes


def rename_counters(data, names):
    """Renames counters in the exact values of a night, in place; the old names that were there.
    A value of a counter is called by its key, or by its key, a dot and what it is."""
    found = []
    exact = data.get("exact")
    for cell, values in exact.items() if isinstance(exact, dict) else ():
        if not isinstance(values, dict):
            continue
        renamed = {}
        for key, value in values.items():
            counter, dot, rest = key.partition(".")
            if counter in names and counter not in found:
                found.append(counter)
            renamed[names.get(counter, counter) + dot + rest] = value
        exact[cell] = renamed
    return found


def _from_0(data, key):
    """Version 0 had only nights, one scene, no order but the time, and no verdicts: `counters` by
    strategy, and `scene`."""
    scene, counters = data.get("scene"), data.get("counters")
    if not isinstance(scene, str) or not isinstance(counters, dict):
        raise UnknownVersion("schema: expected scene and counters of version 0, found none")
    machine = data.get("machine") if isinstance(data.get("machine"), dict) else {}
    return {
        "schema": 1, "kind": "night", "sequence": 0, "time_utc": data.get("time"),
        "revision": data.get("revision"),
        "machine": {"gl_class": "software", **machine, "key": key},
        "exact": {f"{scene}/{strategy}": values for strategy, values in counters.items()},
        "timing": None, "verdicts": {},
    }


STEPS = {0: _from_0}
