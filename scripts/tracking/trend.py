"""The page of the history: one HTML file that loads nothing."""

import pathlib
from dataclasses import dataclass

from atomic_file import write_text_atomically
from report.page import PAGE_FOLDER, MissingLibrary, Parts, read_library, render_page
from report.styles import make_styles
from run_cells import ROOT

from .commits import find_subjects
from .errors import TrackingError
from .history import KEY, list_machines, read_history
from .shapes import is_number
from .timing import describe_change
from .trend_nights import describe_nights, list_lost
from .trend_series import list_counters, make_series

LIBRARY = pathlib.Path("/usr/share/javascript/dygraphs")
PARTS = Parts(
    folders=(pathlib.Path(__file__).resolve().parent / "page", PAGE_FOLDER),
    template="trend.html",
    styles=("base.css", "tables.css", "scene.css", "trend.css", "print.css"),
    scripts=("dom.js", "data.js", "theme.js", "plot.js", "swatch.js", "print.js", "trend_data.js",
             "trend_plot.js", "trend_machine.js", "trend_main.js"))
DASH = "–"


@dataclass(frozen=True)
class Trend:
    """What was written."""

    machines: int
    nights: int
    size: int  # bytes
    problems: list  # of what could not be read, one line each


def write_trend(folder, wanted, out, library=None):
    """Writes the page of a history. wanted: beginnings of keys, none for all machines. Raises
    TrackingError, and OSError if it cannot be written."""
    try:
        plotting = read_library(library or LIBRARY)
    except MissingLibrary as error:
        raise TrackingError(str(error)) from None
    histories = {key: read_history(folder, key) for key in choose(folder, wanted)}
    problems = list_foreign(folder)
    for history in histories.values():
        problems += history.problems + list_lost(history)
    if not any(history.nights for history in histories.values()):
        unreadable = f"; {len(problems)} files are not readable: {problems[0]}" if problems else ""
        raise TrackingError(f"{folder}: expected nights, found none{unreadable}")
    content = make_content(histories, folder, out, problems)
    text = render_page(plotting, content, PARTS)
    out.parent.mkdir(parents=True, exist_ok=True)
    write_text_atomically(out, text)
    return Trend(len(histories), sum(len(history.nights) for history in histories.values()),
                 len(text.encode()), problems)


def choose(folder, wanted):
    """Keys of machines that begin with any of `wanted`."""
    keys = list_machines(folder)
    for key in wanted:
        if not any(found.startswith(key) for found in keys):
            raise TrackingError(f"--machine: expected the beginning of one of "
                                f"{', '.join(keys) or 'none'}, found {key!r}")
    return [key for key in keys if not wanted or key.startswith(tuple(wanted))]


def list_foreign(folder):
    """A line for each thing in the history's folder that no nightly.sh has put there."""
    if not folder.is_dir():
        return []
    return [f"{path}: expected the folder of a machine, skipped"
            for path in sorted(folder.iterdir()) if not path.name.startswith(".")
            and not (path.is_dir() and KEY.fullmatch(path.name))
            and (path.is_dir() or path.suffix == ".json")]


def make_content(histories, folder, out, problems):
    """The variables of the page."""
    subjects = find_subjects(ROOT, (night.data["revision"] for history in histories.values()
                                    for night in history.nights))
    machines = []
    for key, history in histories.items():
        nights = describe_nights(history, subjects, folder, out)
        last = history.nights[-1].data if nights else None
        machines.append({
            "id": f"machine-{len(machines)}", "key": key, "nights": nights,
            "about": describe_machine(last) if last else "no readable nights",
            "verdicts": list_verdicts(last, nights[-1]) if last else [],
            "data": {"key": key, "nights": nights,
                     "series": make_series([night.data for night in history.nights])},
        })
    series = [machine["data"]["series"] for machine in machines]
    strategies = list(dict.fromkeys(s for scenes in series for counters in scenes.values()
                                    for lines in counters.values() for s in lines))
    styles = make_styles(strategies)
    return {
        "title": "nights", "machines": machines, "problems": problems,
        "scenes": list(dict.fromkeys(scene for scenes in series for scene in scenes)),
        "counters": list_counters(series), "strategies": strategies,
        "shared": {"counters": list_counters(series),
                   "strategies": [{"id": s, "label": s, **styles[s]} for s in strategies]},
    }


def describe_machine(night):
    """What draws there, in a line."""
    machine = night["machine"]
    parts = [machine.get("name"), machine.get("cpu_model"), machine.get("gl_renderer"),
             machine.get("gl_version"), machine.get("compiler")]
    return ", ".join(str(part) for part in parts if part)


def list_verdicts(night, described):
    """Rows of the table of a night: cell, exact, timing, change, why."""
    rows = []
    for cell, (exact, timing, why) in described["cells"].items():
        found = (night["verdicts"][cell].get("timing")) or {}
        numbers = [found.get(key) for key in ("change", "low", "high")]
        change = DASH
        if all(map(is_number, numbers)):
            change = describe_change(*numbers)
        rows.append((cell, exact or DASH, timing or DASH, change, why))
    return rows
