"""scripts/ablations.py on a tiny scene with the real program."""

import csv
import json
import os
import pathlib
import subprocess
import sys

import pytest
from small_scene import past_the_walls, write_session, write_walls

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A program that fails where it is asked for one reading, and logs what it runs.
PROGRAM = """#!/bin/bash
echo "$*" >>"{log}"
case " $* " in *" {fail} "*) echo "hlodbench: context lost" >&2; exit 1 ;; esac
exec "{exe}" "$@"
"""


class Bench:
    """A scene, a session, and the script run on them."""

    def __init__(self, hlodbench, folder):
        self.folder, self.log = folder, folder / "log"
        self.hlod = folder / "walls.hlod"
        self.session = write_session(folder / "path.json", past_the_walls(14))
        scene = write_walls(folder)
        build = hlodbench("build", scene, "-o", self.hlod, "--max-triangles", "200")
        assert build.returncode == 0, build.stderr

    def run(self, out, readings, *options, fail="--none"):
        program = self.folder / "program"
        exe = os.environ["HLODBENCH_EXE"]
        program.write_text(PROGRAM.format(log=self.log, fail=fail, exe=exe))
        program.chmod(0o755)
        self.log.write_text("")
        arguments = ["--scene", self.hlod, "--session", self.session, "--out", out,
                     "--hlodbench", program, "--size", "120x90", "--images", "3",
                     "--readings", readings, *options]  # fmt: skip
        command = [sys.executable, ROOT / "scripts/ablations.py", *arguments]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)

    def runs(self):
        return [line for line in self.log.read_text().splitlines() if line.startswith("run ")]


@pytest.fixture(scope="module")
def bench(hlodbench, tmp_path_factory):
    return Bench(hlodbench, tmp_path_factory.mktemp("a bench"))


@pytest.fixture(scope="module")
def done(bench):
    """A folder with some readings measured, and what the script said."""
    out = bench.folder / "done"
    return out, bench.run(out, "render-guard,simp-mean,mu-area")


def read_rows(out):
    with open(out / "ablations.csv", encoding="utf-8") as file:
        return {(row["reading"], row["strategy"]): row for row in csv.DictReader(file)}


def test_every_reading_is_run_with_its_strategies(bench, done):
    out, result = done
    assert result.returncode == 0, result.stderr
    assert list(read_rows(out)) == [
        ("default", "bool"), ("default", "sw-b"), ("default", "simp-b"), ("default", "coh-b"),
        ("simp-mean", "simp-b"),
        ("render-guard", "bool"), ("render-guard", "simp-b"), ("render-guard", "coh-b"),
        ("mu-area", "sw-b"), ("mu-area", "simp-b"), ("mu-area", "coh-b"),
    ]  # fmt: skip
    options = json.loads((out / "render-guard" / "run.json").read_text())["options"]
    assert options["render_guard"] == "off" and options["pull_up"] == "refine"
    assert options["latency"] == "draws:12" and options["viewport"] == [120, 90]
    assert "bool" in options["strategies"]


def test_values_and_changes_are_those_of_the_runs(done):
    out, _ = done
    rows = read_rows(out)
    for (reading, strategy), row in rows.items():
        run = json.loads((out / reading / "run.json").read_text())
        case = next(c for c in run["cases"] if c["strategy"] == strategy)
        for name in ("dn", "rarn", "d"):
            mean = case["summary"]["counters"][name]["mean"]
            assert float(row[name]) == pytest.approx(mean)
            change = mean - float(rows["default", strategy][name])
            if reading != "default":
                assert float(row[name + "_change"]) == pytest.approx(change)
        assert float(row["fps"]) == pytest.approx(case["summary"]["fps"])
        assert row["repetitions"] == "1" and row["frames"] == "9"
        assert row["psnr_full_y"]
        if strategy == "bool":
            assert row["psnr_y"] == row["psnr_identical"] == ""
        else:
            assert bool(row["psnr_y"]) == (row["psnr_identical"] != "3")
        assert row["dn_change"] == "" if reading == "default" else row["dn_verdict"]


def test_a_guard_that_is_off_draws_more_and_shows_the_same(done):
    rows = read_rows(done[0])
    row = rows["render-guard", "bool"]
    assert row["dn_verdict"] == "WORSE" and float(row["dn_change"]) > 0
    assert int(row["dn_different_frames"]) > 0
    assert row["psnr_full_y_verdict"] == "SAME"


def test_the_table_is_printed_and_kept(done):
    out, result = done
    text = (out / "ablations.md").read_text(encoding="utf-8")
    assert result.stdout == text
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    assert len(lines) == 1 + len(read_rows(out))
    assert len({line.count("|") for line in text.splitlines() if line.startswith("|")}) == 1
    assert "FPS over 1 repetition." in text and "`--render-guard off`" in text
    assert {p.name for p in out.iterdir()} == {
        "ablations.csv", "ablations.md", "settings.json",
        "default", "render-guard", "simp-mean", "mu-area",
    }  # fmt: skip


def test_what_is_finished_is_not_run_again(bench, done):
    out, first = done
    result = bench.run(out, "render-guard,simp-mean,mu-area")
    assert (result.returncode, result.stdout) == (0, first.stdout)
    assert bench.runs() == [] and result.stderr == ""


def test_a_failed_reading_is_reported_and_run_again_later(bench):
    out = bench.folder / "failing"
    result = bench.run(out, "pull-up,zero-pixels", fail="--pull-up delay")
    assert result.returncode == 1
    assert result.stderr.splitlines()[-1] == (
        "ablations.py: failed: pull-up: hlodbench ended with code 1"
    )
    rows = read_rows(out)
    assert rows["pull-up", ""]["error"] == "failed" and rows["zero-pixels", "coh-b"]["dn_change"]
    assert "| pull-up (`--pull-up delay`) | failed |" in result.stdout
    assert not [p for p in out.iterdir() if p.name.startswith(("pull-up", ".pull-up"))]
    again = bench.run(out, "pull-up,zero-pixels")
    assert again.returncode == 0, again.stderr
    assert len(bench.runs()) == 1 and "--pull-up delay" in bench.runs()[0]
    assert read_rows(out)["pull-up", "coh-b"]["dn_change"]


def test_nothing_is_compared_with_a_default_that_failed(bench):
    out = bench.folder / "no default"
    result = bench.run(out, "pull-up", fail="run")
    assert result.returncode == 2 and len(bench.runs()) == 1
    assert result.stderr.splitlines()[-1] == "ablations.py: default: hlodbench ended with code 1"


def test_cells_of_other_settings_are_not_mixed(bench, done):
    out, _ = done
    result = bench.run(out, "mu-area", "--latency", "draws:3")
    assert result.returncode == 2 and bench.runs() == []
    (line,) = result.stderr.splitlines()
    assert "settings.json: latency: the runs here have 'draws:12', asked for is 'draws:3'" in line


def test_an_unknown_reading_is_refused(bench, tmp_path):
    result = bench.run(tmp_path / "out", "mu-area,mu")
    assert result.returncode == 2 and "found 'mu'" in result.stderr
    assert not (tmp_path / "out").exists()
