"""Exports and the summary of scripts/nightly.sh, against the shapes that their readers publish."""

import json
import os
import pathlib
import re
import subprocess
import sys

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
jsonschema = pytest.importorskip("jsonschema", reason="needs python3-jsonschema")

from made_up_nights import CELL, SLOWER, make_night, make_times  # noqa: E402
from tracking.exporters import (EXPORTERS, export_bencher,  # noqa: E402
                                export_github_action_benchmark, export_google_benchmark)
from tracking.history import Entry, History  # noqa: E402
from tracking.summary import make_summary  # noqa: E402

# https://bencher.dev/docs/reference/bencher-metric-format/, "BMF JSON Schema", and its limits of
# names (1024 characters of a benchmark, 64 of a measure)
BENCHER = {
    "$schema": "http://json-schema.org/draft-07/schema", "type": "object",
    "propertyNames": {"maxLength": 1024},
    "patternProperties": {".+": {
        "type": "object", "propertyNames": {"maxLength": 64},
        "patternProperties": {".+": {
            "type": "object", "required": ["value"],
            "properties": {name: {"type": "number"}
                           for name in ("value", "lower_value", "upper_value")}}}}},
}
# README of benchmark-action/github-action-benchmark: name, unit and value; range and extra are
# texts and need not be there
GITHUB = {
    "$schema": "http://json-schema.org/draft-07/schema", "type": "array", "items": {
        "type": "object", "additionalProperties": False, "required": ["name", "unit", "value"],
        "properties": {"name": {"type": "string"}, "unit": {"type": "string"},
                       "value": {"type": "number"}, "range": {"type": "string"},
                       "extra": {"type": "string"}}},
}
# What tools/gbench of google/benchmark reads of a file, and docs/user_guide.md has in its example
GOOGLE = {
    "$schema": "http://json-schema.org/draft-07/schema", "type": "object",
    "required": ["context", "benchmarks"],
    "properties": {
        "context": {"type": "object", "required": ["date", "num_cpus", "mhz_per_cpu"],
                    "properties": {"num_cpus": {"type": "integer"}}},
        "benchmarks": {"type": "array", "items": {
            "type": "object",
            "required": ["name", "run_name", "run_type", "iterations", "real_time", "cpu_time",
                         "time_unit"],
            "properties": {"run_type": {"enum": ["iteration", "aggregate"]},
                           "time_unit": {"enum": ["ns", "us", "ms", "s"]},
                           "real_time": {"type": "number"}, "cpu_time": {"type": "number"},
                           "iterations": {"type": "integer"}}}}},
}
COMPARE = os.environ.get("BENCHMARK_COMPARE", "/usr/share/benchmark/compare.py")


def timed_night(factor=1.0):
    times = [10.0 * factor, 10.1 * factor, 10.3 * factor]
    return {**make_night(1, timing=SLOWER), "timing": make_times(new=times)}


@pytest.mark.parametrize("name, schema", [
    ("bencher", BENCHER), ("github-action-benchmark", GITHUB), ("google-benchmark", GOOGLE)])
@pytest.mark.parametrize("night", [timed_night(), make_night(1)], ids=["timed", "exact"])
def test_exports_have_the_published_shape(name, schema, night):
    jsonschema.Draft7Validator.check_schema(schema)
    made = json.loads(json.dumps(EXPORTERS[name](night), allow_nan=False))
    jsonschema.Draft7Validator(schema).validate(made)
    assert made or name == "google-benchmark"


def test_exports_say_what_the_night_says():
    night = timed_night()
    bencher = export_bencher(night)[CELL]
    assert bencher["frame-time"] == {"value": 10.1, "lower_value": 10.0, "upper_value": 10.3}
    assert bencher["dn"] == {"value": 100.0}
    github = {row["name"]: row for row in export_github_action_benchmark(night)}
    assert github[f"{CELL} frame time"]["value"] == 10.1
    # src/extractRangeInfo.ts of the action
    found = re.search(r"(?P<prefix>(\+-|±)\s*)(?P<value>\d.+)", github[f"{CELL} frame time"]["range"])
    assert float(found["value"]) == pytest.approx(0.15)
    assert github[f"{CELL} dn"]["unit"] == "nodes"
    rows = export_google_benchmark(night)["benchmarks"]
    assert [row["real_time"] for row in rows] == [10.0, 10.1, 10.3]
    assert {row["repetitions"] for row in rows} == {3}


def test_compare_py_of_google_benchmark_reads_the_export(tmp_path):
    if not pathlib.Path(COMPARE).exists():
        pytest.skip("compare.py is not installed (Debian: libbenchmark-tools), and BENCHMARK_COMPARE "
                    "names none")
    pytest.importorskip("scipy", reason="compare.py needs python3-scipy")
    for name, factor in (("a", 1.0), ("b", 1.1)):
        (tmp_path / name).write_text(json.dumps(export_google_benchmark(timed_night(factor))),
                                     encoding="utf-8")
    done = subprocess.run([sys.executable, COMPARE, "-d", tmp_path / "result", "benchmarks",
                           tmp_path / "a", tmp_path / "b"], capture_output=True, text=True,
                          check=False, stdin=subprocess.DEVNULL)
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "result").read_text(encoding="utf-8"))
    (row,) = [row for row in found if row["name"] == CELL]  # beside a mean over all
    assert len(row["measurements"]) == 3
    assert row["measurements"][0]["time"] == pytest.approx(0.1)
    assert row["utest"]["nr_of_repetitions"] == 3


# The summary


def test_summary_is_a_table_with_the_verdicts_and_what_differs():
    night = timed_night()
    night["verdicts"][CELL]["exact"] = {
        "verdict": "DIFFERENT", "reference": "a", "differences": [
            {"key": "dn", "old": 100.0, "new": 101.0}, {"key": "d", "old": 1, "new": None},
            {"key": "dn.frames", "old": "00", "new": "11"}]}
    earlier = make_night(1, timing={"verdict": "UNCLEAR", "reason": "x"})
    history = History([Entry("a", earlier)], [], ["a | damaged\nfile"])
    text = make_summary(night, history)
    assert text.startswith(f"# Night of {night['time_utc']}: regression (1 DIFFERENT, 1 SLOW)\n")
    assert f"| {CELL} | DIFFERENT | SLOW | +10.0 % [+8.0, +12.0] | p = 0.001; most of it in " in text
    for line in ("- dn 100 -> 101 (+1 %)", "- d 1 is gone", "- dn.frames 00 -> 11",
                 "Problem: a \\| damaged file"):
        assert f"\n{line}\n" in text
    rows = [line for line in text.splitlines() if line.startswith("|")]
    assert {len(re.findall(r"(?<!\\)\|", row)) for row in rows} == {6}


def test_a_long_list_of_differences_is_cut_short():
    night = make_night(1, exact="DIFFERENT")
    night["verdicts"][CELL]["exact"]["differences"] = [
        {"key": f"picture.{i}", "old": "0", "new": "1"} for i in range(30)]
    assert "- and 18 more\n" in make_summary(night, History())
