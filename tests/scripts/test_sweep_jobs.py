"""scripts/sweep with a stand-in for the program: what runs when, what again, and what is said."""

import csv
import itertools
import json
import os
import pathlib
import shutil
import stat
import subprocess
import sys

import pytest

pytest.importorskip("yaml", reason="needs python3-yaml")
np = pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
if not shutil.which("snakemake"):
    pytest.skip("needs snakemake", allow_module_level=True)

import fake_hlodbench  # noqa: E402
from result_folder import read_run  # noqa: E402
from sweeping.description import read_description  # noqa: E402
from sweeping.inputs import Inputs  # noqa: E402
from sweeping.plan import make_plan  # noqa: E402
from sweeping.program import Program  # noqa: E402
from sweeping.table import (PARAMETERS, bootstrap_interval, read_table,  # noqa: E402
                            swept_parameters)

ROOT = pathlib.Path(__file__).resolve().parents[2]
SBATCH = """#!/bin/bash
echo "$*" >>"$SLURM/calls"
number=$(wc -l <"$SLURM/calls")
if bash "${!#}" >"$SLURM/$number.said" 2>&1; then state=COMPLETED; else state=FAILED; fi
echo "$state" >"$SLURM/$number.state"
echo "$number"
"""
SACCT = """#!/bin/bash
for word; do case $word in --jobs=*) cat "$SLURM/${word#--jobs=}.state" ;; esac; done
"""


def add_program(path, text):
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


class Sweep:
    """A description in a folder of its own, and what came of it."""

    def __init__(self, folder):
        self.folder, self.out, self.log = folder, folder / "out", folder / "log"
        fake = fake_hlodbench.PROGRAM.format(
            python=sys.executable, folder=str(pathlib.Path(fake_hlodbench.__file__).parent))
        self.program = add_program(folder / "hlodbench", fake)
        self.environment = {**os.environ, "FAKE_LOG": str(self.log)}
        for name in ("one.scene.json", "two.scene.json", "walk.json"):
            (folder / name).write_text(f'{{"name": "{name}"}}', encoding="utf-8")

    def run(self, text, *arguments):
        """Runs scripts/sweep on the description; the calls of the program since are `calls`."""
        (self.folder / "my.sweep.yaml").write_text(text, encoding="utf-8")
        self.log.write_text("", encoding="utf-8")
        return subprocess.run(
            [sys.executable, ROOT / "scripts/sweep", self.folder / "my.sweep.yaml", "--out",
             self.out, "--hlodbench", self.program, "--cache", self.folder / "cache", "--cores",
             "2", *map(str, arguments)],
            capture_output=True, text=True, check=False, env=self.environment, timeout=300)

    def calls(self, command):
        lines = map(json.loads, self.log.read_text(encoding="utf-8").splitlines())
        return [line for line in lines if line["command"] == command]

    def rows(self):
        with open(self.out / "sweep.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))


@pytest.fixture
def sweep(tmp_path):
    return Sweep(tmp_path)


def value_of(call, option):
    return call["arguments"][call["arguments"].index(option) + 1]


BASE = "scene: one.scene.json\nsession: walk.json\nstrategy: [bool, coh-b]\n"
MIXED = BASE.replace("one.scene.json", "[one.scene.json, two.scene.json]") + """
blocks:
  - {latency: gl, repetitions: 3, size: [64x48, 32x24]}
  - {latency: ["frames:0", "frames:1"], timing: false}
"""


def test_timed_cells_and_builds_run_alone_and_the_others_side_by_side(sweep, tmp_path):
    (tmp_path / "meeting").mkdir()
    sweep.environment["FAKE_MEET"] = str(tmp_path / "meeting")
    done = sweep.run(MIXED)
    assert done.returncode == 0, done.stderr
    runs, builds = sweep.calls("run"), sweep.calls("build")
    assert len(runs) == 8 and len(builds) == 2
    assert len({value_of(call, "-o") for call in builds}) == 2
    counted = [call for call in runs if value_of(call, "--latency") != "gl"]
    timed = [call for call in runs if call not in counted]
    for alone, other in itertools.product(timed + builds, runs + builds):
        apart = other["ended"] <= alone["begun"] or alone["ended"] <= other["begun"]
        assert alone is other or apart
    first, second = sorted(counted, key=lambda call: call["begun"])[:2]
    assert second["begun"] < first["ended"]  # they waited for each other
    assert {call["threads"] for call in counted} == {"0"}
    assert {call["threads"] for call in timed} == {os.environ.get("LP_NUM_THREADS")}


def test_table_says_what_the_result_folders_say(sweep):
    done = sweep.run(BASE + "s: [0.25, 1.0]\nrepetitions: 3\nimages: 2\noptions: {simp: mean}\n")
    assert done.returncode == 0, done.stderr
    rows = sweep.rows()
    assert [(r["s"], r["strategy"]) for r in rows] == list(
        itertools.product(("0.25", "1"), ("bool", "coh-b")))
    assert swept_parameters(rows) == ["s"]
    for row in rows:
        run = read_run(sweep.out / "cells" / row["cell"])
        cases = [case for case in run.cases if case.strategy == row["strategy"]]
        measured = [case.columns["dn"][5:] for case in cases]
        assert float(row["dn"]) == pytest.approx(np.concatenate(measured).mean())
        times = np.array([case.columns["frame_ms"][5:] for case in cases])
        assert float(row["fps"]) == pytest.approx(1000 / times.mean())
        low, high = float(row["fps_low"]), float(row["fps_high"])
        assert (low, high) == pytest.approx((1000 / times.mean(axis=1).max(),
                                             1000 / times.mean(axis=1).min()))
        assert low < float(row["fps"]) < high
        summary = next(s["summary"] for s in run.images["strategies"]
                       if s["strategy"] == row["strategy"])
        mean = summary["vs_full"]["y"]["mean"]  # None where every picture is identical
        assert row["psnr_full_y"] == ("" if mean is None else repr(mean))
        assert row["option.simp"] == "mean"
    assert [row["psnr_y"] == "" for row in rows] == [True, False] * 2  # Bool is the reference


def test_failed_cells_are_named_with_the_reason_and_the_rest_stands(sweep):
    text = BASE + "s: [0, 0.5, 1]\noptions: {gl-debug: true}\n"
    sweep.environment["FAKE_FAIL"] = "--s=0.5"
    done = sweep.run(text)
    assert done.returncode == 1
    assert [line for line in done.stderr.splitlines() if "failed" in line][0].startswith(
        "sweep: scene=one session=walk s=0.5 gl-debug=true: failed: hlodbench: the reason why (")
    assert "sweep: 1 of 3 cells failed" in done.stderr
    assert [row["s"] for row in sweep.rows()] == ["0", "0", "1", "1"]
    assert all("--gl-debug" in call["arguments"] for call in sweep.calls("run"))
    del sweep.environment["FAKE_FAIL"]
    done = sweep.run(text)
    assert done.returncode == 0, done.stderr
    assert [value_of(call, "--s") for call in sweep.calls("run")] == ["0.5"]
    assert [row["s"] for row in sweep.rows()] == ["0", "0", "0.5", "0.5", "1", "1"]


def test_only_what_changed_is_run_again(sweep):
    text = BASE + "t: [0.1, 0.5]\nlatency: 'draws:5'\ntiming: false\n"
    assert sweep.run(text).returncode == 0
    assert len(sweep.calls("run")) == 2
    assert sweep.run(text.replace("0.1, 0.5", "0.50, 0.9")).returncode == 0
    assert [value_of(call, "--t") for call in sweep.calls("run")] == ["0.9"]
    assert [row["t"] for row in sweep.rows()] == ["0.5", "0.5", "0.9", "0.9"]
    sweep.run("# only a comment\n" + text)  # and what was run before is still there
    assert sweep.calls("run") == [] and sweep.calls("build") == []


def test_identity_follows_from_everything_that_a_result_follows_from(sweep, tmp_path):
    text = BASE + "t: 0.5\noptions: {simp: last}\n"

    def plan(text):
        (tmp_path / "my.sweep.yaml").write_text(text, encoding="utf-8")
        program = Program(sweep.program)
        description = read_description(tmp_path / "my.sweep.yaml", program.run_options)
        return make_plan(description, program, Inputs(), tmp_path, 2)

    def identify(text):
        (cell,) = plan(text).cells
        return cell

    first = identify(text)
    assert identify("# a comment\n" + text.replace("0.5", "0.50")) == first
    shutil.copytree(tmp_path, tmp_path.parent / "another folder")
    assert identify(text.replace("one.scene", "../another folder/one.scene")) == first
    different = {identify(text.replace(*change)) for change in (
        ("0.5", "0.6"), ("last", "mean"), ("[bool, coh-b]", "[bool]"), ("one.", "two."),
        ("t: 0.5", "t: 0.5\ntiming: false"), ("simp", "max-triangles"))}
    assert len(different | {first}) == 7
    for name in ("walk.json", "one.scene.json", "hlodbench"):
        before = identify(text)
        with open(tmp_path / name, "a", encoding="utf-8") as file:
            file.write("\n")
        assert identify(text) not in different | {first, before}
    # An option that names a file counts by its contents, and is found wherever the job runs.
    (tmp_path / "library.so").write_text("code", encoding="utf-8")
    library = text.replace("last", "./library.so")
    before = identify(library)
    assert str(tmp_path / "library.so") in plan(library).cells[before].arguments
    (tmp_path / "library.so").write_text("other code", encoding="utf-8")
    assert identify(library) != before
    (tmp_path / "mesh.ply").write_text("a mesh", encoding="utf-8")
    (tmp_path / "one.scene.json").write_text(
        '{"meshes": {"a": {"file": "${NO_SUCH_FOLDER:-.}/mesh.ply"}}}', encoding="utf-8")
    before = identify(text)
    (tmp_path / "mesh.ply").write_text("another", encoding="utf-8")
    assert identify(text) != before


def test_dry_run_says_what_would_be_run_and_runs_nothing(sweep):
    done = sweep.run(MIXED, "--dry-run")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "8 cells, 8 to run, on 2 hierarchies"
    assert done.stdout.count("(timed)") == 4 and not sweep.out.exists()
    assert sweep.calls("run") == sweep.calls("build") == []


def test_slurm_profile_submits_timed_cells_to_nodes_of_their_own(sweep, tmp_path):
    add_program(tmp_path / "bin" / "sbatch", SBATCH)
    add_program(tmp_path / "bin" / "sacct", SACCT)
    (tmp_path / "slurm").mkdir()
    sweep.environment.update(PATH=f"{tmp_path / 'bin'}:{os.environ['PATH']}",
                             SLURM=str(tmp_path / "slurm"), FAKE_FAIL="--size=16x12",
                             CI="true")  # Snakemake then asks more often
    text = MIXED.replace("[one.scene.json, two.scene.json]", "one.scene.json").replace(
        "32x24", "16x12").replace(', "frames:1"', "")
    done = sweep.run(text, "--profile", "slurm", "--dry-run")
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "slurm" / "calls").exists()
    done = sweep.run(text, "--profile", "slurm")
    assert done.returncode == 1 and "failed: hlodbench: the reason why" in done.stderr, done.stderr
    calls = (tmp_path / "slurm" / "calls").read_text(encoding="utf-8").splitlines()
    assert len(calls) == 4  # a hierarchy and three cells
    alone = [call for call in calls if "--exclusive" in call]
    assert len(alone) == 2 and all("--job-name=hlodbench-cell" in call for call in alone)
    assert "--cpus-per-task=8" in next(call for call in calls if "hlodbench-hierarchy" in call)
    assert len(sweep.rows()) == 4


def test_second_sweep_in_one_folder_is_refused(sweep):
    import fcntl
    assert sweep.run(BASE).returncode == 0
    with open(sweep.out / ".lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = sweep.run(BASE + "s: 0.5\n")
    assert done.returncode == 2 and sweep.calls("run") == []
    assert done.stderr.count("\n") == 1 and "no other sweep" in done.stderr


def test_how_a_cell_was_measured_is_no_parameter_where_others_tell_it_apart():
    def rows(*cells):
        keys = ("latency", "repetitions", "timing")
        fixed = dict.fromkeys(PARAMETERS, "0")
        return [{**fixed, **dict(zip(keys, cell)), "strategy": s} for cell in cells for s in "ab"]
    assert swept_parameters(rows(("gl", "5", "true"), ("draws:0", "1", "false"))) == ["latency"]
    assert swept_parameters(rows(("gl", "5", "true"), ("gl", "1", "true"))) == ["repetitions"]
    assert swept_parameters(rows(("gl", "1", "true"), ("gl", "1", "false"))) == ["timing"]
    assert swept_parameters(rows(("gl", "1", "true"))) == []


def test_interval_of_many_repetitions_is_narrower_than_their_range():
    values = np.linspace(1, 2, 41)
    low, high = bootstrap_interval(values)
    assert 1.3 < low < 1.5 < high < 1.7
    assert bootstrap_interval(values) == (low, high)
    assert bootstrap_interval([3, 1, 2]) == (1, 3) and bootstrap_interval([3]) == (None, None)


def test_program_that_is_none_and_profile_that_is_not_there(sweep):
    for arguments, said in ((("--hlodbench", "/bin/true"), "expected the options of hlodbench"),
                            (("--hlodbench", sweep.folder / "none"), "No such file"),
                            (("--profile", "/no/where"), "expected a folder with config.yaml"),
                            (("--cores", "0"), "expected 1 to 1024, found 0")):
        done = sweep.run(BASE, *arguments)
        assert done.returncode == 2 and said in done.stderr.splitlines()[-1]
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize("text, said", [
    ("a,b\n1,2\n", ":1: expected a column 'cell'"), (None, "No such file")])
def test_table_that_is_none(tmp_path, text, said):
    from sweeping.table import TableError
    if text:
        (tmp_path / "sweep.csv").write_text(text, encoding="utf-8")
    with pytest.raises(TableError) as error:
        read_table(tmp_path / "sweep.csv")
    assert said in str(error.value)


PYARROW = """
def table(columns):
    return columns
"""
PARQUET = """
import json
def write_table(table, path):
    with open(path, "w") as file:
        json.dump(table, file)
"""


def test_parquet_gets_the_columns_of_the_table(sweep, tmp_path):
    # pyarrow is not in Debian; a stand-in shows what it is given.
    (tmp_path / "modules" / "pyarrow").mkdir(parents=True)
    (tmp_path / "modules" / "pyarrow" / "__init__.py").write_text(PYARROW)
    (tmp_path / "modules" / "pyarrow" / "parquet.py").write_text(PARQUET)
    sweep.environment["PYTHONPATH"] = str(tmp_path / "modules")
    assert sweep.run(BASE + "s: 0.5\n").returncode == 0
    columns = json.loads((sweep.out / "sweep.parquet").read_text())
    rows = sweep.rows()
    assert list(columns) == list(rows[0])
    assert columns["dn"] == [float(row["dn"]) for row in rows]
    assert columns["strategy"] == ["bool", "coh-b"]
    assert columns["d"] == [None, pytest.approx(float(rows[1]["d"]))]
