"""Reads the folders that `hlodbench run` leaves, for the scripts that draw figures and reports.

A folder that is damaged or cut short is read as far as it goes: what is missing becomes a line in
`problems`, naming the file, and the rest stays usable. Only a folder without a readable run.json of
a known version is refused, with ResultError.
"""

import csv
import json
import math
import pathlib
from dataclasses import dataclass, field

import numpy as np

from result_members import IMAGES, RUN, find_flaw

SCHEMA_MAJOR = "1"
PAPER_ORDER = ("bool", "sw-b", "simp-b", "coh-b")


class ResultError(Exception):
    """A folder or file that cannot be used at all; the message is one line."""


@dataclass
class Case:
    """One replay of the session by one strategy."""

    strategy: str
    label: str
    repetition: int
    error: str | None
    summary: dict | None
    columns: dict  # counter key -> float array, one value a frame, NaN where absent


@dataclass
class Run:
    """One result folder."""

    folder: pathlib.Path
    data: dict  # run.json
    cases: list = field(default_factory=list)  # of Case
    images: dict | None = None  # images/images.json
    problems: list = field(default_factory=list)  # of str, one line each

    @property
    def scene(self):
        return self.data["scene"]["name"]

    def strategies(self):
        """Ids of the strategies that have frames: the paper's order, then others as they ran."""
        present = list(dict.fromkeys(c.strategy for c in self.cases if c.columns))
        known = [s for s in PAPER_ORDER if s in present]
        return known + [s for s in present if s not in known]

    def label(self, strategy):
        """What tables call the strategy; the reconstruction of Simp(B) is marked by a star."""
        if strategy == "simp-b":
            return "Simp*(B)"
        return next((c.label for c in self.cases if c.strategy == strategy), strategy)

    def frame_means(self, strategy, counter):
        """The counter by frame, (frames,), the mean over repetitions; NaN where absent.

        For frame_ms it is the median, which one disturbed repetition does not move.
        """
        rows = [c.columns[counter] for c in self.cases
                if c.strategy == strategy and counter in c.columns]
        if not rows:
            return np.full(self.data["session"]["frames"], np.nan)
        stack = np.full((len(rows), max(map(len, rows))), np.nan)
        for row, values in zip(stack, rows):
            row[: len(values)] = values
        middle = np.full(stack.shape[1], np.nan)
        known = ~np.all(np.isnan(stack), axis=0)
        reduce = np.nanmedian if counter == "frame_ms" else np.nanmean
        middle[known] = reduce(stack[:, known], axis=0)
        return middle

    def image_frames(self):
        """Indices of the frames that have pictures."""
        return list(self.images["frames"]) if self.images else []

    def image_strategies(self):
        """Ids of the strategies that have pictures, in the order of strategies()."""
        if not self.images:
            return []
        present = [s["strategy"] for s in self.images["strategies"]]
        ordered = [s for s in self.strategies() if s in present]
        return ordered + [s for s in present if s not in ordered]

    def image_entry(self, strategy, frame):
        """The entry of images.json for one picture ("full": the full model), or None."""
        if not self.images:
            return None
        if strategy == "full":
            entries = self.images.get("full") or []
        else:
            entries = next((s["frames"] for s in self.images["strategies"]
                            if s["strategy"] == strategy), [])
        return next((e for e in entries if e["frame"] == frame), None)

    def image(self, strategy, frame, overlay=None):
        """The picture, (height, width, 3) uint8, or None; what is wrong goes to `problems`."""
        entry = self.image_entry(strategy, frame)
        if entry is None:
            return None
        name = (entry.get("overlays") or {}).get(overlay) if overlay else entry["file"]
        if not isinstance(name, str):
            return None
        path = self.folder / "images" / name
        picture = self._read_picture(path)
        if picture is None:
            return None
        expected = (self.images["height"], self.images["width"])
        if picture.shape[:2] != expected:
            self.note(f"{path}: expected {expected[1]}x{expected[0]} pixels, "
                      f"found {picture.shape[1]}x{picture.shape[0]}")
            return None
        return picture

    def note(self, problem):
        """Adds a problem once."""
        if problem not in self.problems:
            self.problems.append(problem)

    def _read_picture(self, path):
        from PIL import Image  # pylint: disable=import-outside-toplevel

        if not path.exists():
            self.note(f"{path}: expected a picture, found none")
            return None
        try:
            with Image.open(path) as picture:
                return np.asarray(picture.convert("RGB"))
        except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
            self.note(f"{path}: expected a picture, found a damaged file ({error})")
            return None


def read_run(folder, frames=True):
    """Reads one result folder; without `frames`, all but the frame logs, which are most of the work.

    Raises ResultError if it has no usable run.json.
    """
    folder = pathlib.Path(folder)
    path = folder / "run.json"
    data = _read_json(path)
    version = data.get("schema_version") if isinstance(data, dict) else None
    if not isinstance(version, str) or version.split(".")[0] != SCHEMA_MAJOR:
        raise ResultError(f"{path}: schema_version: expected {SCHEMA_MAJOR}.x, found {version!r}")
    flaw = find_flaw(data, RUN)
    if flaw:
        raise ResultError(f"{path}: {flaw}")
    run = Run(folder, data)
    for missing in data.get("missing") or []:
        run.note(f"{folder}: {missing['strategy']}, repetition {missing['repetition']}, is missing:"
                 " the run was interrupted")
    for case in data["cases"]:
        run.cases.append(_read_case(run, case, frames))
    _read_images(run)
    return run


def _read_json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ResultError(f"{path}: expected the result of `hlodbench run`, found none") from None
    except (OSError, ValueError, RecursionError) as error:
        raise ResultError(f"{path}: expected JSON: {error}") from None


def _read_case(run, case, frames):
    columns = {}
    if case.get("error"):
        run.note(f"{run.folder}: {case['strategy']}, repetition {case['repetition']}, failed: "
                 f"{case['error']}")
    elif case.get("csv") and frames:
        columns = _read_frames(run, run.folder / case["csv"])
    return Case(case["strategy"], case.get("label") or case["strategy"], case["repetition"],
                case.get("error"), case.get("summary"), columns)


def _read_frames(run, path):
    """The columns of one frame log; a line that is cut short ends it."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except (OSError, ValueError, csv.Error) as error:
        run.note(f"{path}: expected a frame log: {error}")
        return {}
    header = rows[0] if rows else []
    if "frame" not in header:
        run.note(f"{path}:1: expected a header with a column \"frame\", found {','.join(header)!r}")
        return {}
    values = []
    for number, row in enumerate(rows[1:], 2):
        try:
            if len(row) != len(header):
                raise ValueError(f"{len(header)} fields, found {len(row)}")
            values.append([float(cell) if cell else math.nan for cell in row])
        except ValueError as error:
            run.note(f"{path}:{number}: expected {error}; the frames from here on are left out")
            break
    table = np.array(values, dtype=float).reshape(len(values), len(header))
    frames = run.data["session"]["frames"]
    if len(values) < frames and not any(p.startswith(f"{path}:") for p in run.problems):
        run.note(f"{path}: expected {frames} frames, found {len(values)}")
    return {key: table[:, i] for i, key in enumerate(header)}


def _read_images(run):
    path = run.folder / "images" / "images.json"
    if not path.exists():
        run.note(f"{path}: none; the run made no pictures (--images none, or an older version)")
        return
    try:
        images = _read_json(path)
    except ResultError as error:
        run.note(str(error))
        return
    version = images.get("schema_version") if isinstance(images, dict) else None
    if not isinstance(version, str) or version.split(".")[0] != SCHEMA_MAJOR:
        run.note(f"{path}: schema_version: expected {SCHEMA_MAJOR}.x, found {version!r}")
        return
    flaw = find_flaw(images, IMAGES)
    if flaw:
        run.note(f"{path}: {flaw}")
        return
    if not images.get("complete", True):
        run.note(f"{path}: the picture pass was interrupted")
    run.images = images


def find_worst_region(picture, reference, width=80, height=60):
    """The window of width x height pixels in which two pictures differ most.

    picture, reference: (h, w, 3) uint8. Returns (left, top, error): error is the mean over the
    window of the squared difference of BT.601 luminance, in squared 8-bit steps; 0 if equal.
    """
    luminance = np.array([0.299, 0.587, 0.114])
    squared = ((picture.astype(float) - reference.astype(float)) @ luminance) ** 2
    width, height = min(width, squared.shape[1]), min(height, squared.shape[0])
    sums = np.zeros((squared.shape[0] + 1, squared.shape[1] + 1))
    sums[1:, 1:] = squared.cumsum(0).cumsum(1)
    windows = (sums[height:, width:] - sums[:-height, width:] - sums[height:, :-width]
               + sums[:-height, :-width])
    top, left = np.unravel_index(np.argmax(windows), windows.shape)
    return int(left), int(top), float(max(windows[top, left], 0.0) / (width * height))
