"""The paper's Fig. 5: one frame under Bool, Simp(B) and Coh(B), and its worst detail."""

import math
import textwrap

import numpy as np
from figure_style import LINE_CHARACTERS, MM_PER_INCH, PAGE_MM, Skipped, new_figure
from matplotlib.colors import ListedColormap
from matplotlib.patches import Rectangle
from worst_detail import COMPARED, REFERENCE, find_detail

OVERLAY = "bias"
COLUMN_MM = 54  # a third of the page, less labels and gaps
# The overlay's colours of no, half and full modulation; linear RGB, shown by its square root.
MODULATION = ((0.05, 0.12, 0.95), (0.85, 0.05, 0.75), (0.95, 0.05, 0.04))


def draw_pictures(run, by="error"):
    """Draws one run; Skipped if there are no pictures to compare. by: see find_detail()."""
    detail = _find(run, by)
    columns = [REFERENCE] + [s for s in COMPARED if run.image(s, detail.frame) is not None]
    overlays = {s: run.image(s, detail.frame, OVERLAY) for s in columns[1:]}
    rows = 3 if any(o is not None for o in overlays.values()) else 2
    aspect = run.images["height"] / run.images["width"]
    height_mm = rows * (COLUMN_MM * aspect + 3) + 13
    figure = new_figure(PAGE_MM, height_mm)
    figure.get_layout_engine().set(w_pad=1 / MM_PER_INCH, h_pad=1 / MM_PER_INCH)
    grid = figure.subplots(rows, 3, squeeze=False)
    figure.suptitle(describe(run, detail, by), x=0.01, ha="left")
    for column, strategy in enumerate(columns):
        picture = run.image(strategy, detail.frame)
        grid[0, column].set_title(caption(run, strategy, detail.frame))
        _show_whole(grid[0, column], picture, detail, f"frame.{strategy}")
        _show_detail(grid[1, column], picture, detail, f"detail.{strategy}")
        if rows == 3 and column > 0:
            _show(grid[2, column], overlays[strategy], f"overlay.{strategy}")
    if rows == 3:
        _draw_key(grid[2, 0])
    for row, label in zip(grid, ("whole frame", "detail", "modulation")):
        row[0].set_ylabel(label)
    for axes in grid[:, len(columns) :].flat:
        axes.set_axis_off()
    return figure


def describe(run, detail, by="error"):
    """Which frame and which detail, and why; one line each where they fit."""
    place = (f"{run.scene}, frame {detail.frame}. Detail of {detail.width} × {detail.height} "
             f"pixels at ({detail.left}, {detail.top}) from the top left, found by search of "
             f"{detail.searched} pictures:")
    name, error = run.label(detail.strategy), math.sqrt(detail.error)
    if by == "rarn":
        why = (f"{name} has the most RARN in this frame, which differs most from Bool here "
               f"(RMS {error:.1f} of 255 in luminance)")
    elif detail.error == 0:
        why = "none of them differs from Bool in luminance"
    else:
        why = f"{name} differs most from Bool here, RMS {error:.1f} of 255 in luminance"
    return "\n".join(textwrap.fill(line, LINE_CHARACTERS) for line in (place, why))


def caption(run, strategy, frame):
    """What is known of one picture: PSNR of luminance against Bool, and RARN."""
    if strategy == REFERENCE:
        return f"{run.label(strategy)}, the reference"
    entry = run.image_entry(strategy, frame)
    quality, rarn = entry.get("vs_reference"), entry.get("rarn_nodes")
    luminance = quality.get("y", math.nan) if isinstance(quality, dict) else math.nan
    if luminance is None:
        text = "identical in Y"
    elif isinstance(luminance, (int, float)) and math.isfinite(luminance):
        text = f"PSNR Y {luminance:.1f} dB"
    else:
        text = "PSNR unknown"
    return f"{run.label(strategy)}: {text}" + (f", {rarn} RARN" if isinstance(rarn, int) else "")


def _find(run, by):
    """The detail to show; Skipped says what is missing for it."""
    if run.images is None:
        # The reader's note says why.
        raise Skipped(next((p for p in run.problems if "images.json" in p), "no pictures"))
    path = run.folder / "images" / "images.json"
    if run.images.get("format") != "png":
        raise Skipped(f"{path}: format: expected png, found {run.images.get('format')}; run with "
                      "PNG pictures")
    present = run.image_strategies()
    if REFERENCE not in present or not set(COMPARED) & set(present):
        raise Skipped(f"{path}: expected pictures of bool and of simp-b or coh-b, found "
                      f"{', '.join(present) or 'none'}")
    detail = find_detail(run, by)
    if detail is None:
        raise Skipped(f"{path}: expected a frame with pictures of bool and of simp-b or coh-b that "
                      "can be read, found none")
    return detail


def _show(axes, picture, gid, interpolation="antialiased"):
    axes.set(xticks=[], yticks=[])
    axes.grid(False)
    axes.spines[:].set_visible(True)
    if picture is None:
        axes.text(0.5, 0.5, "none", ha="center", va="center", transform=axes.transAxes)
        return
    axes.imshow(picture, interpolation=interpolation, gid=gid)


def _show_whole(axes, picture, detail, gid):
    _show(axes, picture, gid)
    corner = (detail.left - 0.5, detail.top - 0.5)
    # White on black stands out from every picture.
    for color, width in (("black", 1.9), ("white", 0.8)):
        axes.add_patch(Rectangle(corner, detail.width, detail.height, fill=False,
                                 edgecolor=color, linewidth=width))


def _show_detail(axes, picture, detail, gid):
    """Magnified without smoothing: each pixel is a square, whoever shows the file."""
    repeats = max(round(640 / detail.width), 1)
    crop = detail.crop(picture)
    _show(axes, crop.repeat(repeats, axis=0).repeat(repeats, axis=1), gid, "none")


def _draw_key(axes):
    """The colours of the modulation from none (B = 1) to full (B = 0)."""
    axes.set_axis_off()
    key = axes.inset_axes([0.1, 0.5, 0.8, 0.14])
    steps = np.linspace(0, 1, 64)
    colors = [np.sqrt([np.interp(t, (0, 0.5, 1), c) for c in zip(*MODULATION)]) for t in steps]
    key.imshow(steps[None, :], aspect="auto", extent=(0, 1, 0, 1), cmap=ListedColormap(colors))
    key.grid(False)
    key.set(yticks=[], title="modulation of the error by B(μ)")
    key.set_xticks((0, 0.5, 1), ("weak\nB = 1", "moderate\n0.5", "strong\n0"))
    key.spines[:].set_visible(True)
