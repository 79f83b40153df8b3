"""The paper's Fig. 1a: the bias B_{s,t} over the relative visibility mu, as the program has it."""

import csv
import io
import math
import subprocess

import numpy as np
from figure_style import COLUMN_MM, Skipped, new_figure
from matplotlib.lines import Line2D

S_VALUES = (0, 0.5, 1)
T_VALUES = (0.1, 0.25, 0.5)
SAMPLES = 201
COLUMNS = ("s", "t", "mu", "bias")
HEIGHT_MM = 80
# By turn-over point, colours (of Okabe and Ito) and markers; by smoothness, lines.
COLORS, NEUTRAL = ("#0072b2", "#d55e00", "#009e73"), "#444444"
MARKERS = ("o", "s", "D", "^", "v")
DASHES, IDENTITY = ("-", (0, (5, 1.8))), (0, (1, 1.4))


def read_bias(program):
    """The curves that `PROGRAM bias` prints: {(s, t): (mu, bias)}, two (samples,) arrays each."""
    command = [str(program), "bias", "--s", _join(S_VALUES), "--t", _join(T_VALUES),
               "--samples", str(SAMPLES)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    except OSError as error:
        raise Skipped(f"{program}: expected the program hlodbench: {error.strerror}; build it, or "
                      "name it by --hlodbench") from error
    except (subprocess.TimeoutExpired, UnicodeDecodeError) as error:
        raise Skipped(f"{program} bias: expected a table: {error}") from error
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise Skipped(f"{program} bias: exit code {done.returncode}: {last}")
    return parse_bias(done.stdout, f"{program} bias")


def parse_bias(text, source):
    """The curves of a table with the columns s, t, mu, bias; Skipped if it is no such table."""
    rows = list(csv.reader(io.StringIO(text)))
    header = rows[0] if rows else []
    if not set(COLUMNS) <= set(header):
        raise Skipped(f"{source}:1: expected the columns {','.join(COLUMNS)}, found "
                      f"{','.join(header)[:60]!r}")
    places = [header.index(column) for column in COLUMNS]
    curves = {}
    for number, row in enumerate(rows[1:], 2):
        try:
            s, t, mu, bias = (float(row[i]) for i in places)
        except (ValueError, IndexError):
            s = math.nan
        if not (math.isfinite(s) and all(0 <= v <= 1 for v in (s, t, mu, bias))):
            raise Skipped(f"{source}:{number}: expected s, t, mu, bias from 0 to 1, found "
                          f"{','.join(row)[:60]!r}")
        curves.setdefault((s, t), []).append((mu, bias))
    if not curves:
        raise Skipped(f"{source}: expected samples, found none")
    return {key: tuple(np.array(sorted(points)).T) for key, points in curves.items()}


def draw_bias(curves):
    """Draws the curves of read_bias(). s = 0 is the identity for every t, and drawn once."""
    figure = new_figure(COLUMN_MM, HEIGHT_MM)
    axes = figure.add_subplot()
    turns = sorted({t for _, t in curves})
    smooth = sorted({s for s, _ in curves if s > 0}, reverse=True)
    axes.plot((0, 1), (0, 1), color=NEUTRAL, linewidth=0.9, linestyle=IDENTITY, gid="identity")
    for i, t in enumerate(turns):
        for k, s in enumerate(smooth):
            if (s, t) in curves:
                axes.plot(*curves[s, t], color=COLORS[i % len(COLORS)], gid=f"bias.s{s:g}.t{t:g}",
                          clip_on=False, **_look(k))
        # All curves of one t cross the identity there, and nowhere else: it names them in grey too.
        axes.plot([t], [t], color=COLORS[i % len(COLORS)], **_marker(i), zorder=3)
    axes.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xlabel="relative visibility μ",
             ylabel="bias B(μ)")
    axes.set_xticks(np.arange(0, 1.01, 0.25))
    axes.set_yticks(np.arange(0, 1.01, 0.25))
    axes.legend(handles=_make_key(turns, smooth), loc="lower right", borderaxespad=0.3,
                labelspacing=0.3, handlelength=2.6)
    return figure


def _look(place):
    """Of the place-th smoothness, from s = 1 downwards."""
    return {"linewidth": 1.4 if place == 0 else 1.0, "linestyle": DASHES[min(place, 1)]}


def _marker(place):
    return {"marker": MARKERS[place % len(MARKERS)], "markersize": 5, "linestyle": "",
            "markeredgecolor": "white", "markeredgewidth": 0.5, "clip_on": False}


def _make_key(turns, smooth):
    """One line for each t, each s, and the identity, rather than one for each pair."""
    key = [Line2D([], [], color=COLORS[i % len(COLORS)], **{**_marker(i), **_look(0)},
                  label=f"t = {t:g}") for i, t in enumerate(turns)]
    key += [Line2D([], [], color=NEUTRAL, **_look(k), label=f"s = {s:g}")
            for k, s in enumerate(smooth)]
    return [*key, Line2D([], [], color=NEUTRAL, linewidth=0.9, linestyle=IDENTITY,
                         label="s = 0: B(μ) = μ")]


def _join(values):
    return ",".join(f"{v:g}" for v in values)
