"""Counters and PSNR of every strategy over the latency of query results."""

import math
import textwrap

import numpy as np
from figure_style import LINE_CHARACTERS, PAGE_MM, Skipped, line_look, new_figure
from latency_data import COUNTERS, VALUES, place
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from strategy_style import styles_of

HEIGHT_MM = 180  # without the key
KEY_LINE_MM, KEY_COLUMNS = 5, 5
GAP = 0.45  # between the last latency in draws and the first in frames, in units of the axis
STEP = 0.3  # between latencies in frames
MANY = 3  # DN and others begin at 0 unless the least is more than 1/MANY of the most


def draw_latency(curves, title):
    """Draws one Curves; Skipped if it has fewer than two fixed latencies."""
    if len(curves.latencies("draws")) + len(curves.latencies("frames")) < 2:
        raise Skipped("expected two or more fixed latencies (draws:N, frames:N), found fewer")
    styles = styles_of(curves.labels)
    key_mm = KEY_LINE_MM * math.ceil((len(styles) + 1) / KEY_COLUMNS)
    figure = new_figure(PAGE_MM, HEIGHT_MM + key_mm)
    grid = figure.add_gridspec(4, 2, height_ratios=[key_mm] + [HEIGHT_MM / 3] * 3)
    panels = np.array([[figure.add_subplot(grid[i + 1, j]) for j in range(2)] for i in range(3)])
    figure.suptitle(textwrap.fill(title, LINE_CHARACTERS), x=0.01, ha="left")
    for axes, (key, name) in zip(panels.flat, VALUES.items()):
        for strategy, style in styles.items():
            if key == "d" and curves.delays_all(strategy):
                continue
            _draw_line(axes, curves, strategy, style, key)
            _draw_driver(axes, curves, strategy, style, key)
        axes.set(ylabel=name)
        _set_range(axes, key)
        _draw_ticks(axes, curves)
    for axes in panels[-1]:
        axes.set_xlabel("latency, draws; at the right in frames")
    _draw_key(figure.add_subplot(grid[0, :]), curves, styles)
    return figure


def _draw_key(axes, curves, styles):
    handles = [Line2D([], [], label=curves.labels[s], **_look(style))
               for s, style in styles.items()]
    if curves.driver:
        handles.append(Patch(facecolor="#888888", alpha=0.35, label="driver (gl)"))
    key = axes.legend(handles=handles, loc="center left", ncol=KEY_COLUMNS, borderaxespad=0)
    key.set_in_layout(False)  # or a long name would make every panel narrow
    axes.axis("off")


def frame_place(curves, frames):
    """Where a latency in frames stands, right of those in draws."""
    known = curves.latencies("frames")
    draws = curves.latencies("draws")
    start = float(place(draws[-1])) + GAP if draws else 0.0
    return start + STEP * known.index(frames)


def _look(style):
    look = line_look(style, 1)
    del look["markevery"]
    return look


def _draw_line(axes, curves, strategy, style, key):
    latencies, values = curves.points(strategy, "draws", key)
    axes.plot(place(latencies), values, gid=f"{key}.{strategy}.draws", **_look(style))
    latencies, values = curves.points(strategy, "frames", key)
    axes.plot([frame_place(curves, n) for n in latencies], values,
              gid=f"{key}.{strategy}.frames", **_look(style))


def _draw_driver(axes, curves, strategy, style, key):
    driver = curves.driver.get(strategy)
    if driver is None or key not in driver.means:
        return
    axes.axhline(driver.means[key], color=style.color, linewidth=0.7, alpha=0.8, zorder=1.9,
                 gid=f"{key}.{strategy}.gl")
    low, high = driver.spreads[key] if key in COUNTERS else (None, None)
    if low is not None and high > low:
        axes.axhspan(low, high, color=style.color, alpha=0.2, linewidth=0, zorder=1.8,
                     gid=f"{key}.{strategy}.gl-spread")


def _set_range(axes, key):
    values = np.concatenate([np.atleast_1d(line.get_ydata()) for line in axes.get_lines()] or [[]])
    if len(values) == 0:
        axes.text(0.5, 0.5, "no values", transform=axes.transAxes, ha="center")
    elif key in COUNTERS and values.min() * MANY <= values.max():
        axes.set_ylim(0, values.max() * 1.05 or 1)


def _draw_ticks(axes, curves):
    draws, frames = curves.latencies("draws"), curves.latencies("frames")
    shown = [n for n in draws if str(n)[0] == "1" or n == 0 or len(draws) < 8]
    places = [float(place(n)) for n in shown] + [frame_place(curves, n) for n in frames]
    axes.set_xticks(places, [str(n) for n in shown] + [f"{n}f" for n in frames])
    axes.set_xticks([float(place(n)) for n in draws], minor=True)
    if draws and frames:
        axes.axvline((float(place(draws[-1])) + frame_place(curves, frames[0])) / 2,
                     color="#bbbbbb", linewidth=0.6)
