"""Writes small folders like those of `hlodbench run`, for the tests of the scripts that read them.

    run = make_run(folder, strategies=("bool", "coh-b"), frames=30, image_frames=(10, 20))

Everything follows from the seed. What the folder says is true of itself: summaries and speedups
are computed from the CSVs, PSNR from the pictures. Damage is done by the caller.
"""

import json
from dataclasses import dataclass

import fake_pictures
import numpy as np

LABELS = {"bool": "Bool", "sw-b": "SW(B)", "simp-b": "Simp*(B)", "coh-b": "Coh(B)"}
STRATEGIES = tuple(LABELS)
# Mean drawn nodes, RARN and frame time (ms); others are made up from their place in the list.
LEVELS = {"bool": (136, 0, 36), "sw-b": (108, 0, 72), "simp-b": (129, 7, 39), "coh-b": (110, 1, 33)}
COLUMNS = ("frame", "warm_up", "dn", "rarn", "d", "delays", "queries", "triangles",
           "nodes_visited", "frame_ms", "cpu_ms", "wait_ms", "gpu_ms")
PREDICTING = ("simp-b", "coh-b")  # RARN and D mean something


@dataclass
class FakeRun:
    """What was made."""

    folder: object  # pathlib.Path
    data: dict  # run.json
    images: dict | None  # images/images.json
    frames: dict  # (strategy, repetition) -> {column: (frames,) floats, NaN where absent}
    pictures: dict  # (strategy or "full", frame) -> (height, width, 3) uint8


def make_run(folder, strategies=STRATEGIES, frames=40, repetitions=2, warm_up=5, image_frames=(),
             size=(64, 48), scene="fake", seed=1, failed=(), missing=(), overlays=("bias",),
             edit=None):
    """Writes a result folder and returns what is in it.

    image_frames: indices of the frames that have pictures; none: no folder images/.
    size: width and height of the pictures, pixels. overlays: written with the pictures.
    failed, missing: (strategy, repetition) of the cases that failed, or that an interruption left.
    edit: edit(pictures), called before the pictures are measured and written; it may change them.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    logs, cases = {}, []
    for repetition in range(repetitions):
        for strategy in strategies:
            log = _make_log(rng, strategies, strategy, frames, warm_up)
            if (strategy, repetition) in missing:
                continue
            case = _make_case(strategy, repetition, len(cases))
            if (strategy, repetition) in failed:
                case["error"] = "frame 2: no query result within 10 s"
            else:
                case["csv"] = f"{strategy}.{repetition}.csv"
                case["summary"] = _summarise(log)
                logs[strategy, repetition] = log
                _write_log(folder / case["csv"], log)
            cases.append(case)
    data = _make_head(scene, frames, repetitions, warm_up, strategies, size)
    data.update(complete=not missing, cases=cases, speedups=_speedups(cases, strategies),
                missing=[{"strategy": s, "repetition": r} for s, r in missing])
    write_json(folder / "run.json", data)
    images, pictures = None, {}
    if image_frames:
        shown = [s for s in strategies if (s, 0) in logs]
        pictures, images = fake_pictures.make(folder / "images", shown, sorted(image_frames), size,
                                              overlays, seed, edit, label)
    return FakeRun(folder, data, images, logs, pictures)


def write_json(path, value):
    """Writes as the program does: indented by 2."""
    path.write_text(json.dumps(value, indent=2) + "\n", encoding="utf-8")


def label(strategy):
    """The label that the program would give."""
    return LABELS.get(strategy, strategy.capitalize())


def _make_log(rng, strategies, strategy, frames, warm_up):
    place = strategies.index(strategy)
    nodes, rarn, time = LEVELS.get(strategy, (100 + 10 * place, 2, 40 + 3 * place))
    turn = np.arange(frames) / max(frames, 1) * 2 * np.pi
    dn = np.round(nodes * (1 + 0.2 * np.sin(turn)) + rng.integers(-2, 3, frames))
    log = {"frame": np.arange(frames), "warm_up": np.arange(frames) < warm_up, "dn": dn}
    log["rarn"] = rng.poisson(rarn, frames) if rarn else np.zeros(frames)
    predicts = strategy in PREDICTING or strategy not in LEVELS
    log["d"] = rng.integers(0, 4, frames) if predicts else np.full(frames, np.nan)
    log["delays"] = log["d"] * 2
    log["queries"] = np.round(dn * 1.1)
    log["triangles"] = dn * 2000
    log["nodes_visited"] = np.round(dn * 1.3)
    log["frame_ms"] = np.round(time * dn / nodes * rng.uniform(0.9, 1.2, frames), 6)
    log["cpu_ms"] = np.round(log["frame_ms"] / 2, 6)
    log["wait_ms"] = np.round(log["frame_ms"] / 4, 6)
    log["gpu_ms"] = np.full(frames, np.nan)
    return {key: np.asarray(log[key], dtype=float) for key in COLUMNS}


def _write_log(path, log):
    lines = [",".join(log)]
    for row in zip(*log.values()):
        lines.append(",".join("" if np.isnan(v) else f"{v:.9g}" for v in row))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _make_case(strategy, repetition, order):
    return {"strategy": strategy, "label": label(strategy), "repetition": repetition,
            "order": order, "csv": None, "error": None, "summary": None}


def _summarise(log):
    measured = log["warm_up"] == 0
    counters = {}
    for key in COLUMNS[2:]:
        values = log[key][measured]
        values = values[~np.isnan(values)]
        if len(values):
            counters[key] = _summarise_counter(values)
    times = log["frame_ms"][measured]
    return {"frames": int(measured.sum()), "warm_up_frames": int((~measured).sum()),
            "fps": 1000 * len(times) / times.sum() if len(times) else None,
            "fps_frame_mean": float(np.mean(1000 / times)) if len(times) else None,
            "delayed_share": (float(np.nansum(log["d"][measured]) / log["dn"][measured].sum())
                              if "d" in counters else None),
            "counters": counters}


def _summarise_counter(values):
    q1, median, q3, p99 = (float(v) for v in np.percentile(values, (25, 50, 75, 99)))
    return {"count": len(values), "mean": float(values.mean()), "median": median,
            "min": float(values.min()), "max": float(values.max()), "q1": q1, "q3": q3, "p99": p99,
            "stddev": float(values.std(ddof=1)) if len(values) > 1 else 0.0}


def _speedups(cases, strategies):
    rates = {(c["strategy"], c["repetition"]): c["summary"]["fps"]
             for c in cases if c["summary"] and c["summary"]["fps"]}
    speedups = []
    for over in strategies:
        ratios = [rate / rates[over, repetition] for (strategy, repetition), rate in rates.items()
                  if strategy == "coh-b" and (over, repetition) in rates]
        if over == "coh-b" or not ratios:
            continue
        several = len(ratios) > 1
        speedups.append({"strategy": "coh-b", "over": over, "ratios": ratios,
                         "median": float(np.median(ratios)),
                         "low": min(ratios) if several else None,
                         "high": max(ratios) if several else None})
    return speedups


def _make_head(scene, frames, repetitions, warm_up, strategies, size):
    """run.json without its cases, in the order of the program."""
    context = {
        "program": "hlodbench 0.1.0", "git_revision": "0123456789ab", "compiler": "GCC 12.2.0",
        "build_type": "Release", "cpu_model": "A processor", "cpu_cores": 2, "cpu_governor": None,
        "distribution": "Debian GNU/Linux 12 (bookworm)", "kernel": "Linux 6.1 x86_64",
        "load_average": [0.1, 0.2, 0.3], "time_utc": "2026-01-02T03:04:05Z",
        "arguments": ["hlodbench", "run", "--out", "fake"],
        "gl": {"vendor": "Mesa/X.org", "renderer": "llvmpipe", "version": "4.5"},
        "warnings": ["software rasteriser (llvmpipe): node counts are valid, frame times say "
                     "nothing about a GPU"],
    }
    options = {"context": "auto", "exponent": 2.0, "latency": "gl", "repetitions": repetitions,
               "s": 1.0, "seed": 1, "strategies": list(strategies), "t": 0.25, "tau": 1.0,
               "viewport": list(size)}
    return {
        "schema_version": "1.0.0", "context": context,
        "scene": {"name": scene, "hash": "00ff00ff", "triangles": 5228484, "nodes": 10607,
                  "build": {"options": "max_triangles=2000"}},
        "session": {"name": scene, "hash": "ff00ff00", "frames": frames},
        "options": options, "frames_in_flight": 1, "warm_up_frames": warm_up,
        "repetitions": repetitions, "complete": True, "missing": [], "speedups": [], "cases": [],
    }
