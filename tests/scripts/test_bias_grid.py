"""scripts/bias_grid.py, with a stand-in for the program that logs how it is called."""

import csv
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# A run leaves a folder that remembers s and t; a table has numbers made of them.
PROGRAM = """#!{python}
import pathlib, sys
arguments = sys.argv[1:]
value = dict(zip(arguments[1::2], arguments[2::2]))
with open({log!r}, "a") as log:
    log.write(" ".join(arguments) + "\\n")
if arguments[0] == "run":
    if value["--s"] == {fail!r}:
        sys.exit(3)
    out = pathlib.Path(value["--out"])
    out.mkdir()
    (out / "st").write_text(value["--s"] + " " + value["--t"])
else:
    s, t = map(float, (pathlib.Path(arguments[1]) / "st").read_text().split())
    print("strategy,ours_dn,ours_rarn,ours_delayed_share,ours_fps,ours_speedup,ours_speedup_low,"
          "ours_speedup_high,ours_psnr_y,ours_psnr_cb,ours_psnr_cr,ours_psnr_identical,"
          "ours_psnr_full_y")
    print("bool,200,0,,20,1.5,1.4,1.6,,,,,33")
    print(f"coh-b,{{100 + 10 * s + t}},0.1,0.02,30,,,,40,50,60,2,32")
"""


@pytest.fixture
def grid(tmp_path):
    log = tmp_path / "log"
    log.touch()

    def run(*arguments, fail="no"):
        program = tmp_path / "hlodbench"
        program.write_text(PROGRAM.format(python=sys.executable, log=str(log), fail=fail))
        program.chmod(0o755)
        options = ["--scene", "a.hlod", "--session", "b.json", "--out", tmp_path / "out",
                   "--hlodbench", program, *arguments]
        command = [sys.executable, ROOT / "scripts/bias_grid.py", *options]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)

    run.out, run.log = tmp_path / "out", log
    return run


def read_csv(grid):
    with open(grid.out / "grid.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_runs_every_pair_once_and_s_0_for_one_t(grid):
    result = grid("--s", "0,1", "--t", "0.1,0.5")
    assert result.returncode == 0, result.stderr
    runs = [line for line in grid.log.read_text().splitlines() if line.startswith("run")]
    assert [line.split("--s ")[1][:10] for line in runs] == [
        "0.0 --t 0.", "1.0 --t 0.", "1.0 --t 0."]
    assert all("--strategy bool,coh-b" in line and "--images 20" in line for line in runs)
    rows = read_csv(grid)
    assert [(row["s"], row["t"]) for row in rows] == [("0", ""), ("1", "0.1"), ("1", "0.5")]
    assert [float(row["dn"]) for row in rows] == [100.1, 110.1, 110.5]
    assert float(rows[1]["dn_share"]) == pytest.approx(110.1 / 200)
    assert "| 1 | 0.5 | 110.5 | 0.552 | 0.10 | 2.00 | 30.0 | 1.50 [1.40, 1.60] |" in result.stdout
    assert sorted(p.name for p in grid.out.iterdir()) == ["grid.csv", "s0", "s1-t0.1", "s1-t0.5"]


def test_goes_on_where_it_stopped(grid):
    assert grid("--s", "0,1", "--t", "0.5", fail="1.0").returncode == 2
    assert [row["s"] for row in read_csv(grid)] == ["0"]
    assert not (grid.out / "s1-t0.5").exists()
    before = grid.log.read_text().count("run ")
    result = grid("--s", "0,1", "--t", "0.5")
    assert result.returncode == 0 and grid.log.read_text().count("run ") == before + 1
    assert [row["s"] for row in read_csv(grid)] == ["0", "1"]


@pytest.mark.parametrize("arguments", [("--s", "2"), ("--t", "x"), ("--s", "")])
def test_refuses_numbers_out_of_range(grid, arguments):
    result = grid(*arguments)
    assert result.returncode == 2 and arguments[0] in result.stderr
    assert grid.log.read_text() == ""


def test_names_a_program_that_is_not_there(grid, tmp_path):
    result = grid("--hlodbench", tmp_path / "nowhere")
    assert result.returncode == 2
    assert result.stderr.splitlines()[-1] == (
        f"bias_grid.py: {tmp_path / 'nowhere'}: cannot be run: No such file or directory")
