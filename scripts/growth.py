#!/usr/bin/env python3
"""Measures how building, loading and drawing grow with the model.

Without --mesh the model grows in detail: one fractal body at rising resolution, and a camera that
goes round it. The view is the same at every size.
With --mesh it grows in extent: copies of the mesh stand in rows that go away from the camera; a
larger model has more rows behind those of a smaller one, so the view begins with the same bodies
whatever its size, and more of them come into it.
Each size is built within a memory limit and replayed with Bool and Coh(B) under a budget of GPU
memory.
"""

import argparse
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time

from atomic_file import write_atomically, write_text_atomically
from fractal_body import write_fractal_body
from result_folder import read_run

SPACING = 2.6  # between bodies whose diagonal is 2, world units
FRAMES = 181
COLUMNS = ("triangles", "build_s", "build_mib", "file_mib", "load_s", "replay_mib", "bool_ms",
           "coh_ms", "bool_dn", "coh_dn", "bool_missing", "coh_missing")
DESCRIPTIONS = ("input triangles", "building, s", "most memory while building, MiB",
                "hierarchy file, MiB", "opening, checking and uploading, s",
                "most memory while replaying, MiB", "frame of Bool, ms", "frame of Coh(B), ms",
                "drawn nodes of Bool", "drawn nodes of Coh(B)", "nodes a frame not loaded, Bool",
                "nodes a frame not loaded, Coh(B)")


def place_bodies(count):
    """The nearest `count` places of a grid that widens away from the camera: [(x, z)]."""
    places = []
    row = 0
    while len(places) < count:
        wide = 3 + row  # bodies in this row
        places += [((i - (wide - 1) / 2) * SPACING, -row * SPACING) for i in range(wide)]
        row += 1
    return places[:count]


def write_scene(path, mesh, count):
    """A scene file of `count` copies of the mesh, each turned by another angle."""
    instances = [{"mesh": "body", "normalize": True, "scale": 2.0,
                  "rotate": {"axis": [0, 1, 0], "degrees": (i * 137.5) % 360},
                  "translate": [x, 0, z]} for i, (x, z) in enumerate(place_bodies(count))]
    scene = {"version": 1, "name": "growth", "meshes": {"body": {"file": os.path.abspath(mesh)}},
             "instances": instances}
    write_text_atomically(path, json.dumps(scene))


def make_walk():
    """A camera that walks along the first row, looking at it and over it."""
    return [{"t": t, "eye": [x, 1.6, 4.2], "look_at": [0.4 * x, 0.3, -2.0]}
            for t, x in ((0, -2.0), (1.5, 0.0), (3, 2.0))]


def make_orbit():
    """A camera that goes a part of the way round a body of radius 1, and to twice the distance.

    So every size is seen through a whole step of levels of detail, wherever its levels change.
    """
    return [{"t": t, "eye": [x * away, 0.2 * away, z * away], "look_at": [0, 0, 0]}
            for t, away, x, z in ((0, 2.65, -0.4, 0.9), (1.5, 3.75, 0.0, 1.0), (3, 5.3, 0.4, 0.9))]


def write_session(path, folder, keyframes):
    """The session of all sizes."""
    camera = {"name": "growth", "viewport": [640, 480], "fovy_deg": 50, "near": 0.02,
              "far": 400, "fps": 60, "keyframes": keyframes}
    source = os.path.join(folder, "growth.keyframes.json")
    write_text_atomically(source, json.dumps(camera))
    maker = os.path.join(os.path.dirname(os.path.abspath(__file__)), "make_session.py")
    subprocess.run([sys.executable, maker, source, path], check=True, stdout=subprocess.DEVNULL)


def run_measured(command):
    """Runs a command: (seconds, most resident memory in MiB, what it wrote to stderr)."""
    with tempfile.TemporaryFile("w+") as said:
        start = time.monotonic()
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=said)
        _, status, usage = os.wait4(child.pid, 0)
        seconds = time.monotonic() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read()
    if child.returncode != 0:
        sys.exit(f"growth.py: {' '.join(command)} ended with {child.returncode}: "
                 f"{text.strip().splitlines()[-1] if text.strip() else 'nothing said'}")
    return seconds, usage.ru_maxrss / 1024, text


class Detail:
    """Models that grow in detail."""

    keyframes = make_orbit()

    def write(self, folder, millions):
        """Writes the model; returns (its file, its triangles)."""
        path = os.path.join(folder, "growth.ply")
        return path, write_fractal_body(path, millions * 1e6)


class Extent:
    """Models that grow in extent, of copies of a mesh."""

    keyframes = make_walk()

    def __init__(self, program, mesh, folder):
        self.mesh = mesh
        self.mesh_triangles = read_mesh_size(program, mesh, folder)

    def write(self, folder, millions):
        """As Detail.write()."""
        count = max(1, round(millions * 1e6 / self.mesh_triangles))
        path = os.path.join(folder, "growth.scene.json")
        write_scene(path, self.mesh, count)
        return path, count * self.mesh_triangles


def measure(options, model, millions, session, folder):
    """One row of the table: {column: number}."""
    hierarchy = os.path.join(folder, "growth.hlod")
    row = dict.fromkeys(COLUMNS)
    scene, row["triangles"] = model.write(folder, millions)
    print(f"growth.py: building {row['triangles'] / 1e6:.1f}M triangles", file=sys.stderr)
    build = [options.program, "build", scene, "-o", hierarchy, "--preset", options.preset]
    if options.memory:
        build += ["--memory", options.memory]
    row["build_s"], row["build_mib"], _ = run_measured(build)
    row["file_mib"] = os.path.getsize(hierarchy) / 2**20
    os.unlink(scene)
    out = os.path.join(options.out, f"{row['triangles']}")
    run = [options.program, "run", "--scene", hierarchy, "--session", session, "--out", out,
           "--strategy", "bool,coh-b", "--images", "none", "--repetitions",
           str(options.repetitions), "--tau", str(options.tau)]
    if options.preset == "best":
        run += ["--faces", "front"]
    if options.gpu_memory:
        run += ["--gpu-memory", options.gpu_memory]
    print("growth.py: replaying", file=sys.stderr)
    _, row["replay_mib"], said = run_measured(run)
    loaded = re.search(r"uploaded in ([0-9.]+) s", said)
    row["load_s"] = float(loaded[1]) if loaded else None
    result = read_run(out)
    for key, strategy in (("bool", "bool"), ("coh", "coh-b")):
        cases = [case["summary"] for case in result.data["cases"]
                 if case["strategy"] == strategy]
        for column, counter in (("ms", "frame_ms"), ("dn", "dn"), ("missing", "missing_nodes")):
            values = [case["counters"][counter]["mean"] for case in cases
                      if counter in case["counters"]]
            row[f"{key}_{column}"] = sum(values) / len(values) if values else None
    os.unlink(hierarchy)
    return row


def format_number(value):
    if value is None:
        return "–"
    return f"{value:.0f}" if value >= 100 else f"{value:.2f}" if value < 10 else f"{value:.1f}"


def write_table(path, rows):
    """Markdown, a row a size."""
    lines = ["| " + " | ".join(DESCRIPTIONS) + " |", "|" + " ---: |" * len(COLUMNS)]
    lines += ["| " + " | ".join([f"{row['triangles'] / 1e6:.1f}M"] +
                                [format_number(row[column]) for column in COLUMNS[1:]]) + " |"
              for row in rows]
    write_text_atomically(path, "\n".join(lines) + "\n")


def write_csv(path, rows):
    with write_atomically(path) as temporary:
        with open(temporary, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)


def draw(folder, rows):
    """Four panels over the number of triangles: time to build, memory, frame time, DN."""
    from figure_style import PAGE_MM, line_look, new_figure, save_figure
    from strategy_style import style_of
    figure = new_figure(PAGE_MM, 100)
    size = [row["triangles"] / 1e6 for row in rows]
    (building, memory), (frames, nodes) = figure.subplots(2, 2)
    building.plot(size, [row["build_s"] for row in rows], "k-o", markersize=3)
    building.set(ylabel="building, s", yscale="log")
    for column, label, line in (("file_mib", "file", "k:^"), ("build_mib", "building", "k-o"),
                                ("replay_mib", "replaying", "k--s")):
        memory.plot(size, [row[column] for row in rows], line, markersize=3, label=label)
    memory.set(ylabel="most memory; file; MiB", yscale="log")
    memory.legend()
    for panel, column, label in ((frames, "ms", "frame, ms"), (nodes, "dn", "DN")):
        for key, strategy, name in (("bool", "bool", "Bool"), ("coh", "coh-b", "Coh(B)")):
            look = line_look(style_of(strategy), len(rows)) | {"markevery": 1}
            panel.plot(size, [row[f"{key}_{column}"] for row in rows], label=name, **look)
        panel.set(ylabel=label)
        panel.set_ylim(bottom=0)
        panel.legend()
    for panel in (building, memory, frames, nodes):
        panel.set(xscale="log", xlabel="input triangles, millions")
    save_figure(figure, folder, "growth", ("png", "svg"), 200)


def read_mesh_size(program, mesh, folder):
    """Triangles of the mesh, by building it once."""
    hierarchy = os.path.join(folder, "one.hlod")
    run_measured([program, "build", mesh, "-o", hierarchy, "--preset", "best"])
    said = subprocess.run([program, "info", hierarchy], check=True, capture_output=True,
                          text=True).stdout
    os.unlink(hierarchy)
    return int(re.search(r"^scene +(\d+) triangles", said, re.MULTILINE)[1])


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--mesh", help="mesh file whose copies make the models")
    parser.add_argument("--out", required=True, help="folder for growth.md, growth.csv, the "
                        "figure and the records; must not exist")
    parser.add_argument("--program", default="build/release/bench/hlodbench", help="hlodbench")
    parser.add_argument("--millions", type=float, nargs="+", default=[1, 5, 12, 50, 100],
                        help="sizes, million triangles")
    parser.add_argument("--preset", choices=["paper", "best"], default="best")
    parser.add_argument("--tau", type=float, default=0.25, help="pixels of error; 1 for the paper")
    parser.add_argument("--memory", default="2G", help="limit while building; empty: none")
    parser.add_argument("--gpu-memory", default="256M", help="budget of geometry; empty: none")
    parser.add_argument("--repetitions", type=int, default=3)
    options = parser.parse_args(arguments)
    if min(options.millions) <= 0:
        parser.error(f"--millions: expected numbers above 0, found {min(options.millions):g}")
    if not math.isfinite(options.tau) or options.tau <= 0:
        parser.error(f"--tau: expected a number above 0, found {options.tau:g}")
    if options.mesh is not None and not os.path.isfile(options.mesh):
        parser.error(f"--mesh: {options.mesh}: expected a mesh file, found none")
    if os.path.exists(options.out):
        parser.error(f"--out: {options.out}: expected a new folder, found something there")
    return options


def main():
    options = parse_arguments(sys.argv[1:])
    os.makedirs(options.out)
    with tempfile.TemporaryDirectory(dir=options.out, prefix=".") as folder:
        session = os.path.join(options.out, "growth.session.json")
        model = (Extent(options.program, options.mesh, folder) if options.mesh
                 else Detail())
        write_session(session, folder, model.keyframes)
        rows = []
        for millions in options.millions:
            rows.append(measure(options, model, millions, session, folder))
            # after each size: what is measured stays whatever happens to the next
            write_table(os.path.join(options.out, "growth.md"), rows)
            write_csv(os.path.join(options.out, "growth.csv"), rows)
    draw(options.out, rows)
    print(os.path.join(options.out, "growth.md"))


if __name__ == "__main__":
    main()
