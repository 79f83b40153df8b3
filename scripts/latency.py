#!/usr/bin/env python3
"""Runs a sweep over the latency of query results and draws what it costs each strategy.

The first run does everything; after that only what is missing or changed is run again, and figure and
tables are made anew. Fixed latencies (draws:N, frames:N) give the same tables every time, to the byte;
what the driver gives (gl) stands in a table of its own.
"""

import argparse
import csv
import pathlib
import re
import sys

try:
    from atomic_file import write_atomically, write_text_atomically
    from figure_latency import draw_latency
    from figure_style import Skipped, save_figure
    from latency_data import (COUNTERS, TELLING, UNITS, VALUES, describe_equivalent,
                              find_equivalent, read_curves)
    from result_folder import ResultError
    from sweeping import cli as sweep
    from sweeping.table import TableError, format_number
except ImportError as error:
    print(f"latency.py: needs {error.name} (Debian: python3-matplotlib python3-numpy python3-yaml)",
          file=sys.stderr)
    sys.exit(2)

EPILOG = """\
example:
  scripts/latency.py sessions/courtyard.latency.sweep.yaml --out results/runs/latency

Leaves in DIR: latency_SCENE.pdf and .png, latency.csv (fixed latencies), latency_gl.csv (the
driver's, with its spread), latency.md (captions), and the sweep itself in DIR/sweep. Options that
are not listed here are those of scripts/sweep: --cores, --cache, --hlodbench, --profile.
Exit codes: 0 done; 1 a cell or a figure is missing; 2 wrong usage or input; 130 interrupted."""
FORMATS = ("pdf", "png")
HEAD = ("scene", "session", "size", "tau", "s", "t", "strategy", "label")


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(prog="latency.py", description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter,
                                     allow_abbrev=False)
    parser.add_argument("file", metavar="FILE.yaml", help="description of the sweep")
    parser.add_argument("--out", metavar="DIR", type=pathlib.Path, required=True,
                        help="where to write; made if need be")
    parser.add_argument("--dpi", metavar="N", type=int, default=300,
                        help="dots per inch of the PNG, 50 to 1200 (%(default)s)")
    options, others = parser.parse_known_args(arguments)
    if not 50 <= options.dpi <= 1200:
        parser.error(f"--dpi: expected 50 to 1200, found {options.dpi}")
    return options, others


def name_figures(all_curves):
    """latency_SCENE, with a number after the second of a scene."""
    names = []
    for curves in all_curves:
        scene = re.sub(r"[^A-Za-z0-9._-]+", "_", curves.parameters["scene"])
        base = f"latency_{scene or 'scene'}"
        count = sum(name == base or name.startswith(f"{base}-") for name in names)
        names.append(base if count == 0 else f"{base}-{count + 1}")
    return names


def write_csv(path, columns, rows):
    with write_atomically(str(path)) as temporary, open(temporary, "w", newline="",
                                                        encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def list_fixed(all_curves):
    """The rows of latency.csv: exact, so that two runs can be compared to the byte."""
    columns = [*HEAD, "latency", *VALUES, "psnr_identical"]
    rows = []
    for curves in all_curves:
        for strategy in curves.labels:
            for unit in UNITS:
                rows += [{key: row.get(key, "") for key in columns}
                         for _, row in curves.fixed.get((strategy, unit), [])]
    return columns, rows


def list_driver(all_curves):
    """The rows of latency_gl.csv: mean, spread over the repetitions, equivalent latency."""
    columns = [*HEAD, "repetitions", "value", "mean", "low", "high", "equivalent_draws"]
    rows = []
    for curves in all_curves:
        for strategy, driver in curves.driver.items():
            for key, mean in driver.means.items():
                low, high = driver.spreads.get(key, (None, None))
                found = (find_equivalent(*curves.points(strategy, "draws", key), mean)
                         if describe_equivalent(curves, strategy, key) else [])
                is_told = key in TELLING and len(found) == 1
                rows.append({
                    **{k: v for k, v in curves.parameters.items() if k in columns},
                    "strategy": strategy, "label": curves.labels[strategy], "value": key,
                    "repetitions": driver.repetitions if key in COUNTERS else 1,
                    "mean": format_number(mean), "low": format_number(low),
                    "high": format_number(high),
                    "equivalent_draws": f"{found[0][1]:.1f}" if is_told else ""})
    return columns, rows


def make_title(curves):
    p = curves.parameters
    return (f"{p['scene']}: session {p['session']}, {p['size']} pixels, tau {p['tau']}, "
            f"s {p['s']}, t {p['t']}: what the latency of query results costs")


def make_caption(name, curves):
    """What the figure shows and how to read the driver's latency off it, as Markdown."""
    lines = [f"## {name}", "",
             make_title(curves) + ". Means over the measured frames. Left: the result of a query "
             "is there after so many draws (logarithmic, with a 0); right, `1f`: after so many "
             "frames, that is within no frame unless it is waited for. Counts repeat exactly. PSNR "
             "against Bool is the mean over the pictures that differ from Bool's, which may be few."]
    left_out = [curves.labels[s] for s in curves.labels if curves.delays_all(s)]
    if left_out:
        lines[-1] += f" D leaves out what delays every node it draws: {', '.join(left_out)}."
    if not curves.driver:
        return "\n".join(lines) + "\n"
    repetitions = max(driver.repetitions for driver in curves.driver.values())
    lines += ["",
              f"Horizontal lines: the driver's own latency (gl), mean of {repetitions} repetitions; "
              "bands: from the least to the most of them (95 % bootstrap interval of more than "
              "five). PSNR is that of the first repetition and has no band. The latency in draws "
              "that the driver's is worth is read where its line of RARN, D or DN crosses the "
              "curve, interpolated on the axis shown. A driver's latency differs from query to "
              "query, so these need not agree, and a value that no fixed latency gives is worth "
              "none:", "",
              "| strategy | by RARN | by D | by DN |", "|---|---|---|---|"]
    for strategy in curves.driver:
        told = [describe_equivalent(curves, strategy, key) or "–" for key in TELLING]
        lines.append(f"| {curves.labels[strategy]} | " + " | ".join(told) + " |")
    return "\n".join(lines) + "\n"


def make(options):
    """Figures and tables from DIR/sweep; returns the lines that say what could not be made."""
    all_curves = read_curves(options.out / "sweep")
    write_csv(options.out / "latency.csv", *list_fixed(all_curves))
    write_csv(options.out / "latency_gl.csv", *list_driver(all_curves))
    names = name_figures(all_curves)
    skipped = []
    for name, curves in zip(names, all_curves):
        try:
            figure = draw_latency(curves, make_title(curves))
        except Skipped as reason:
            skipped.append(f"{name}: not made: {reason}")
            continue
        print("\n".join(save_figure(figure, options.out, name, FORMATS, options.dpi)))
    captions = "\n".join(map(make_caption, names, all_curves))
    write_text_atomically(str(options.out / "latency.md"), captions)
    return skipped


def main(arguments=None):
    options, others = parse_arguments(arguments)
    try:
        options.out.mkdir(parents=True, exist_ok=True)
        code = sweep.main([options.file, "--out", str(options.out / "sweep"), *others])
        if code not in (0, 1) or "--dry-run" in others:
            return code
        skipped = make(options)
    except (TableError, ResultError) as error:
        print(f"latency.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"latency.py: {error.filename or options.out}: {error.strerror}", file=sys.stderr)
        return 2
    for line in skipped:
        print(f"latency.py: {line}", file=sys.stderr)
    return 1 if skipped else code


if __name__ == "__main__":
    sys.exit(main())
