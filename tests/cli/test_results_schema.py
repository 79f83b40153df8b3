"""results/*.json: the schema holds the program's example and refuses broken ones, and the paper's
table agrees with itself."""

import copy
import json
import pathlib

import jsonschema
import pytest

RESULTS = pathlib.Path(__file__).resolve().parents[2] / "results"


def load(name):
    return json.loads((RESULTS / name).read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def validator():
    schema = load("result.schema.json")
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


@pytest.fixture
def example():
    return load("example_result.json")


def test_example_is_valid(validator, example):
    validator.validate(example)


def test_example_shows_every_part_of_the_format(example):
    assert not example["complete"] and example["missing"]
    assert any(case["error"] for case in example["cases"])
    assert any(case["summary"] for case in example["cases"])
    assert example["speedups"] and example["context"]["warnings"]


def test_every_member_is_required(validator, example):
    """The program writes null rather than leaving a member out, but for counters."""
    for parent in (example, example["context"], example["context"]["gl"], example["scene"],
                   example["session"], example["missing"][0], example["speedups"][0],
                   example["cases"][0], example["cases"][0]["summary"],
                   example["cases"][0]["summary"]["counters"]["dn"]):
        for key in list(parent):
            value = parent.pop(key)
            assert not validator.is_valid(example), key
            parent[key] = value
    validator.validate(example)


def set_at(path, value):
    def damage(run):
        *parents, last = path
        for key in parents:
            run = run[key]
        run[last] = value
    return damage


@pytest.mark.parametrize("damage", [
    set_at(["schema_version"], "2.0.0"),
    set_at(["wheather"], "fine"),
    set_at(["context", "load_average"], [1.0]),
    set_at(["context", "time_utc"], "yesterday"),
    set_at(["scene", "nodes"], -1),
    set_at(["cases", 0, "csv"], "/tmp/bool-0.csv"),
    set_at(["cases", 0, "csv"], "../bool-0.csv"),
    set_at(["cases", 0, "summary"], None),
    set_at(["cases", 0, "summary", "fps"], 0),
    set_at(["cases", 0, "summary", "counters", "DN"], {}),
    set_at(["cases", 0, "summary", "counters", "dn", "mean"], None),
    set_at(["cases", 3, "error"], None),
    set_at(["speedups", 0, "ratios"], []),
])
def test_broken_results_are_refused(validator, example, damage):
    broken = copy.deepcopy(example)
    damage(broken)
    assert not validator.is_valid(broken)


@pytest.mark.parametrize("scene", load("paper_table1.json")["scenes"], ids=lambda s: s["id"])
def test_paper_agrees_with_itself(scene):
    rows = {row["strategy"]: row for row in scene["rows"]}
    assert list(rows) == ["bool", "sw-b", "simp-b", "coh-b"]
    coh = rows["coh-b"]
    for row in scene["rows"][:3]:
        assert coh["fps"] / row["fps"] == pytest.approx(row["speedup"], abs=0.015)
    assert coh["d"] / coh["dn"] == pytest.approx(scene["delayed_share"], abs=1e-4)


def test_paper_statements_of_section_5_2_hold():
    for scene in load("paper_table1.json")["scenes"]:
        dn = {row["strategy"]: row["dn"] for row in scene["rows"]}
        assert dn["coh-b"] / dn["sw-b"] < 1.011  # "within 1 %"
        assert dn["simp-b"] / dn["sw-b"] < 1.255  # "up to 25 % more"
        assert dn["sw-b"] < dn["coh-b"] < dn["simp-b"] < dn["bool"]
