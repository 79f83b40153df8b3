"""scripts/growth.py: its table, its figure, what it refuses."""

import csv
import os
import pathlib
import subprocess
import sys

import pytest
from small_scene import write_relief

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "growth.py"


def grow(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True,
                          text=True)


@pytest.mark.parametrize("kind", ["extent", "detail"])
def test_growth_of_a_small_model(hlodbench, tmp_path, kind):
    mesh = write_relief(tmp_path / "relief.ply", 40)
    out = tmp_path / "out"
    result = grow(*(["--mesh", mesh] if kind == "extent" else []), "--out", out, "--program",
                  os.environ["HLODBENCH_EXE"], "--millions", "0.0032", "0.032", "--repetitions",
                  "1", "--gpu-memory", "64M")
    assert result.returncode == 0, result.stderr
    with open(out / "growth.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    sizes = [3200, 32000] if kind == "extent" else [12 * 16**2, 12 * 52**2]
    assert [int(row["triangles"]) for row in rows] == sizes
    for row in rows:
        known = {name: value for name, value in row.items() if not name.endswith("_missing")}
        assert all(float(value) >= 0 for value in known.values()), row
        assert all(value == "" or float(value) >= 0 for value in row.values()), row
        assert float(row["coh_dn"]) >= 1 and float(row["build_mib"]) > 1
    assert float(rows[1]["file_mib"]) > 5 * float(rows[0]["file_mib"])
    table = (out / "growth.md").read_text(encoding="utf-8").splitlines()
    assert len(table) == 4 and all(line.count("|") == 13 for line in table)
    assert (out / "growth.png").stat().st_size > 10_000 and (out / "growth.svg").exists()
    assert not [path for path in out.iterdir() if path.name.startswith(".")]


def test_refusals(tmp_path):
    mesh = write_relief(tmp_path / "relief.ply", 4)
    for arguments, said in (
            (("--mesh", tmp_path / "no.ply", "--out", tmp_path / "x"), "expected a mesh file"),
            (("--mesh", mesh, "--out", tmp_path), "expected a new folder"),
            (("--mesh", mesh, "--out", tmp_path / "x", "--millions", "-1"), "found -1"),
            (("--mesh", mesh, "--out", tmp_path / "x", "--tau", "0"), "found 0")):
        result = grow(*arguments)
        assert result.returncode == 2 and said in result.stderr
        assert not (tmp_path / "x").exists()
