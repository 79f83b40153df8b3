#!/usr/bin/env python3
"""Draws the figures of the paper from folders that `hlodbench run` left.

  fig1a        the bias B over the relative visibility mu, for several s and t, from the program
  fig4_SCENE   drawn nodes and frame rate over the session, all strategies
  fig5_SCENE   one frame under Bool, Simp(B) and Coh(B), the detail that is worst against Bool, and
               the modulation of the error; needs the run's pictures
"""

import argparse
import os
import re
import sys
from pathlib import Path

try:
    from figure_bias import draw_bias, read_bias
    from figure_pictures import draw_pictures
    from figure_session import draw_session
    from figure_style import Skipped, save_figure
    from result_folder import ResultError, read_run
except ImportError as error:
    print(f"figures.py: needs {error.name} (Debian: python3-matplotlib python3-numpy python3-pil)",
          file=sys.stderr)
    sys.exit(2)

EPILOG = """\
Figures are made for print, 85 mm (fig1a) or 175 mm wide; the same input gives the same bytes.
For fig5, run with pictures and the overlay: hlodbench run --images 20 --overlay bias ...
The detail is searched for in all pictures. A second run of the same scene gets the name SCENE-2.

What is missing in a folder is said on stderr, one line each; a figure that lacks only a strategy or
a repetition is drawn without it.
Exit codes: 0 every figure was made; 1 one or more could not be, the others were; 2 wrong usage, a
folder without a usable run.json, or nowhere to write: nothing was made.
"""
ROOT = Path(__file__).resolve().parents[1]
FIGURES = ("1a", "4", "5")
FORMATS = ("svg", "png")


def list_of(known):
    """An argparse type: comma-separated values, each one of `known`."""
    def parse(text):
        values = list(dict.fromkeys(text.split(",")))
        for value in values:
            if value not in known:
                raise argparse.ArgumentTypeError(
                    f"expected some of {','.join(known)}, found {value!r}")
        return values
    return parse


def dpi(text):
    """An argparse type: dots per inch."""
    if not text.isdecimal() or not 50 <= int(text) <= 1200:
        raise argparse.ArgumentTypeError(f"expected 50 to 1200 dots per inch, found {text!r}")
    return int(text)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        prog="figures.py", description=__doc__, epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", metavar="DIR", nargs="+",
                        help="result folder of `hlodbench run`")
    parser.add_argument("--out", metavar="FOLDER", required=True,
                        help="where to write; made if need be, and figures there are replaced")
    parser.add_argument("--figures", metavar="LIST", type=list_of(FIGURES), default=list(FIGURES),
                        help="which, of 1a,4,5 (default: all)")
    parser.add_argument("--detail", choices=("error", "rarn"), default="error",
                        help="fig5 shows where the error against Bool is largest, or the frame "
                             "with the most nodes rendered and then refined (default: error)")
    parser.add_argument("--hlodbench", metavar="PROGRAM",
                        default=ROOT / "build" / "release" / "bench" / "hlodbench",
                        help="the program, for fig1a (default: build/release/bench/hlodbench)")
    parser.add_argument("--formats", metavar="LIST", type=list_of(FORMATS), default=list(FORMATS),
                        help="of svg,png (default: both)")
    parser.add_argument("--dpi", metavar="N", type=dpi, default=300,
                        help="dots per inch of PNG and of pictures in SVG (default: 300)")
    return parser.parse_args(arguments)


def plan(runs, options):
    """What to make: a list of (name, function that draws it)."""
    planned = []
    if "1a" in options.figures:
        planned.append(("fig1a", lambda: draw_bias(read_bias(options.hlodbench))))
    for scene, run in zip(name_scenes(runs), runs):
        if "4" in options.figures:
            planned.append((f"fig4_{scene}", lambda run=run: draw_session(run)))
        if "5" in options.figures:
            planned.append((f"fig5_{scene}", lambda run=run: draw_pictures(run, options.detail)))
    return planned


def name_scenes(runs):
    """The name of each run's scene, fit for a file name and different from those before."""
    names = []
    for run in runs:
        base = re.sub(r"[^A-Za-z0-9._-]+", "_", run.scene) or "scene"
        name, number = base, 1
        while name in names:
            number += 1
            name = f"{base}-{number}"
        names.append(name)
    return names


def make(planned, options):
    """Draws and writes everything; returns the lines that say what could not be made."""
    skipped = []
    for name, draw in planned:
        try:
            paths = save_figure(draw(), options.out, name, options.formats, options.dpi)
        except Skipped as reason:
            skipped.append(f"{name}: not made: {reason}")
        else:
            print("\n".join(paths))
    return skipped


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        runs = [read_run(folder) for folder in options.folders]
        os.makedirs(options.out, exist_ok=True)
        skipped = make(plan(runs, options), options)
    except ResultError as error:
        print(f"figures.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"figures.py: {error.filename or options.out}: {error.strerror}", file=sys.stderr)
        return 2
    problems = [problem for run in runs for problem in run.problems
                if not any(problem in line for line in skipped)]
    if "5" not in options.figures:
        problems = [problem for problem in problems if "images.json" not in problem]
    for line in problems + skipped:
        print(f"figures.py: {line}", file=sys.stderr)
    return 1 if skipped else 0


if __name__ == "__main__":
    sys.exit(main())
