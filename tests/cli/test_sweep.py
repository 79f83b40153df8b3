"""scripts/sweep with the real program: what is finished stays, whatever happens to the sweep."""

import csv
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import pytest
from small_scene import past_the_walls, write_session, write_walls

pytest.importorskip("yaml", reason="needs python3-yaml")
pytest.importorskip("numpy", reason="needs python3-numpy")
if not shutil.which("snakemake"):
    pytest.skip("needs snakemake", allow_module_level=True)

ROOT = pathlib.Path(__file__).resolve().parents[2]
SWEEP = """
scene: walls.scene.json
session: path.json
strategy: [bool, coh-b]
size: 80x60
s: [0.5, 1]
latency: ["draws:0", "frames:1"]
images: 2
timing: false
options: {max-triangles: 500}
"""
CELLS = 4


@pytest.fixture(scope="module")
def sweep(tmp_path_factory):
    """sweep(OUT, ...) gives the command line of a sweep of four cells, in a folder of its own."""
    exe = os.environ.get("HLODBENCH_EXE")
    if not exe:
        pytest.skip("HLODBENCH_EXE does not name the program; run the tests by ctest")
    folder = tmp_path_factory.mktemp("a sweep")
    write_walls(folder)
    write_session(folder / "path.json", past_the_walls(25))
    (folder / "walls.sweep.yaml").write_text(SWEEP, encoding="utf-8")

    def command(out, *arguments):
        return [sys.executable, str(ROOT / "scripts/sweep"), str(folder / "walls.sweep.yaml"),
                "--out", str(out), "--hlodbench", exe, "--cache", str(folder / "cache"),
                *map(str, arguments)]

    command.folder = folder
    return command


@pytest.fixture(scope="module")
def whole(sweep):
    """The table of a sweep that nothing disturbed."""
    out = sweep.folder / "whole"
    done = subprocess.run(sweep(out), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return (out / "sweep.csv").read_bytes()


def finished(out):
    """When and as which file each finished cell was written."""
    stats = {path: path.stat() for path in out.glob("cells/[!.]*/run.json")}
    return {path.parent.name: (stat.st_mtime_ns, stat.st_ino) for path, stat in stats.items()}


def working_in(out):
    """Processes whose command line names the folder's cells or which run in it."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            where = os.readlink(process / "cwd")
            said = (process / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if where == str(out) or str(out).encode() in said:
            found.append((process.name, said))
    return found


def wait_until(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_table_has_a_row_for_each_cell_and_strategy(whole):
    rows = list(csv.DictReader(whole.decode().splitlines()))
    assert len(rows) == 2 * CELLS
    assert {(r["strategy"], r["s"], r["latency"]) for r in rows} == {
        (strategy, s, latency) for strategy in ("bool", "coh-b") for s in ("0.5", "1")
        for latency in ("draws:0", "frames:1")}
    for row in rows:
        assert float(row["dn"]) > 0 and row["size"] == "80x60"
        assert row["option.max-triangles"] == "500" and 10 < float(row["psnr_full_y"]) < 100
        assert "fps" not in row and not any(key.endswith("_ms") for key in row)
    by_latency = {r["latency"]: float(r["rarn"]) for r in rows
                  if (r["strategy"], r["s"]) == ("coh-b", "1")}
    assert by_latency["draws:0"] <= by_latency["frames:1"]


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_killed_sweep_resumes_and_gives_the_same_table(sweep, whole, how):
    out = sweep.folder / how.name
    process = subprocess.Popen(sweep(out, "--cores", 1), stderr=subprocess.PIPE, text=True)
    wait_until(lambda: len(finished(out)) >= 1 or process.poll() is not None)
    process.send_signal(how)
    said = process.communicate()[1]
    wait_until(lambda: not working_in(out), 20)
    before = finished(out)
    assert 1 <= len(before) < CELLS, said
    if how == signal.SIGINT:
        assert process.returncode == 130
        assert f"interrupted: {len(before)} of 4 cells are there" in said
        rows = (out / "sweep.csv").read_text().splitlines()
        assert len(rows) == 1 + 2 * len(before)
        # No process was killed outright, so nothing unfinished lies about.
        assert [p.name for p in (out / "cells").glob(".*")] == []
    else:
        assert process.returncode == -signal.SIGKILL

    done = subprocess.run(sweep(out), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert f"4 cells, {CELLS - len(before)} to run" in done.stderr
    after = finished(out)
    assert len(after) == CELLS and {key: after[key] for key in before} == before
    assert (out / "sweep.csv").read_bytes() == whole


def test_half_written_cell_is_run_again(sweep, whole):
    out = sweep.folder / "damaged"
    shutil.copytree(sweep.folder / "whole", out, copy_function=shutil.copy2)
    first, second, third, *_ = sorted((out / "cells").iterdir())
    text = (first / "run.json").read_text()
    (first / "run.json").write_text(text[: len(text) // 2])
    (second / "run.json").write_text((second / "run.json").read_text().replace(
        '"complete": true', '"complete": false'))
    shutil.rmtree(third / "images")
    done = subprocess.run(sweep(out), capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "4 cells, 3 to run" in done.stderr, done.stderr
    assert done.stderr.count("run again: ") == 3
    assert (out / "sweep.csv").read_bytes() == whole


def test_latency_tables_of_two_runs_are_the_same_bytes(sweep):
    pytest.importorskip("matplotlib", reason="needs python3-matplotlib")
    command = sweep(sweep.folder / "first", "--cores", 2, "--dpi", 60)
    command[1] = str(ROOT / "scripts/latency.py")
    command[2] = str(sweep.folder / "latency.sweep.yaml")
    text = SWEEP.replace("s: [0.5, 1]\n", "").replace('"frames:1"', '"draws:9", "frames:1"')
    pathlib.Path(command[2]).write_text(text, encoding="utf-8")
    tables = []
    for name in ("first", "second"):
        command[command.index("--out") + 1] = str(sweep.folder / name)
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert "3 cells, 3 to run" in done.stderr
        tables.append((sweep.folder / name / "latency.csv").read_bytes())
        assert (sweep.folder / name / "latency_walls.pdf").stat().st_size > 0
    assert tables[0] == tables[1]
    rows = list(csv.DictReader(tables[0].decode().splitlines()))
    assert [(row["strategy"], row["latency"]) for row in rows] == [
        (strategy, latency) for strategy in ("bool", "coh-b")
        for latency in ("draws:0", "draws:9", "frames:1")]
    coh = [row for row in rows if row["strategy"] == "coh-b"]
    assert len({row["rarn"] for row in coh} | {row["d"] for row in coh}) > 1  # latency matters
    assert all(float(row["psnr_full_y"]) > 10 for row in rows)
