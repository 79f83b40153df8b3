"""The history: a folder of files that are only ever added.

    HISTORY/<machine key>/<UTC time>-<revision>-<random>.json          a night
    HISTORY/<machine key>/<UTC time>-accept-<random>.json              an acceptance

Order: each file carries a `sequence`, one more than the largest that its writer saw in the folder,
so that what was written with knowledge of another stands after it, whatever the clocks say. Files
of the same sequence (two at once, or folders brought together) are ordered by time, then by name.
"""

import datetime
import json
import os
import pathlib
import re
import secrets
import time
from dataclasses import dataclass, field

from atomic_file import write_atomically

from .errors import TrackingError
from .migrate import VERSION, UnknownVersion, migrate
from .shapes import find_damage

TIME = "%Y-%m-%dT%H:%M:%SZ"
KEY = re.compile(r"[a-z0-9][a-z0-9-]*")
LEFT_OVER_S = 3600  # a temporary file older than this belongs to a writer that was killed


@dataclass
class Entry:
    """A file of the history."""

    id: str  # its name without .json
    data: dict  # in the present version

    @property
    def order(self):
        """What entries of one machine are sorted by."""
        return (self.data["sequence"], self.data["time_utc"], self.id)


@dataclass
class History:
    """What is readable of one machine's folder, in order."""

    nights: list = field(default_factory=list)  # of Entry
    acceptances: list = field(default_factory=list)  # of Entry
    problems: list = field(default_factory=list)  # of str, one line each

    @property
    def next_sequence(self):
        """That of a file that is written now."""
        return 1 + max((e.data["sequence"] for e in self.nights + self.acceptances), default=0)

    def night(self, identity):
        """The night of this id, or None."""
        return next((night for night in self.nights if night.id == identity), None)


def list_machines(folder):
    """The keys of the machines that have a folder, sorted."""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        return []
    return sorted(p.name for p in folder.iterdir() if p.is_dir() and KEY.fullmatch(p.name))


def read_history(folder, key):
    """The History of one machine. What cannot be read is left out and named in `problems`; only a
    folder that cannot be listed raises OSError. A machine without a folder has an empty one."""
    history = History()
    place = pathlib.Path(folder) / key
    if not place.exists():
        return history
    for path in sorted(place.glob("*.json")):
        data = _read(path, key, history.problems)
        if data is not None:
            is_night = data["kind"] == "night"
            (history.nights if is_night else history.acceptances).append(Entry(path.stem, data))
    history.nights.sort(key=lambda entry: entry.order)
    history.acceptances.sort(key=lambda entry: entry.order)
    for earlier, later in zip(history.nights, history.nights[1:]):
        if later.data["time_utc"] < earlier.data["time_utc"]:
            history.problems.append(
                f"{place / later.id}.json: the clock went back: {later.data['time_utc']} comes "
                f"after {earlier.data['time_utc']}; kept in the order of writing")
    return history


def _read(path, key, problems):
    """One file's contents in the present version, or None."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(data, dict):
            raise UnknownVersion(f"expected an object, found {str(data)[:40]!r}")
        data, notes = migrate(data, key)
    except UnknownVersion as error:
        problems.append(f"{path}: {error}")
        return None
    except (OSError, ValueError, RecursionError) as error:
        problems.append(f"{path}: expected JSON, found a damaged file, skipped: {error}")
        return None
    flaw = find_damage(data)
    found = data["machine"]["key"] if not flaw and data["kind"] == "night" else key
    if not flaw and data["kind"] == "acceptance":
        found = data["machine_key"]
    if not flaw and found != key:
        flaw = f"expected a file of the machine {key}, found one of {found}"
    if flaw:
        problems.append(f"{path}: damaged, skipped: {flaw}")
        return None
    problems.extend(f"{path}: {note}" for note in notes)
    return data


def append(folder, key, data, label):
    """Adds a file, whole or not at all, and returns its path. data: without `schema`. label: in the
    file's name, after the time."""
    place = pathlib.Path(folder) / key
    place.mkdir(parents=True, exist_ok=True)
    _sweep(place)
    stamp = re.sub(r"[-:]", "", data["time_utc"])
    label = re.sub(r"[^A-Za-z0-9]+", "", label)[:16] or "unknown"
    path = place / f"{stamp}-{label}-{secrets.token_hex(4)}.json"
    text = json.dumps({"schema": VERSION, **data}, indent=1) + "\n"
    with write_atomically(path) as temporary, open(temporary, "w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())  # a name must not outlive a power cut without its contents
    return path


def _sweep(place):
    """Takes away what killed writers left."""
    for path in place.glob(".*.tmp"):
        try:
            if time.time() - path.stat().st_mtime > LEFT_OVER_S:
                path.unlink()
        except OSError:
            pass  # another one was faster


def now_utc():
    """The time, as files have it."""
    return datetime.datetime.now(datetime.timezone.utc).strftime(TIME)


def choose_machine(folder, wanted):
    """The key that begins with `wanted`, or the only one there is if that is None. Raises
    TrackingError if there is none, or more than one."""
    keys = [key for key in list_machines(folder) if key.startswith(wanted or "")]
    if len(keys) == 1:
        return keys[0]
    which = f"a machine whose key begins with {wanted!r}" if wanted else "one machine"
    raise TrackingError(f"{folder}: expected {which}, found {', '.join(keys) or 'none'}"
                        + ("; name it by --key" if keys else ""))
