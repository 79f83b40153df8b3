"""The numbers of the trend page: a series over the nights for each scene, counter and strategy."""

from report.series import describe_counter

from .calibration import NONE
from .change_points import find_change_points, find_steps
from .shapes import is_number
from .statistics import compute_interval, compute_paired_change
from .timing import FRAME, STAGES

TIME, NORMALISED, RATIO = "time.ms", "time.normalised", "time.ratio"
TIMES = {
    TIME: ("frame time, median", "ms", 3),
    NORMALISED: ("frame time / calibration", "", 3),
    RATIO: ("frame time / baseline's", "", 4),
    **{f"{RATIO}.{stage}": (f"{stage} / baseline's", "", 4) for stage in STAGES},
}
AGAINST = {"vs_reference": "Bool", "vs_full": "the full model"}
OTHERS = {"wrong_share": ("share of wrong pixels", "", 6), "crack_pixels": ("crack pixels", "", 0)}
DIGITS = 6  # significant ones, of times


def list_counters(machines):
    """Descriptions of all counters, those of times first, of the series by machine."""
    keys = dict.fromkeys(key for scenes in machines for counters in scenes.values()
                         for key in counters)
    first = [key for key in TIMES if key in keys]
    return [describe(key) for key in first + [key for key in keys if key not in TIMES]]


def describe(key):
    """What the page needs to know of a counter."""
    named = TIMES.get(key) or OTHERS.get(key)
    for against, name in AGAINST.items():
        if key.startswith(f"psnr_{against}_"):
            named = (f"PSNR {key.rsplit('_', 1)[1].capitalize()} against {name}", "dB", 3)
        if key.startswith(f"identical_{against}_"):
            plane = key.rsplit("_", 1)[1].capitalize()
            named = (f"pictures identical to {name}'s in {plane}", "", 0)
    if not named:
        return {**describe_counter(key), "exact": True}
    return {"key": key, "name": named[0], "unit": named[1], "digits": named[2],
            "exact": key not in TIMES}


def make_series(nights):
    """{scene: {counter: {strategy: series}}} of a machine's nights, in order.

    Of an exact counter a series is {"runs": [[value or None, nights in a row]], "changes"}; of
    times {"values", "low", "high", "changes"}. A change is [index of the night, level before,
    after].
    """
    scenes = {}
    for cell in dict.fromkeys(cell for night in nights for cell in _cells(night)):
        scene, _, strategy = cell.partition("/")
        for key, series in {**_make_exact(nights, cell), **_make_times(nights, cell)}.items():
            scenes.setdefault(scene, {}).setdefault(key, {})[strategy] = series
    return scenes


def _cells(night):
    return [*night["exact"], *((night.get("timing") or {}).get("cells") or {})]


def _make_exact(nights, cell):
    rows = [night["exact"].get(cell) or {} for night in nights]
    made = {}
    for key in dict.fromkeys(k for row in rows for k, v in row.items() if is_number(v)):
        values = [row.get(key) if is_number(row.get(key)) else None for row in rows]
        made[key] = {"runs": find_runs(values), "changes": _list(find_steps(values))}
    return made


def find_runs(values):
    """[[value, how many in a row]]: exact values hardly ever change, and the page stays small."""
    runs = []
    for value in values:
        if runs and runs[-1][0] == value:
            runs[-1][1] += 1
        else:
            runs.append([value, 1])
    return runs


def _make_times(nights, cell):
    samples = [((night.get("timing") or {}).get("cells") or {}).get(cell) for night in nights]
    workloads = [_find_workload(night) for night in nights]
    last = next((w for w in reversed(workloads) if w), None)
    intervals = {key: [] for key in TIMES}
    for sample, workload in zip(samples, workloads):
        time = compute_interval(sample["new"]) if sample else None
        factor = sample.get("calibration") if sample and workload and workload == last else None
        intervals[TIME].append(time)
        intervals[NORMALISED].append(tuple(v / factor for v in time) if factor else None)
        ratios = _find_ratios(sample) if sample and sample.get("base") else {}
        intervals[RATIO].append(_find_interval(ratios.get(FRAME)))
        for stage in STAGES:
            intervals[f"{RATIO}.{stage}"].append(_find_interval(ratios.get(stage)))
    return {key: _make_band(rows) for key, rows in intervals.items() if any(rows)}


def _find_workload(night):
    """The calibration's; None without one."""
    calibration = (night.get("timing") or {}).get("calibration")
    found = calibration.get("workload") if isinstance(calibration, dict) else None
    return None if found == NONE else found


def _find_ratios(sample):
    """{quantity: [new / base]}; of nights from before there were several, that of the frame."""
    pairs = [new / base for new, base in zip(sample["new"], sample["base"])]
    return sample.get("ratios") or {FRAME: pairs}


def _find_interval(ratios):
    if not ratios:
        return None
    try:
        change = compute_paired_change(ratios)
    except OverflowError:  # no times of this world
        return None
    return 1 + change.value, 1 + change.low, 1 + change.high


def _make_band(rows):
    columns = {name: [_round(row[i]) if row else None for row in rows]
               for i, name in enumerate(("values", "low", "high"))}
    found = find_change_points([row[0] if row else None for row in rows])
    return {**columns, "changes": _list(found)}


def _list(points):
    return [[point.index, _round(point.before, 10), _round(point.after, 10)] for point in points]


def _round(value, digits=DIGITS):
    return float(f"{value:.{digits}g}")
