"""The paper's Fig. 4: drawn nodes and frame rate over a whole session, all strategies."""

import textwrap

import numpy as np
from figure_style import LINE_CHARACTERS, PAGE_MM, Skipped, line_look, new_figure
from frame_rate import SMOOTHING_FRAMES, frame_rates, smooth_frame_rates, warm_up_frames
from strategy_style import styles_of

MARKERS = 12  # a line
HEIGHT_MM = 120


def draw_session(run):
    """Draws one run; Skipped if no strategy has frames."""
    strategies = run.strategies()
    warm_up = warm_up_frames(run)
    if not any((~np.isnan(run.frame_means(s, "dn")[warm_up:])).any() for s in strategies):
        raise Skipped(f"{run.folder}: expected measured frames, found none")
    figure = new_figure(PAGE_MM, HEIGHT_MM)
    nodes, rate = figure.subplots(2, 1, sharex=True)
    figure.suptitle(textwrap.fill(describe(run), LINE_CHARACTERS), x=0.01, ha="left")
    for i, (strategy, style) in enumerate(styles_of(strategies).items()):
        start = (i + 0.5) / len(strategies)
        _draw_counts(nodes, run, strategy, line_look(style, MARKERS, start))
        _draw_rates(rate, run, strategy, line_look(style, MARKERS, start))
    nodes.set(ylabel="drawn nodes", xlim=(0, max(run.data["session"]["frames"] - 1, 1)))
    rate.set(xlabel="frame of the session",
             ylabel=f"frames per second\n(median of {SMOOTHING_FRAMES} frames; thin: each)")
    for axes in (nodes, rate):
        axes.set_ylim(0, 1.05 * _highest(axes, warm_up))
        if warm_up > 0:
            axes.axvspan(0, warm_up - 0.5, color="#bbbbbb", alpha=0.6, linewidth=0, gid="warm-up")
    if warm_up > 0:
        nodes.annotate("warm-up", (warm_up, 0), xytext=(2, 3), textcoords="offset points",
                       color="#555555")
    nodes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncol=6, borderaxespad=0.1)
    return figure


def describe(run):
    """One line: what was run where, as far as it is known."""
    triangles = run.data["scene"].get("triangles")
    session = run.data["session"]
    repetitions = len({case.repetition for case in run.cases if case.columns})
    gl = run.data["context"].get("gl")
    renderer = gl.get("renderer") if isinstance(gl, dict) else None
    parts = [
        f"{triangles / 1e6:.3g} M triangles" if isinstance(triangles, int) else "",
        f"session {session.get('name') or 'without a name'}",
        f"{session['frames']} frames",
        f"{repetitions} repetition{'s' if repetitions != 1 else ''}",
        renderer.split(" (")[0] if isinstance(renderer, str) else "",
        "" if run.data.get("complete", True) else "INTERRUPTED",
    ]
    return f"{run.scene}: " + ", ".join(part for part in parts if part)


def _draw_counts(axes, run, strategy, look):
    values = run.frame_means(strategy, "dn")
    look["markevery"] = look["markevery"](len(values))
    axes.plot(np.arange(len(values)), values, label=run.label(strategy), gid=f"dn.{strategy}",
              **look)


def _draw_rates(axes, run, strategy, look):
    raw, smooth = frame_rates(run, strategy), smooth_frame_rates(run, strategy)
    look["markevery"] = look["markevery"](len(smooth))
    axes.plot(np.arange(len(raw)), raw, color=look["color"], linewidth=0.4, alpha=0.35, zorder=2,
              gid=f"fps-each.{strategy}")
    axes.plot(np.arange(len(smooth)), smooth, gid=f"fps.{strategy}", **look)


def _highest(axes, warm_up):
    """The largest value of a measured frame: the first frames may be far off, and fall outside."""
    highest = 0.0
    for line in axes.get_lines():
        values = line.get_ydata()[warm_up:]
        if not np.isnan(values).all():
            highest = max(highest, float(np.nanmax(values)))
    return highest or 1.0

