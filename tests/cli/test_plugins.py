"""Strategies from shared libraries: what they get, and that a bad one costs only its own row."""

import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import time

import jsonschema
import pytest
from plugins import CHANGED, FAULTY, WHOLE, compile_plugin
from refusal import BAD_INPUT, complain
from small_scene import past_the_walls, write_session, write_walls

FRAMES = 8
COUNTS = ("dn", "rarn", "d", "delays", "queries", "triangles", "nodes_visited")
SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "results" / "result.schema.json"
NODES = 161  # of the scene


class World:
    """A scene, a session and the plug-ins."""

    def __init__(self, hlodbench, folder):
        self.hlodbench, self.folder = hlodbench, folder
        self.hlod = folder / "walls.hlod"
        self.session = write_session(folder / "path.json", past_the_walls(FRAMES), (96, 72))
        scene = write_walls(folder)
        built = hlodbench("build", scene, "-o", self.hlod, "--max-triangles", "200")
        assert built.returncode == 0, built.stderr
        self.faulty = compile_plugin(folder, "faulty", FAULTY)
        self.whole = compile_plugin(folder, "whole", WHOLE)

    def arguments(self, out, strategies, *options, timeout="1"):
        return ["run", "--scene", self.hlod, "--session", self.session, "--out", out,
                "--strategy", strategies, "--warm-up", "0", "--latency", "draws:4",
                *(() if "--images" in options else ("--images", "2,5")),
                "--plugin", self.faulty, "--plugin", self.whole,
                "--frame-timeout", timeout, *options]

    def run(self, name, strategies, *options):
        """The ended process, and run.json by (strategy, repetition)."""
        out = self.folder / name
        result = self.hlodbench(*self.arguments(out, strategies, *options))
        run = read_run(out)
        return result, out, {(c["strategy"], c["repetition"]): c for c in run["cases"]}


def read_run(out):
    run = json.loads((out / "run.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator(json.loads(SCHEMA.read_text(encoding="utf-8"))).validate(run)
    return run


def read_counts(path):
    rows = csv.DictReader(path.read_text(encoding="utf-8").splitlines())
    return [[row[name] for name in COUNTS] for row in rows]


def everything(folder):
    return sorted(p.relative_to(folder).as_posix() for p in folder.rglob("*"))


@pytest.fixture(scope="module")
def world(hlodbench, tmp_path_factory):
    return World(hlodbench, tmp_path_factory.mktemp("a world"))


@pytest.fixture(scope="module")
def good(world):
    """A run of plug-ins without a fault."""
    result, out, cases = world.run("good", "bool,sw-b,faulty,whole", "--set", "faulty.decay=0.25")
    assert result.returncode == 0, result.stderr
    assert all(case["error"] is None for case in cases.values())
    return out


# What a plug-in gets


def test_predictor_like_bool_does_what_bool_does(good):
    assert read_counts(good / "faulty.0.csv") == read_counts(good / "bool.0.csv")


def test_whole_strategy_like_stop_and_wait_does_what_it_does(good):
    assert read_counts(good / "whole.0.csv") == read_counts(good / "sw-b.0.csv")


def test_run_json_has_options_and_plugins(world, good):
    options = read_run(good)["options"]
    assert options["strategy_options"] == {
        "faulty": {"fault": "none", "frame": 3, "decay": 0.25},
        "whole": {"fault": "none"},
    }
    assert [p["file"] for p in options["plugins"]] == [str(world.faulty), str(world.whole)]
    assert len({p["hash"] for p in options["plugins"]}) == 2


def test_list_and_help_show_the_options(world):
    listed = world.hlodbench("list", "--plugin", world.faulty, "--plugin", world.whole)
    assert listed.returncode == 0, listed.stderr
    assert re.search(r"^  faulty +Faulty: of a test$", listed.stdout, re.MULTILINE)
    assert re.search(r"^  whole +Whole: of a test$", listed.stdout, re.MULTILINE)
    line = "faulty.decay=: nothing; a number from 0 to 1, default 0.5"
    assert line in listed.stdout
    assert line in world.hlodbench("run", "--plugin", world.faulty, "--help").stdout
    assert "faulty" not in world.hlodbench("list").stdout


def test_trace_of_a_whole_strategy_has_what_it_did(world):
    trace = world.folder / "trace.jsonl"
    result, out, _ = world.run("traced", "whole", "--trace", trace, "--set", "whole.fault=refine")
    assert result.returncode == 0, result.stderr
    events = [json.loads(line) for line in trace.read_text().splitlines()]
    ends = [e for e in events if e["type"] == "end"]
    drawn, refined = [], []
    for event in events:
        if event["type"] == "frame":
            drawn.append(set())
            refined.append(set())
        if event["type"] == "draw":
            drawn[-1].add(event["node"])
        if event["type"] == "rarn":
            assert event["node"] in drawn[-1]
            refined[-1].add(event["node"])
    rows = read_counts(out / "whole.0.csv")
    for end, row, nodes, again in zip(ends, rows, drawn, refined):
        assert [str(end[name]) for name in COUNTS[:6]] == row[:6]
        assert row[0] == str(len(nodes)) and row[1] == str(len(again))
    # a node is refined where something below it was drawn after it
    parents = world.hlodbench("info", "--json", world.hlod).stdout
    parent = {n["id"]: n["parent"] for n in json.loads(parents)["nodes"]}

    def above(node):
        while parent[node] is not None:
            node = parent[node]
            yield node

    expected = set.union(*(set(above(n)) & drawn[3] for n in drawn[3]))
    assert refined[3] == expected and expected
    assert all(not again for i, again in enumerate(refined) if i != 3)


# What goes wrong in a run


NO_NODE = f"asked for node {NODES}; the hierarchy has {NODES} nodes"
# What each strategy says of the fault in its name.
FAULTS = {
    "faulty-throw": "frame 3: no idea at all",
    "faulty-odd": "frame 3: an exception that is no std::exception",
    "faulty-node": f"frame 3: {NO_NODE}",
    "faulty-far": f"frame 3: asked for node 4294967295; the hierarchy has {NODES} nodes",
    "faulty-throwmade": "cannot be made",
    "whole-twice": "frame 3: drew node 0 twice",
    "whole-caught": "frame 3: drew node 0 twice",
    "whole-unknown": f"frame 3: asked to draw node 12345678; the hierarchy has {NODES} nodes",
    "whole-unqueried": "frame 3: asked for the result of node 160, which was not queried",
    "whole-requery": "frame 3: queried node 1 twice",
}
# These end the process.
LOSSES = {
    "faulty-loop": "frame 3 did not end within 1 s",
    "whole-poll": "frame 3 did not end within 1 s",
    "faulty-crash": "ended by signal SIGSEGV in frame 3",
    "faulty-exit": "ended the program by exit(0) in frame 3",
    "faulty-make": "ended by signal SIGABRT while the strategy was made",
    "faulty-remove": "ended by signal SIGSEGV while the strategy was removed",
}


@pytest.mark.parametrize("errors", [FAULTS, LOSSES], ids=["errors", "losses"])
def test_faults_cost_their_own_rows(world, good, errors):
    settings = [word for name in errors
                for word in ("--set", f"{name}.fault={name.partition('-')[2]}")]
    name = "faults" if errors is FAULTS else "losses"
    # the traces are each in its own file
    trace = world.folder / f"{name}.jsonl"
    # where the good ones stand among the bad ones is drawn from the seed
    result, out, cases = world.run(
        name, ",".join(["bool", *errors, "sw-b"]), *settings, "--trace", trace, "--seed", "5")
    assert result.returncode == 1
    # one line each, and no other
    said = [line for line in result.stderr.splitlines() if line.startswith("hlodbench:")]
    order = [strategy for strategy, _ in cases if strategy in errors]
    assert said == [f"hlodbench: {s} repetition 0 failed: {errors[s]}" for s in order]
    assert sorted(order) == sorted(errors)
    for strategy, error in errors.items():
        assert cases[strategy, 0]["error"] == error and cases[strategy, 0]["csv"] is None
    for other in ("bool", "sw-b"):
        assert cases[other, 0]["error"] is None
        assert read_counts(out / f"{other}.0.csv") == read_counts(good / f"{other}.0.csv")
    # the pictures of the others are there, and nothing else is left
    pictures = [p.name for p in (good / "images").iterdir()
                if p.name.split(".")[0] in ("bool", "sw-b", "full")]
    assert len(pictures) == 6
    assert everything(out) == sorted(
        ["bool.0.csv", "images", "images/images.json", *(f"images/{n}" for n in pictures),
         "run.json", "sw-b.0.csv"])
    for picture in pictures:
        assert (out / "images" / picture).read_bytes() == (good / "images" / picture).read_bytes()
    made = {p.name for p in world.folder.glob(f"{name}.*.jsonl")}
    assert made == {f"{name}.bool.jsonl", f"{name}.sw-b.jsonl"}


def test_a_lost_replay_loses_the_later_ones_too(world):
    result, out, cases = world.run(
        "repeated", "bool,faulty,whole", "--repetitions", "3", "--set", "faulty.fault=crash",
        "--set", "whole.fault=poll")
    assert result.returncode == 1
    assert len(cases) == 9
    assert read_run(out)["complete"]
    assert [cases["bool", i]["error"] for i in range(3)] == [None] * 3
    for strategy, error in (("faulty", LOSSES["faulty-crash"]), ("whole", LOSSES["whole-poll"])):
        assert cases[strategy, 0]["error"] == error
        for i in (1, 2):
            assert cases[strategy, i]["error"] == f"not replayed after repetition 0: {error}"
    orders = [c["order"] for c in cases.values()]
    assert orders == list(range(9)) and len({read_run(out)["context"]["time_utc"]}) == 1


class Started:
    """A run that goes on, and its worker."""

    def __init__(self, world, out, *options, timeout="1"):
        self.out = out
        command = world.arguments(out, "bool,faulty", *options, timeout=timeout)
        self.process = subprocess.Popen([os.environ["HLODBENCH_EXE"], *map(str, command)],
                                        stderr=subprocess.PIPE, text=True)
        children = pathlib.Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children")
        self.wait_for(lambda: (out / "run.json").exists())
        self.worker = pathlib.Path("/proc") / children.read_text().split()[0]

    def wait_for(self, condition):
        deadline = time.monotonic() + 60
        while not condition():
            assert time.monotonic() < deadline and self.process.poll() is None
            time.sleep(0.02)

    def end(self):
        """The exit code and what was said."""
        try:
            error = self.process.communicate(timeout=60)[1]
        finally:
            self.process.kill()
        assert not self.worker.exists(), "the worker outlives its supervisor"
        assert not list(self.out.rglob("*.tmp"))
        return self.process.returncode, error


# The order of the strategies that this seed draws: bool comes first.
BOOL_FIRST = ("--seed", "3")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interruption_reaches_the_run(world, number):
    out = world.folder / f"interrupted {number}"
    run = Started(world, out, "--repetitions", "2000", "--images", "none")
    run.process.send_signal(number)
    code, error = run.end()
    assert code == 1 and "hlodbench: interrupted; " in error
    result = read_run(out)
    assert not result["complete"] and result["missing"] and result["cases"]


def test_an_interruption_of_a_frame_that_never_ends(world):
    hanging = ("--set", "faulty.fault=loop", "--set", "faulty.frame=0", *BOOL_FIRST)
    out = world.folder / "hanging"
    run = Started(world, out, *hanging)
    run.process.send_signal(signal.SIGINT)
    code, error = run.end()
    assert code == 1
    assert "hlodbench: interrupted; frame 0 did not end within 1 s\n" in error
    assert [c["strategy"] for c in read_run(out)["cases"]] == ["bool"]
    run = Started(world, world.folder / "hanging on", *hanging, timeout="0")
    time.sleep(0.3)
    run.process.send_signal(signal.SIGTERM)
    time.sleep(0.3)
    run.process.send_signal(signal.SIGTERM)  # the second one ends it at once
    assert run.end()[0] == -signal.SIGTERM


def test_a_worker_does_not_outlive_a_killed_supervisor(world):
    run = Started(world, world.folder / "killed", "--repetitions", "2000", "--images", "none")
    run.process.kill()
    run.process.communicate()
    deadline = time.monotonic() + 20
    while run.worker.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not run.worker.exists()


# What is refused up front


def refuse(world, *words, plugins=(), options=(), env=None):
    out = world.folder / "refused"
    command = ["run", "--scene", world.hlod, "--session", world.session, "--out", out]
    for plugin in plugins:
        command += ["--plugin", plugin]
    result = world.hlodbench(*command, *options, env=env)
    complain(result, BAD_INPUT, *words)
    assert not out.exists()
    return result


CHANGES = {
    "major": ("version 1.0 to 1.0", "found 2.0"),
    "minor": ("version 1.0 to 1.0", "found 1.1"),
    "library": ("built with libstdc++", "found another library"),
    "name": ("strategy's name", "'My own'"),
    "taken": ("new names", "'coh-b' again"),
    "label": ("'yours'", "label"),
}


def test_a_wrong_description_is_refused(world, tmp_path):
    plugin = compile_plugin(tmp_path, "changed", CHANGED)
    listed = world.hlodbench("list", "--plugin", plugin)
    assert listed.returncode == 0 and "  yours " in listed.stdout
    for change, words in CHANGES.items():
        listed = world.hlodbench("list", "--plugin", plugin, env={"CHANGE": change})
        complain(listed, BAD_INPUT, f"--plugin {plugin}:", *words)
    refuse(world, *CHANGES["major"], plugins=[plugin], env={"CHANGE": "major"})


def test_what_is_no_plugin_is_refused(world, tmp_path):
    text = tmp_path / "text.so"
    text.write_text("no library\n")
    refuse(world, f"--plugin {text}", "can be loaded", plugins=[text])
    refuse(world, "found no file", plugins=[tmp_path / "none.so"])
    refuse(world, "found no file", plugins=[tmp_path])
    other = compile_plugin(tmp_path, "other", "int answer() { return 42; }\n")
    refuse(world, "without the function hlodbench_plugin", plugins=[other])
    missing = compile_plugin(tmp_path, "missing", "int f(); int g() { return f(); }\n")
    refuse(world, "can be loaded", "undefined symbol", plugins=[missing])
    refuse(world, "'faulty' again", plugins=[world.faulty, world.faulty])


def test_a_library_that_crashes_or_hangs_when_loaded_is_refused(world, tmp_path):
    crash = "#include <csignal>\nstatic int x = std::raise(SIGSEGV);\nint f() { return x; }\n"
    plugin = compile_plugin(tmp_path, "crash", crash)
    words = f"--plugin {plugin}: ended by signal SIGSEGV while it was loaded"
    refuse(world, words, plugins=[world.faulty, plugin])
    complain(world.hlodbench("list", "--plugin", plugin), BAD_INPUT, words)
    hang = "#include <unistd.h>\nstatic int x = pause();\nint f() { return x; }\n"
    plugin = compile_plugin(tmp_path, "hang", hang)
    refuse(world, "did not end within 0.5 s while it was loaded", plugins=[plugin],
           options=["--frame-timeout", "0.5"])


@pytest.mark.parametrize(
    "setting, words",
    [
        ("faulty.decay=2", ("--set faulty.decay", "a number from 0 to 1", "'2'")),
        ("faulty.frame=1.5", ("an integer from 0 to 1000", "'1.5'")),
        ("faulty.fault=no", ("one of none, throw", "'no'")),
        ("faulty.other=1", ("its options, fault, frame, decay",)),
        ("whole.fault=twice", ("a strategy that runs, faulty", "'whole'")),
        ("decay=1", ("STRATEGY.OPTION=VALUE", "'decay=1'")),
    ],
)
def test_a_wrong_setting_is_refused(world, setting, words):
    refuse(world, *words, plugins=[world.faulty, world.whole],
           options=["--strategy", "faulty", "--set", setting])


def test_an_unknown_strategy_names_those_of_the_plugins(world):
    refuse(world, "bool, sw-b, simp-b, coh-b", "faulty", "'mine'", plugins=[world.faulty],
           options=["--strategy", "mine"])


def test_headers_compile_by_themselves_as_every_standard(tmp_path):
    for header in ("options", "bias", "frame_view", "predictor", "strategy", "plugin"):
        source = f"#include <hlodbench/{header}.h>\n#include <hlodbench/{header}.h>\n"
        compile_plugin(tmp_path, header, source, "-fsyntax-only")
    for standard in ("c++17", "c++20", "c++23"):
        compile_plugin(tmp_path, "faulty", FAULTY, "-fsyntax-only", standard=standard)
