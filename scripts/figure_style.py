"""What all figures share: size, fonts, lines, and how they are written."""

import os

import matplotlib
from atomic_file import write_atomically
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

COLUMN_MM, PAGE_MM = 85, 175  # widths in print, of a column and of a page
MM_PER_INCH = 25.4
LINE_CHARACTERS = 112  # of 8 points, that fit a page

# What would differ from one time or version to the next is left out.
METADATA = {"svg": {"Date": None}, "png": {"Software": None},
            "pdf": {"CreationDate": None, "Creator": None, "Producer": None}}

matplotlib.use("Agg")
matplotlib.rcParams.update({
    "font.family": ["DejaVu Sans", "sans-serif"],
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "figure.titlesize": 8,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "legend.handlelength": 4.0,  # a whole period of the longest dashes
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.4,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.scale_dashes": True,
    "lines.dash_capstyle": "butt",
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "hlodbench",  # else ids, and so files, would differ every time
})


class Skipped(Exception):
    """A figure that cannot be made; the message is one line."""


def new_figure(width_mm, height_mm):
    """An empty figure that arranges its axes by itself."""
    figure = Figure((width_mm / MM_PER_INCH, height_mm / MM_PER_INCH), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def line_look(style, markers, start=0):
    """Arguments of Axes.plot for a style; about `markers` markers a line, in steps from `start`
    (0 to 1: which part of the first step), so that those of several lines do not hide each other.
    """
    look = {"color": style.color, "linewidth": style.width, "marker": style.marker,
            "markersize": 4, "markeredgecolor": "white", "markeredgewidth": 0.4,
            "markevery": lambda count: (int(start * count / markers), max(count // markers, 1))}
    look["linestyle"] = (0, style.dashes) if style.dashes else "-"
    look["zorder"] = 2.2 if style.dashes else 2.1  # through dashes one sees a line below
    return look


def save_figure(figure, folder, name, formats, dpi):
    """Writes folder/name.FORMAT for each format and returns the paths.

    The same figure gives the same bytes. Nobody ever sees half a file: each gets its name last.
    """
    paths = []
    for kind in formats:
        path = os.path.join(folder, f"{name}.{kind}")
        metadata = METADATA[kind]
        with write_atomically(path) as temporary:
            figure.savefig(temporary, format=kind, dpi=dpi, metadata=metadata)
        paths.append(path)
    return paths
