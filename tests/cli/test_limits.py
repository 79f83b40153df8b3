"""Limits to compare with, and what explains a strategy's costs, through the program."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import pytest
from small_scene import build_yard
from trace_checker import Disagreement, Unsupported, check_trace

LIMITS = ("oracle", "ideal", "none", "full")
ALL = ("bool", "sw-b", "simp-b", "coh-b", *LIMITS, "reuse-b")
PREDICTIONS = ("predicted_right", "too_conservative", "too_aggressive", "needless_delays")
SEEN = ("invisible_nodes", "visible_triangles", "invisible_triangles")
FRAMES = 16
EXPLAINED = (3, 7, 12)
CHECKER = Path(__file__).with_name("trace_checker.py")


class Yard:
    """A courtyard, and one run through it with everything."""

    def __init__(self, hlodbench, folder):
        self.hlodbench = hlodbench
        self.folder = folder
        self.hlod, self.session = build_yard(hlodbench, folder, FRAMES)
        self.info = folder / "info.json"
        self.info.write_text(hlodbench("info", "--json", self.hlod).stdout, encoding="utf-8")
        self.out = folder / "all"
        self.run(self.out, "--strategy", "all", "--repetitions", "2", "--latency", "draws:5",
                 "--explain", ",".join(map(str, EXPLAINED)), "--images", "7,",
                 "--trace", folder / "t.jsonl")

    def run(self, out, *options):
        command = ["run", "--scene", self.hlod, "--session", self.session, "--out", out]
        result = self.hlodbench(*command, *options)
        assert result.returncode == 0, result.stderr
        return result

    def log(self, strategy, repetition=0):
        path = self.out / f"{strategy}.{repetition}.csv"
        with path.open(encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def trace(self, strategy):
        return (self.folder / f"t.{strategy}.jsonl").read_text(encoding="utf-8").splitlines()


@pytest.fixture(scope="module")
def yard(hlodbench, tmp_path_factory):
    return Yard(hlodbench, tmp_path_factory.mktemp("a yard"))


def test_all_names_every_strategy(yard):
    run = json.loads((yard.out / "run.json").read_text(encoding="utf-8"))
    assert run["options"]["strategies"] == list(ALL)
    assert run["options"]["explain"] == "list"
    assert {c["strategy"] for c in run["cases"]} == set(ALL) and run["complete"]


def test_the_oracle_and_the_ideal_draw_what_stop_and_wait_draws(yard):
    for name in ("dn", "triangles", "front_change"):
        wanted = [row[name] for row in yard.log("sw-b")]
        for strategy in ("oracle", "ideal"):
            for repetition in range(2):
                log = yard.log(strategy, repetition)
                assert [row[name] for row in log] == wanted, (name, strategy)
    drawn = {s: [e["node"] for e in map(json.loads, yard.trace(s)) if e["type"] == "draw"]
             for s in ("sw-b", "oracle", "ideal")}
    assert drawn["oracle"] == drawn["ideal"] == drawn["sw-b"]
    assert all(row["rarn"] == "0" and row["d"] == "0" for row in yard.log("ideal"))


def test_what_asks_no_query_has_no_counter_of_them(yard):
    for strategy in ("oracle", "none", "full"):
        for row in yard.log(strategy):
            for name in ("queries", "rarn", "d", "delays", "queries_wasted", "repeated_delays"):
                assert row[name] == ""
    order = [sum(int(row["triangles"]) for row in yard.log(s)) for s in ("bool", "none", "full")]
    assert order == sorted(order)


def test_explained_frames_have_the_counters_and_others_not(yard):
    for strategy in ALL:
        log = yard.log(strategy)
        for row in log:
            explained = int(row["frame"]) in EXPLAINED
            for name in SEEN:
                assert (row[name] != "") == explained, (strategy, name)
            for name in PREDICTIONS:
                predicts = strategy not in ("oracle", "none", "full", "reuse-b")
                assert (row.get(name, "") != "") == (explained and predicts), (strategy, name)
        assert not {*PREDICTIONS, *SEEN} & set(yard.log(strategy, 1)[0])


def test_explanations_add_up(yard):
    for strategy in ALL:
        frames = split_frames(yard.trace(strategy))
        for row in (yard.log(strategy)[i] for i in EXPLAINED):
            events = frames[int(row["frame"])]
            assert 0 <= int(row["invisible_nodes"]) < int(row["dn"])
            parts = int(row["visible_triangles"]), int(row["invisible_triangles"])
            assert sum(parts) == int(row["triangles"]) and min(parts) > 0
            assert parts[0] >= int(row["dn"]) - int(row["invisible_nodes"])
            if row.get("predicted_right"):
                visits = [e for e in events if e["type"] == "visit" and e["in_frustum"]]
                assert sum(int(row[name]) for name in PREDICTIONS) == len(visits)
    assert all(row["predicted_right"] and sum(int(row[n]) for n in PREDICTIONS[1:]) == 0
               for row in (yard.log("ideal")[i] for i in EXPLAINED))


def split_frames(lines):
    frames = []
    for event in map(json.loads, lines[1:]):
        if event["type"] == "frame":
            frames.append([])
        frames[-1].append(event)
    return frames


def test_explanations_are_in_the_summary_and_the_table(yard):
    run = json.loads((yard.out / "run.json").read_text(encoding="utf-8"))
    for case in run["cases"]:
        counters = case["summary"]["counters"]
        if case["repetition"] == 1:
            assert "invisible_nodes" not in counters
            continue
        assert counters["invisible_nodes"]["count"] == len([f for f in EXPLAINED if f >= 5])
    table = yard.hlodbench("table", yard.out)
    assert table.returncode == 0
    assert "Why, in 2 frames of the first repetition." in table.stdout
    header = next(line for line in table.stdout.splitlines() if line.startswith("| Scenario"))
    assert "of Oracle's FPS" in header


def test_the_model_at_full_resolution_has_its_own_picture(yard):
    """A strategy of the same name leaves it alone."""
    images = json.loads((yard.out / "images" / "images.json").read_text(encoding="utf-8"))
    assert [s["strategy"] for s in images["strategies"]] == [s for s in ALL if s != "full"]
    assert [entry["file"] for entry in images["full"]] == ["full.00007.png"]


def test_a_run_without_explanations_has_none(yard, tmp_path):
    yard.run(tmp_path / "out", "--strategy", "none,sw-b", "--images", "none")
    text = (tmp_path / "out" / "sw-b.0.csv").read_text(encoding="utf-8")
    assert "front_change" in text and "invisible" not in text and "predicted" not in text
    table = yard.hlodbench("table", tmp_path / "out").stdout
    assert "Why" not in table and "Oracle" not in table


@pytest.mark.parametrize("value, message", [
    ("some", "expected all, none, a number of frames or a list like 0,120, found 'some'"),
    ("16,", "expected frames 0 to 15, found 16"),
])
def test_explain_refuses_what_it_cannot_read(yard, tmp_path, value, message):
    command = ["run", "--scene", yard.hlod, "--session", yard.session, "--out", tmp_path / "out"]
    result = yard.hlodbench(*command, "--explain", value)
    assert result.returncode == 2 and not (tmp_path / "out").exists()
    assert result.stderr.splitlines()[-1] == f"hlodbench: --explain: {message}"


@pytest.mark.parametrize("strategy", ["ideal", "none", "full"])
def test_every_decision_of_a_limit_is_the_algorithms(yard, strategy):
    lines = yard.trace(strategy)
    info = json.loads(yard.info.read_text(encoding="utf-8"))
    assert check_trace(info, lines) == len(lines) - 1 - 2 * FRAMES
    kinds = {json.loads(line)["type"] for line in lines}
    assert ("query" in kinds) == (strategy == "ideal") and "draw" in kinds


def test_the_checker_notices_a_wrong_prediction_of_the_ideal(yard):
    info = json.loads(yard.info.read_text(encoding="utf-8"))
    lines = yard.trace("coh-b")
    header = json.loads(lines[0])
    assert check_trace(info, lines)
    with pytest.raises(Disagreement, match="was wrong"):
        check_trace(info, [json.dumps({**header, "strategy": "ideal"}), *lines[1:]])


def test_the_checker_refuses_what_decides_nothing(yard):
    info = json.loads(yard.info.read_text(encoding="utf-8"))
    with pytest.raises(Unsupported, match="can check one of bool, .*, found 'oracle'"):
        check_trace(info, yard.trace("oracle"))
    command = [sys.executable, CHECKER, yard.info, yard.folder / "t.oracle.jsonl"]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 2 and "found 'oracle'" in result.stderr and result.stdout == ""
