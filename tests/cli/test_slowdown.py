"""The hook that slows stages down for tests: a run says so, and counts the same."""

import csv
import json
import os

from small_scene import past_the_walls, write_session

VARIABLE = "HLODBENCH_TEST_SLOWDOWN"
COUNTS = ("dn", "rarn", "d", "queries", "triangles", "nodes_visited")


def run(hlodbench, walls_hlod, out, slowdown):
    session = write_session(out.with_suffix(".json"), past_the_walls(6))
    return hlodbench("run", "--scene", walls_hlod, "--session", session, "--out", out,
                     "--strategy", "coh-b", "--warm-up", "0", "--latency", "draws:3", "--images",
                     "none", env={**os.environ, VARIABLE: slowdown})


def read(out):
    with open(out / "coh-b.0.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    warnings = json.loads((out / "run.json").read_text(encoding="utf-8"))["context"]["warnings"]
    return [[row[name] for name in COUNTS] for row in rows], warnings


def test_a_run_says_that_it_was_slowed_down_and_counts_the_same(hlodbench, walls_hlod, tmp_path):
    assert run(hlodbench, walls_hlod, tmp_path / "plain", "").returncode == 0
    counts, warnings = read(tmp_path / "plain")
    assert not any("slowed down" in warning for warning in warnings)

    slow = run(hlodbench, walls_hlod, tmp_path / "slow", "draw=50,query=20,traversal=10")
    assert slow.returncode == 0, slow.stderr
    slow_counts, warnings = read(tmp_path / "slow")
    assert slow_counts == counts
    line = f"slowed down for a test ({VARIABLE}): draw by 50 %, query by 20 %, traversal by 10 %"
    assert warnings.count(line) == 1
    assert f"warning: {line}" in slow.stderr.splitlines()


def test_a_stage_that_there_is_not_is_refused(hlodbench, walls_hlod, tmp_path):
    result = run(hlodbench, walls_hlod, tmp_path / "bad", "sleep=5")
    assert result.returncode == 2
    assert f"{VARIABLE}: expected stages (draw, query, traversal)" in result.stderr
    assert not (tmp_path / "bad").exists()
