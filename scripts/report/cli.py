"""Options of report.py, and the order of things."""

import argparse
import os
import pathlib
import sys

from atomic_file import write_text_atomically
from result_folder import ResultError, read_run

from . import environment, pictures, program_table, quality, series, sweeps
from .page import MissingLibrary, read_library, render_page
from .values import format_count

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "release" / "bench" / "hlodbench"
PLOT_LIBRARY = pathlib.Path("/usr/share/javascript/dygraphs")
MEGABYTE = 1_000_000

DESCRIPTION = """\
Makes one HTML file that shows result folders of `hlodbench run`: Table 1 beside the paper's values,
PSNR, every counter over the frames, and the pictures of the frames that have some. It opens from
disk and loads nothing: send it, keep it, print it. Folders of scripts/sweep give heat-maps."""

EPILOG = """\
A folder that is damaged or cut short is shown as far as it goes, and the report says what is
missing. Exit codes: 0 the report was written; 2 wrong usage, no usable folder, or dygraphs is
missing."""


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(prog="report.py", description=DESCRIPTION, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", metavar="DIR", nargs="+", type=pathlib.Path,
                        help="result folder of `hlodbench run`, or folder of scripts/sweep")
    parser.add_argument("--out", metavar="FILE", type=pathlib.Path,
                        help="the report (default: report.html in DIR; with several DIR, in the "
                        "folder that holds them all)")
    parser.add_argument("--hlodbench", metavar="PROGRAM", type=pathlib.Path, default=PROGRAM,
                        help="the program, which computes Table 1 (default: "
                        "build/release/bench/hlodbench in the repository)")
    parser.add_argument("--plot-library", metavar="FOLDER", type=pathlib.Path,
                        default=PLOT_LIBRARY,
                        help="folder with dygraph.min.js and dygraph.min.css "
                        "(default: %(default)s)")
    parser.add_argument("--max-size", metavar="MB", type=float, default=25.0,
                        help="largest size of the report in MB; to keep it, pictures get coarser, "
                        "then overlays and frames are left out (default: %(default)g)")
    options = parser.parse_args(arguments)
    if not 1 <= options.max_size <= 2000:
        parser.error(f"--max-size: expected 1 to 2000 MB, found {options.max_size:g}")
    return options


def read_all(folders):
    """(runs, problems): the usable folders, each once, and a line for each of the others."""
    runs, problems, seen = [], [], set()
    for folder in folders:
        if folder.resolve() in seen:
            continue
        seen.add(folder.resolve())
        try:
            runs.append(read_run(folder))
        except ResultError as error:
            problems.append(str(error))
    return runs, problems


def choose_output(folders):
    """Where the report goes by default."""
    if len(folders) == 1:
        return folders[0] / "report.html"
    return pathlib.Path(os.path.commonpath([f.resolve() for f in folders])) / "report.html"


def name_runs(runs):
    """What the page calls each run: its scene, and with several of one scene its folder, too."""
    scenes = [run.scene for run in runs]
    folders = [run.folder.resolve().name for run in runs]
    names = []
    for run, scene, folder in zip(runs, scenes, folders):
        if scenes.count(scene) == 1:
            names.append(scene)
        else:
            names.append(f"{scene} ({folder if folders.count(folder) == 1 else run.folder})")
    return names


def make_scene(index, name, run, embedded, table, paper):
    """What the page shows of one run."""
    folder = str(run.folder)
    data = run.data
    facts = (f"{format_count(data['scene'].get('triangles'))} triangles, "
             f"{format_count(data['scene'].get('nodes'))} nodes; "
             f"session {data['session'].get('name')}, {data['session']['frames']} frames; "
             f"repetitions: {data.get('repetitions')}")
    return {
        "id": f"scene-{index}",
        "name": name,
        "folder": folder,
        "facts": facts,
        "rows": table.rows.get(folder, []),
        "paper_scene": table.scenes.get(folder, ""),
        "ratios": table.ratios.get(folder, ""),
        "quality": quality.make_quality(run, paper),
        "selection": quality.describe_selection(run),
        "data": {**series.make_scene_data(run), "pictures": embedded.data or None},
        "uris": embedded.uris,
        "counters": [series.describe_counter(key) for key in series.list_counters(run)],
        "strategies": [(s, run.label(s)) for s in run.strategies()],
    }


def make_content(options, runs, swept, problems):
    """The variables of the page."""
    paper = program_table.read_paper(ROOT / "results" / "paper_table1.json")
    table = (program_table.make_table(options.hlodbench, [run.folder for run in runs], paper)
             if runs else program_table.Table())
    # Numbers and the page itself take about one megabyte.
    embedded, level = pictures.embed_all(runs, max(options.max_size - 1, 0.5) * MEGABYTE)
    scenes = [make_scene(i, *parts, table, paper)
              for i, parts in enumerate(zip(name_runs(runs), runs, embedded))]
    lines = problems + [p for run in runs for p in run.problems]
    lines += [p for p in table.problems if table.texts]
    return {
        "title": ", ".join(dict.fromkeys([run.scene for run in runs] + [s["name"] for s in swept])),
        "environment": environment.make_environment(runs),
        "warnings": environment.collect_warnings(runs),
        "problems": lines,
        "table": table,
        "columns": program_table.COLUMNS,
        "scenes": scenes,
        "sweeps": swept,
        "picture_lines": (pictures.describe_level(level, runs)
                          if any(e.uris for e in embedded) else []),
    }


def fail(message):
    print(f"report.py: {message}", file=sys.stderr)
    return 2


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        library = read_library(options.plot_library)
    except MissingLibrary as error:
        return fail(str(error))
    folders = [folder for folder in options.folders if not sweeps.is_sweep(folder)]
    runs, problems = read_all(folders)
    swept, more = sweeps.read_sweeps([f for f in options.folders if f not in folders])
    problems += more
    if not runs and not swept:
        return fail("; ".join(problems))
    path = options.out or choose_output(options.folders)
    content = make_content(options, runs, swept, problems)
    text = render_page(library, content)
    try:
        write_text_atomically(path, text)
    except OSError as error:
        return fail(f"{path}: {error.strerror}")
    pictures_of = [scene["data"]["pictures"] for scene in content["scenes"]]
    frames = sum(len(shown["frames"]) for shown in pictures_of if shown)
    count = len(content["problems"])
    shown = f"{len(runs)} results, " + (f"{len(swept)} sweeps, " if swept else "")
    print(f"{path}: {shown}{frames} frames with pictures, "
          f"{len(text.encode()) / MEGABYTE:.1f} MB"
          + (f"; {count} problems, which it lists" if count else ""), file=sys.stderr)
    return 0
