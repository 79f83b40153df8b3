"""What a run leaves: complete, repeatable where it claims so, and usable after an interruption."""

import csv
import json
import os
import pathlib
import signal
import statistics
import subprocess
import time

import jsonschema
import pytest
from small_scene import past_the_walls, write_courtyard, write_session, write_walls

STRATEGIES = ("bool", "sw-b", "simp-b", "coh-b")
EXACT = ("dn", "rarn", "d", "delays", "queries", "triangles", "nodes_visited", "queries_wasted",
         "repeated_delays", "front_change")
TIMES = ("frame_ms", "cpu_ms", "wait_ms", "draw_ms", "query_ms", "traversal_ms", "gpu_ms")
FRAMES = 16
SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "results" / "result.schema.json"


class World:
    """A hierarchy and sessions, and the runs through them."""

    def __init__(self, hlodbench, folder):
        self.hlodbench = hlodbench
        self.folder = folder
        self.hlod = folder / "walls.hlod"
        self.short = write_session(folder / "short.json", past_the_walls(FRAMES))
        self.long = write_session(folder / "long.json", past_the_walls(150))
        scene = write_walls(folder)
        result = hlodbench("build", scene, "-o", self.hlod, "--max-triangles", "200")
        assert result.returncode == 0, result.stderr

    def arguments(self, out, *options, session=None):
        session = session or self.short
        return ["run", "--scene", self.hlod, "--session", session, "--out", out, *options]

    def run(self, out, *options, **keywords):
        result = self.hlodbench(*self.arguments(out, *options, **keywords))
        assert result.returncode == 0, result.stderr
        return read_run(out)


@pytest.fixture(scope="module")
def world(hlodbench, tmp_path_factory):
    return World(hlodbench, tmp_path_factory.mktemp("a world"))


@pytest.fixture(scope="module")
def repeated(world):
    """A folder and the run.json of three repetitions."""
    out = world.folder / "repeated"
    options = ["--repetitions", "3", "--warm-up", "3", "--latency", "draws:5"]
    return out, world.run(out, *options, "--frames-in-flight", "2", "--tau", "0.5")


def read_run(out):
    run = json.loads((out / "run.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator(json.loads(SCHEMA.read_text(encoding="utf-8"))).validate(run)
    return run


def read_csv(path):
    text = path.read_text(encoding="utf-8")
    assert text.endswith("\n")
    return list(csv.DictReader(text.splitlines()))


def exact_counters(out):
    """By strategy and frame, from the first repetition."""
    return {
        s: [[row[name] for name in EXACT] for row in read_csv(out / f"{s}.0.csv")]
        for s in STRATEGIES
    }


def test_run_json_says_how_it_was_made(world, repeated):
    _, run = repeated
    assert run["frames_in_flight"] == 2 and run["warm_up_frames"] == 3
    assert run["repetitions"] == 3 and run["complete"] and run["missing"] == []
    options = run["options"]
    assert options["tau"] == 0.5 and options["latency"] == "draws:5" and options["seed"] == 1
    assert options["viewport"] == [160, 120]
    assert "--latency" in run["context"]["arguments"]
    assert run["context"]["gl"]["renderer"]
    assert run["session"]["frames"] == FRAMES
    assert run["scene"]["triangles"] == 9600
    assert "max_triangles=200" in run["scene"]["build"]["options"]


def test_every_case_has_a_complete_csv(repeated):
    out, run = repeated
    assert len(run["cases"]) == 12
    logs = {c["csv"] for c in run["cases"]}
    assert {p.name for p in out.iterdir()} == {"run.json", "images", *logs}
    for case in run["cases"]:
        assert case["csv"] == f"{case['strategy']}.{case['repetition']}.csv"
        rows = read_csv(out / case["csv"])
        assert [int(row["frame"]) for row in rows] == list(range(FRAMES))
        assert list(rows[0])[:2] == ["frame", "warm_up"]
        assert set(rows[0]) == {"frame", "warm_up", *EXACT, *TIMES}
        for row in rows:
            assert all(float(row[name]) >= 0 for name in (*EXACT[:-1], *TIMES[:-1]))
            assert (row["front_change"] == "") == (row["frame"] == "0"), "the first has no last"
            assert int(row["queries_wasted"]) <= int(row["queries"])
            assert int(row["repeated_delays"]) <= int(row["delays"])
            assert float(row["frame_ms"]) >= float(row["wait_ms"])
            assert int(row["rarn"]) <= int(row["dn"]) <= int(row["nodes_visited"])
            assert int(row["d"]) <= min(int(row["dn"]), int(row["delays"]))


def test_warm_up_frames_are_flagged_and_enter_no_average(repeated):
    out, run = repeated
    for case in run["cases"]:
        rows = read_csv(out / case["csv"])
        assert [row["warm_up"] for row in rows] == ["1"] * 3 + ["0"] * (FRAMES - 3)
        summary = case["summary"]
        assert (summary["frames"], summary["warm_up_frames"]) == (FRAMES - 3, 3)
        for name, counter in summary["counters"].items():
            values = [float(row[name]) for row in rows[3:] if row[name]]
            assert counter["count"] == len(values)
            assert counter["mean"] == pytest.approx(statistics.fmean(values), rel=1e-9)
            assert counter["median"] == pytest.approx(statistics.median(values), rel=1e-9)
            assert counter["max"] == max(values)


def test_both_frame_rates(repeated):
    out, run = repeated
    for case in run["cases"]:
        times = [float(row["frame_ms"]) for row in read_csv(out / case["csv"])[3:]]
        summary = case["summary"]
        assert summary["fps"] == pytest.approx(1000 * len(times) / sum(times))
        assert summary["fps_frame_mean"] == pytest.approx(
            statistics.fmean(1000 / t for t in times)
        )


def test_speedups_have_an_interval_from_two_repetitions_on(world, repeated, tmp_path):
    _, run = repeated
    fps = {(c["strategy"], c["repetition"]): c["summary"]["fps"] for c in run["cases"]}
    assert {s["over"] for s in run["speedups"]} == {"bool", "sw-b", "simp-b"}
    for speedup in run["speedups"]:
        assert speedup["strategy"] == "coh-b"
        ratios = [fps["coh-b", r] / fps[speedup["over"], r] for r in range(3)]
        assert speedup["ratios"] == pytest.approx(ratios)
        assert speedup["median"] == pytest.approx(statistics.median(ratios))
        assert speedup["low"] == pytest.approx(min(ratios))
        assert speedup["high"] == pytest.approx(max(ratios))
    single = world.run(tmp_path / "single", "--strategy", "bool,coh-b")
    (speedup,) = single["speedups"]
    assert speedup["low"] is None and speedup["high"] is None


def order_of(run):
    cases = sorted(run["cases"], key=lambda c: c["order"])
    assert [c["order"] for c in cases] == list(range(len(cases)))
    return [(c["repetition"], c["strategy"]) for c in cases]


def test_repetitions_are_interleaved_in_an_order_by_the_seed(world, repeated, tmp_path):
    first = order_of(repeated[1])
    assert [repetition for repetition, _ in first] == [0] * 4 + [1] * 4 + [2] * 4
    for repetition in range(3):
        assert sorted(s for r, s in first if r == repetition) == sorted(STRATEGIES)
    session = write_session(tmp_path / "tiny.json", past_the_walls(2))
    options = ["--repetitions", "3", "--warm-up", "0"]
    orders = [
        order_of(world.run(tmp_path / str(i), *options, "--seed", seed, session=session))
        for i, seed in enumerate((1, 2, 2))
    ]
    assert orders[0] == first, "the same seed, the same order"
    assert orders[1] == orders[2] != orders[0]
    assert len({tuple(s for _, s in first[i : i + 4]) for i in (0, 4, 8)}) > 1


@pytest.mark.parametrize("latency", ["draws:5", "frames:1"])
def test_a_fixed_latency_gives_the_same_counts_in_every_run(world, tmp_path, latency):
    counts = []
    for i in range(3):
        out = tmp_path / str(i)
        world.run(out, "--latency", latency, "--seed", i)
        counts.append(exact_counters(out))
    assert counts[0] == counts[1] == counts[2]
    assert counts[0]["coh-b"] != counts[0]["bool"]


def test_the_latency_has_an_influence(world, tmp_path):
    """Else the test above would prove nothing."""
    for latency in ("draws:0", "draws:20"):
        world.run(tmp_path / latency, "--latency", latency)
    early, late = (exact_counters(tmp_path / name) for name in ("draws:0", "draws:20"))
    assert early["coh-b"] != late["coh-b"] and early["bool"] != late["bool"]
    assert early["sw-b"] == late["sw-b"], "stop-and-wait always waits"


def test_repetitions_count_the_same(repeated):
    out, _ = repeated
    for strategy in STRATEGIES:
        tables = [
            [[row[name] for name in EXACT] for row in read_csv(out / f"{strategy}.{r}.csv")]
            for r in range(3)
        ]
        assert tables[0] == tables[1] == tables[2]


def test_every_context_counts_the_same(world, tmp_path):
    if "osmesa" not in world.hlodbench("list").stdout:
        pytest.skip("hlodbench was built without OSMesa: contexts are not compared")
    out = tmp_path / "osmesa"
    options = ["--latency", "draws:5", "--context"]
    result = world.hlodbench(*world.arguments(out, *options, "osmesa"))
    if result.returncode == 3:
        pytest.skip(f"OSMesa is missing, contexts are not compared: {result.stderr.strip()}")
    assert result.returncode == 0, result.stderr
    egl = world.run(tmp_path / "egl", *options, "egl")
    if "llvmpipe" not in egl["context"]["gl"]["renderer"]:
        pytest.skip("EGL is not Mesa's software renderer here: contexts are not compared")
    assert exact_counters(out) == exact_counters(tmp_path / "egl")


def test_a_trace_does_not_change_the_counts(world, repeated, tmp_path):
    options = ["--latency", "draws:5", "--tau", "0.5", "--trace", tmp_path / "t.jsonl"]
    run = world.run(tmp_path / "out", *options)
    assert run["options"]["traced"]
    assert exact_counters(tmp_path / "out") == exact_counters(repeated[0])
    traces = sorted(path.name for path in tmp_path.glob("t*"))
    assert traces == sorted(f"t.{s}.jsonl" for s in STRATEGIES)


def test_the_trace_of_a_single_strategy_has_the_name_given(world, tmp_path):
    options = ["--strategy", "coh-b", "--trace", tmp_path / "t.jsonl"]
    world.run(tmp_path / "out", *options)
    assert [path.name for path in tmp_path.glob("t*")] == ["t.jsonl"]
    header = json.loads((tmp_path / "t.jsonl").read_text(encoding="utf-8").splitlines()[0])
    assert header["type"] == "run" and header["strategy"] == "coh-b"


def test_a_second_run_into_a_folder_is_refused(world, repeated):
    out, _ = repeated
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    result = world.hlodbench(*world.arguments(out))
    assert result.returncode == 2
    assert result.stderr.startswith(f"hlodbench: --out {out}: expected a new or empty folder")
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == before


# Interruptions

def start(arguments):
    """The program in the background, with nobody reading its progress."""
    command = [os.environ["HLODBENCH_EXE"], *map(str, arguments)]
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
    return subprocess.Popen(command, text=True, **pipes)


def wait_for(process, path, seconds=60):
    end = time.monotonic() + seconds
    while not path.exists():
        assert process.poll() is None and time.monotonic() < end, f"{path} did not come"
        time.sleep(0.005)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM], ids=lambda n: n.name)
def test_an_interrupted_run_keeps_what_is_complete(world, tmp_path, number):
    out = tmp_path / "out"
    process = start(world.arguments(out, "--repetitions", "100", session=world.long))
    wait_for(process, out / "run.json")
    process.send_signal(number)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 1
    assert errors.splitlines()[-1].startswith("hlodbench: interrupted; ")
    run = read_run(out)
    assert run["complete"] is False
    assert len(run["cases"]) >= 1 and len(run["cases"]) + len(run["missing"]) == 400
    done = {(c["strategy"], c["repetition"]) for c in run["cases"]}
    assert done.isdisjoint((m["strategy"], m["repetition"]) for m in run["missing"])
    logs = {c["csv"] for c in run["cases"]}
    assert {p.name for p in out.iterdir()} == {"run.json", *logs}
    for case in run["cases"]:
        assert len(read_csv(out / case["csv"])) == 150
    table = world.hlodbench("table", out)
    assert table.returncode == 0 and "incomplete" in table.stdout.lower()


@pytest.mark.parametrize("delay", [0.0, 0.05, 0.21])
def test_a_killed_run_leaves_no_half_written_file(world, tmp_path, delay):
    out = tmp_path / "out"
    session = write_session(tmp_path / "session.json", past_the_walls(8))
    options = ["--repetitions", "1000", "--trace", tmp_path / "t.jsonl", "--warm-up", "0"]
    process = start(world.arguments(out, *options, session=session))
    wait_for(process, out / "run.json")
    time.sleep(delay)
    process.kill()
    process.communicate(timeout=60)
    run = read_run(out)
    assert not run["complete"] and run["cases"]
    for path in out.iterdir():
        if path.suffix == ".csv":
            assert len(read_csv(path)) == 8
        else:
            assert path.name == "run.json" or path.name.endswith(".tmp")
    for path in tmp_path.glob("t*.jsonl"):
        assert json.loads(path.read_text(encoding="utf-8").splitlines()[-1])["type"] == "end"


@pytest.mark.parametrize("delay", [0.1, 0.5, 1.1])
def test_a_killed_build_leaves_no_half_written_file(hlodbench, tmp_path, delay):
    scene = write_courtyard(tmp_path / "yard.scene.json", triangles=100000)
    file = tmp_path / "made" / "yard.hlod"
    process = start(["build", scene, "-o", file, "--max-triangles", "500"])
    time.sleep(delay)
    process.kill()
    process.communicate(timeout=60)
    if file.exists():
        assert hlodbench("info", "--check", file).returncode == 0
