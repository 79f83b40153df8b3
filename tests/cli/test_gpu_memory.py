"""`run --gpu-memory`: what is stored and logged, and what the limit must not change."""

import csv
import json
import pathlib
import re

import jsonschema
from small_scene import past_the_walls, write_session, write_walls

COLUMNS = {"missing_nodes", "loads", "evictions", "resident_mib"}
SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "results" / "result.schema.json"
K = 1024


def rows_of(path):
    return list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))


def test_a_budget(hlodbench, tmp_path):
    hlod = tmp_path / "walls.hlod"
    built = hlodbench("build", write_walls(tmp_path), "-o", hlod, "--max-triangles", "200")
    assert built.returncode == 0, built.stderr
    session = write_session(tmp_path / "path.json", past_the_walls(12))

    def run(name, *options):
        out = tmp_path / name
        fixed = ["--scene", hlod, "--session", session, "--out", out, "--warm-up", "0"]
        return out, hlodbench("run", *fixed, "--images", "3", *options)

    out, result = run("too_small", "--gpu-memory", "1K")
    assert result.returncode == 2 and not out.exists()
    least = re.search(r"--gpu-memory: expected at least (\d+)K .*, found 1K\n$", result.stderr)
    assert least, result.stderr
    limit = 2 * int(least[1])
    free, result = run("free", "--gpu-memory", "unlimited")
    assert result.returncode == 0, result.stderr
    tight, result = run("tight", "--gpu-memory", f"{limit}K")
    assert result.returncode == 0, result.stderr

    schema = jsonschema.Draft7Validator(json.loads(SCHEMA.read_text(encoding="utf-8")))
    stored = {}
    for out in (free, tight):
        stored[out] = json.loads((out / "run.json").read_text(encoding="utf-8"))
        schema.validate(stored[out])
    assert stored[free]["options"]["gpu_memory"] is None
    assert stored[tight]["options"]["gpu_memory"] == limit * K
    assert stored[free]["scene"]["hash"] == stored[tight]["scene"]["hash"]
    missing = loads = 0
    for case in stored[tight]["cases"]:
        assert COLUMNS <= set(case["summary"]["counters"])
        for row in rows_of(tight / case["csv"]):
            assert 0 < float(row["resident_mib"]) <= limit / K
            missing += int(row["missing_nodes"])
            loads += int(row["loads"])
    assert missing > 0 and loads > 0
    for case in stored[free]["cases"]:
        assert not COLUMNS & set(rows_of(free / case["csv"])[0])
    # the full-resolution model has far more than the limit, and its pictures every node of it
    pictures = sorted((free / "images").glob("full.*.png"))
    assert len(pictures) == 3
    for picture in pictures:
        assert picture.read_bytes() == (tight / "images" / picture.name).read_bytes()
