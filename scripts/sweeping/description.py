"""The description of a sweep: one YAML file, checked key by key.

docs/sweeps.md has the table of its keys.
"""

import itertools
import math
import pathlib
import re
from dataclasses import dataclass, field

import yaml

from .errors import SweepError

MOST_CELLS = 100_000
LARGEST_SEED = 9007199254740991  # as the program has it
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._+-]*")
LATENCY = re.compile(r"gl|(draws|frames):[0-9]+")
SIZE = re.compile(r"[1-9][0-9]*x[1-9][0-9]*")


@dataclass(frozen=True)
class Cell:
    """One run of the program."""

    parameters: tuple  # (key, text) pairs: what varies, and what is passed to the program
    strategies: tuple  # ids, replayed beside each other
    timing: bool  # whether frame times are wanted
    threads: int  # cores for a cell whose times are not wanted


@dataclass
class Description:
    """What the file says."""

    path: pathlib.Path
    name: str
    cells: list = field(default_factory=list)  # of Cell, in the order of the file
    warnings: list = field(default_factory=list)  # of str, one line each


def _number(low, high, open_low=False):
    expected = f"a number {'above' if open_low else 'from'} {low:g} " + (
        f"up to {high:g}" if open_low else f"to {high:g}")

    def check(value):
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return None
        inside = low < value <= high if open_low else low <= value <= high
        return format_value(value) if math.isfinite(value) and inside else None
    return expected, check


def _whole(low, high):
    def check(value):
        is_whole = isinstance(value, int) and not isinstance(value, bool)
        return str(value) if is_whole and low <= value <= high else None
    return f"a whole number from {low} to {high}", check


def _text(expected, pattern):
    def check(value):
        return value if isinstance(value, str) and pattern.fullmatch(value) else None
    return expected, check


def _path(value):
    return value if isinstance(value, str) and value else None


def _images(value):
    if isinstance(value, bool):
        return None
    return str(value) if isinstance(value, int) and value >= 0 else _path(value)


# The axes: each may have one value or a list; the matrix is the product of all of them.
AXES = {
    "scene": ("the name of a file", _path),
    "session": ("the name of a file", _path),
    "size": _text("a text like 640x480", SIZE),
    "tau": _number(0, 1e6, open_low=True),
    "s": _number(0, 1),
    "t": _number(0, 1),
    "latency": _text("gl, draws:N or frames:N", LATENCY),
    "seed": _whole(0, LARGEST_SEED),
    "repetitions": _whole(1, 10000),
    "images": ("none, all, a number of frames or a list like '0,120'", _images),
}
OTHERS = ("strategy", "timing", "threads", "options")
TOP = ("name", "blocks")
STRATEGY = _text("the id of a strategy", NAME)
THREADS = _whole(1, 1024)


def format_value(value):
    """A value of the file as the program's command line takes it; 1 and 1.0 are the same."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(value)
    return str(value)


class _Loader(yaml.SafeLoader):
    """Refuses a key that stands twice in one mapping, of which YAML would take the last."""


def _construct_mapping(loader, node):
    seen = set()
    for key, _ in node.value:
        if not isinstance(key, yaml.ScalarNode):
            continue  # refused below
        if key.value in seen:
            raise yaml.constructor.ConstructorError(
                None, None, f"expected the key {key.value!r} once, found it twice", key.start_mark)
        seen.add(key.value)
    return yaml.SafeLoader.construct_mapping(loader, node, deep=True)


_Loader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _construct_mapping)


def read_description(path, known_options):
    """Reads the file. known_options: names of the program's options, without dashes.

    Raises SweepError: file, key, expected, found.
    """
    path = pathlib.Path(path)
    try:
        content = yaml.load(path.read_text(encoding="utf-8"), _Loader)  # a SafeLoader
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not UTF-8"
        raise SweepError(f"{path}: expected the description of a sweep: {reason}") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f":{mark.line + 1}" if mark else ""
        reason = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise SweepError(f"{path}{line}: expected YAML: {reason}") from None
    return _Reader(path, known_options).read(content)


class _Reader:
    """Checks one file."""

    def __init__(self, path, known_options):
        self.path, self.known_options = path, known_options

    def fail(self, place, expected, found):
        raise SweepError(f"{self.path}: {place}: expected {expected}, found {_show(found)}")

    def read(self, content):
        self._check_mapping("the whole", content, (*TOP, *AXES, *OTHERS))
        default = self.path.name.split(".")[0]
        name = content.get("name", default)
        if not isinstance(name, str) or not name.strip():
            self.fail("name", "a text", name)
        description = Description(self.path, name)
        blocks = content.get("blocks", [{}])
        if not isinstance(blocks, list) or not blocks:
            self.fail("blocks", "a list of mappings", blocks)
        shared = {key: value for key, value in content.items() if key not in TOP}
        for i, block in enumerate(blocks):
            place = f"blocks[{i}]" if "blocks" in content else ""
            if place:
                self._check_mapping(place, block, (*AXES, *OTHERS))
            # a block's own keys win; of the options, too, each by itself
            merged = {**shared, **block}
            own, others = block.get("options"), shared.get("options")
            if isinstance(own, dict) and isinstance(others, dict):
                merged["options"] = {**others, **own}
            self._add_block(description, place, block, merged)
        if len(description.cells) > MOST_CELLS:
            self.fail("the whole", f"at most {MOST_CELLS} cells", len(description.cells))
        return description

    def _add_block(self, description, place, own, block):
        def where(key):
            return f"{place}.{key}" if place and key in own else key

        axes = {}
        for key, (expected, check) in AXES.items():
            if key in block:
                axes[key] = self._read_axis(where(key), block[key], expected, check)
            elif key in ("scene", "session"):
                self.fail(where(key), "the name of a file", None)
        for key, values in self._read_options(where("options"), block.get("options", {})).items():
            axes[f"option.{key}"] = values
        strategies = tuple(self._read_axis(where("strategy"), block.get("strategy"), *STRATEGY)
                           if "strategy" in block else ())
        timing = block.get("timing", True)
        if not isinstance(timing, bool):
            self.fail(where("timing"), "true or false", timing)
        threads = block.get("threads", 1)
        if THREADS[1](threads) is None:
            self.fail(where("threads"), THREADS[0], threads)
        if not timing and "gl" in axes.get("latency", ["gl"]):
            description.warnings.append(
                f"{self.path}: {where('timing')}: false with latency gl: these counts depend on "
                "what else runs, and do not repeat exactly; draws:N or frames:N do")
        if math.prod(map(len, axes.values())) > MOST_CELLS:
            self.fail(place or "the whole", f"at most {MOST_CELLS} cells",
                      math.prod(map(len, axes.values())))
        for values in itertools.product(*axes.values()):
            description.cells.append(Cell(tuple(zip(axes, values)), strategies, timing, threads))

    def _read_options(self, place, options):
        if not isinstance(options, dict):
            self.fail(place, "a mapping of options of `hlodbench run`", options)
        axes = {}
        for key, value in options.items():
            if key in AXES or key in ("strategy", "out", "help", "cache", "trace", "threads"):
                self.fail(f"{place}.{key}", "an option that has no key of its own and is not the "
                          "sweep's affair", key)
            if key not in self.known_options:
                self.fail(f"{place}.{key}", "an option of `hlodbench run`, without its dashes", key)
            axes[key] = self._read_axis(f"{place}.{key}", value, "a text, number, true or false",
                                        lambda v: None if v is None or isinstance(v, (dict, list))
                                        or v == "" else format_value(v))
        return axes

    def _read_axis(self, place, value, expected, check):
        """The values of one key as texts, each once."""
        values = value if isinstance(value, list) else [value]
        if not values:
            self.fail(place, f"{expected}, or a list of such", value)
        texts = []
        for i, one in enumerate(values):
            text = check(one)
            if text is None:
                self.fail(f"{place}[{i}]" if isinstance(value, list) else place, expected, one)
            if text in texts:
                self.fail(f"{place}[{i}]", "each value once", one)
            texts.append(text)
        return texts

    def _check_mapping(self, place, value, keys):
        if not isinstance(value, dict):
            self.fail(place, f"a mapping with some of the keys {', '.join(keys)}", value)
        for key in value:
            if key not in keys:
                inside = f"{place}.{key}" if place != "the whole" else str(key)
                self.fail(inside, f"one of the keys {', '.join(keys)}", key)


def _show(value):
    if value is None:
        return "none"
    text = value if isinstance(value, str) else format_value(value)
    return repr(" ".join(text.split())[:60])
