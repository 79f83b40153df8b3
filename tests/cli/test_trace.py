"""Every decision of a run agrees with an implementation of the algorithms of its own, and that
implementation notices a decision that is not the algorithm's."""

import json
import pathlib
import subprocess
import sys

import pytest
from small_scene import build_yard
from trace_checker import Disagreement, check_trace

STRATEGIES = ("bool", "sw-b", "simp-b", "coh-b")
FRAMES = 40
RUNS = {  # the settings that change what is decided
    "draws:0": [],
    "draws:7": [],
    "frames:1": [],
    "gl": [],
    "draws:7 literal": ["--stale-children", "literal", "--zero-pixels", "literal"],
    "draws:7 mean": ["--simp", "mean", "--s", "0.6", "--t", "0.1", "--exponent", "3"],
    "draws:7 delay": ["--pull-up", "delay", "--stale-children", "literal"],
    "draws:7 unguarded": ["--render-guard", "off", "--mu-area", "unclipped"],
    "draws:7 near": ["--near-plane", "query", "--query-faces", "both"],
    "draws:7 all": ["--near-plane", "query", "--mu-area", "unclipped", "--pull-up", "delay"],
    "draws:3 coarse": ["--tau", "8", "--t", "0", "--zero-pixels", "literal"],
}


class Yard:
    """A courtyard's hierarchy, and traces of runs through it, made when first asked for."""

    def __init__(self, hlodbench, folder):
        self.hlodbench = hlodbench
        self.folder = folder
        self.hlod, self.session = build_yard(hlodbench, folder, FRAMES)
        info = hlodbench("info", "--json", self.hlod)
        assert info.returncode == 0, info.stderr
        (folder / "info.json").write_text(info.stdout, encoding="utf-8")
        self.info = json.loads(info.stdout)

    def traces(self, name):
        """Lines by strategy of the run of this name."""
        stem = name.replace(" ", "-").replace(":", "")
        paths = {s: self.folder / f"{stem}.{s}.jsonl" for s in STRATEGIES}
        if not paths["bool"].exists():
            arguments = ["run", "--scene", self.hlod, "--session", self.session]
            arguments += ["--out", self.folder / f"out-{stem}", "--latency", name.split()[0]]
            arguments += ["--trace", self.folder / f"{stem}.jsonl", "--warm-up", "1", *RUNS[name]]
            run = self.hlodbench(*arguments)
            assert run.returncode == 0, run.stderr
        return {s: path.read_text(encoding="utf-8").splitlines() for s, path in paths.items()}


@pytest.fixture(scope="module")
def yard(hlodbench, tmp_path_factory):
    return Yard(hlodbench, tmp_path_factory.mktemp("a yard"))


def count_events(lines):
    counts = {}
    for event in map(json.loads, lines):
        kind = event.get("prediction") or event["type"]
        counts[kind] = counts.get(kind, 0) + 1
    return counts


@pytest.mark.parametrize("strategy", STRATEGIES)
@pytest.mark.parametrize("name", RUNS)
def test_every_decision_is_the_algorithms(yard, name, strategy):
    lines = yard.traces(name)[strategy]
    counts = count_events(lines)
    assert counts["frame"] == counts["end"] == FRAMES
    decisions = check_trace(yard.info, lines)
    assert decisions == len(lines) - 1 - 2 * FRAMES
    assert decisions > 100 * FRAMES, "the scene is too simple to test anything"


def test_the_runs_meet_every_kind_of_decision(yard):
    """Else the checks above prove little."""
    seen = {s: count_events(lines) for s, lines in yard.traces("draws:7").items()}
    for strategy, counts in seen.items():
        assert counts["near"] and counts["query"] and counts["result"] and counts["draw"], strategy
        assert counts["visit"], f"{strategy}: nothing was outside the frustum"
        if strategy != "sw-b":
            assert counts["refine"] and counts["stop"] and counts["delay"], strategy
    assert set(seen["sw-b"]) & {"refine", "stop", "rarn"} == set()
    assert seen["simp-b"]["rarn"] and seen["coh-b"]["rarn"]
    for other in ("draws:0", "draws:7 literal", "draws:7 mean"):
        assert yard.traces(other)["simp-b"][1:] != yard.traces("draws:7")["simp-b"][1:], other
    assert count_events(yard.traces("draws:7 near")["coh-b"]).get("near", 0) < seen["coh-b"]["near"]
    for other in ("draws:7 delay", "draws:7 unguarded", "draws:7 near"):
        assert yard.traces(other)["coh-b"][1:] != yard.traces("draws:7")["coh-b"][1:], other
    for line in yard.traces("draws:7")["sw-b"]:
        event = json.loads(line)
        assert event.get("prediction", "delay") == "delay"


# Traces with one thing altered

def find(events, last=True, **wanted):
    """Index of the last (or first) event in which these members have these values."""
    found = [
        i for i, e in enumerate(events) if all(e.get(k) == v for k, v in wanted.items())
    ]
    assert found, f"no event with {wanted}"
    return found[-1 if last else 0]


def change(**values):
    """Alters members: a value, or a function of the old one, in the last event that fits."""

    def alter(events, **wanted):
        event = events[find(events, **wanted)]
        for key, value in values.items():
            event[key] = value(event[key]) if callable(value) else value

    return alter


def remove(events, **wanted):
    del events[find(events, **wanted)]


def repeat(events, **wanted):
    i = find(events, **wanted)
    events.insert(i, dict(events[i]))


def swap_neighbours(events, **wanted):
    """Exchanges two events of one kind that follow each other."""
    for i in range(len(events) - 1, 0, -1):
        pair = events[i - 1 : i + 1]
        if all(e.get(k) == v for e in pair for k, v in wanted.items()):
            events[i - 1 : i + 1] = pair[::-1]
            return
    raise AssertionError(f"no two neighbours with {wanted}")


def move_earlier(events, **wanted):
    """A result before the event that came before it."""
    i = find(events, **wanted)
    while events[i - 1]["type"] != "visit":
        i = max(j for j in range(i) if events[j]["type"] == wanted["type"])
    events[i - 1 : i + 1] = events[i - 1 : i + 1][::-1]


def exchange_results(events):
    """The results of two nodes in a row, the later first."""
    swap_neighbours(events, type="result", pixels=0)


def more(value):
    return value * 1.0001


def nudge(value):
    return value + (0.001 if value < 0.5 else -0.001)


REFINED = {"prediction": "refine"}
STOPPED = {"prediction": "stop"}
ALTERED = {
    "a refinement predicted as a stop": ("coh-b", change(prediction="stop"), REFINED),
    "a stop predicted as a refinement": ("coh-b", change(prediction="refine"), STOPPED),
    "a stop predicted as a delay": ("simp-b", change(prediction="delay"), {"prediction": "stop"}),
    "a delay predicted as a stop": ("bool", change(prediction="stop"), {"prediction": "delay"}),
    "stop-and-wait that predicts": ("sw-b", change(prediction="stop"), {"prediction": "delay"}),
    "an unknown prediction": ("coh-b", change(prediction="wait"), {"prediction": "stop"}),
    "a node outside said to be inside": ("bool", change(in_frustum=True), {"in_frustum": False}),
    "a node inside said to be outside": ("bool", change(in_frustum=False), {"in_frustum": True}),
    "another error": ("bool", change(sse_px=more), {"prediction": "refine"}),
    "visits in another order": ("bool", swap_neighbours, {"type": "visit", "in_frustum": False}),
    "a visit left out": ("sw-b", remove, {"type": "visit"}),
    "a near node queried": ("coh-b", change(type="query"), {"type": "near"}),
    "a query left out": ("coh-b", remove, {"type": "query"}),
    "a second query": ("coh-b", repeat, {"type": "query"}),
    "a result left out": ("bool", remove, {"type": "result"}),
    "more pixels": ("coh-b", change(pixels=lambda p: p + 1), {"type": "result", "stop": False}),
    "a hidden node made visible": ("bool", change(pixels=1), {"pixels": 0}),
    "another area of a box": ("sw-b", change(box_px=more), {"type": "result", "stop": False}),
    "another visibility": ("simp-b", change(mu=nudge), {"type": "result", "stop": False}),
    "another bias": ("coh-b", change(bias=nudge), {"type": "result", "stop": False}),
    "a bias of bool": ("bool", change(bias=0.5), {"type": "result", "stop": True}),
    "a node not refined": ("sw-b", change(stop=True), {"type": "result", "stop": False}),
    "a result too early": ("coh-b", move_earlier, {"type": "result"}),
    "stop-and-wait without a query": ("sw-b", remove, {"type": "query"}),
    "a node not drawn": ("simp-b", remove, {"type": "draw"}),
    "a node drawn twice": ("simp-b", repeat, {"type": "draw"}),
    "a rarn left out": ("simp-b", remove, {"type": "rarn"}),
    "a rarn too many": ("simp-b", repeat, {"type": "rarn"}),
    "a frame left out": ("bool", remove, {"type": "end"}),
    "another frame number": ("bool", change(frame=0), {"type": "frame"}),
    "another camera": ("bool", change(position=[0, 1.7, 19]), {"type": "frame"}),
    "another tau": ("coh-b", change(tau=1.3), {"type": "run"}),
    "another s": ("sw-b", change(s=0.9), {"type": "run"}),
    "another switch of children": ("coh-b", change(stale_children="literal"), {"type": "run"}),
    "another switch for no pixels": ("coh-b", change(zero_pixels="literal"), {"type": "run"}),
    "another estimate of Simp": ("simp-b", change(simp_estimate="mean"), {"type": "run"}),
    "another reading of Fig. 3": ("coh-b", change(pull_up="delay"), {"type": "run"}),
    "another guard of Render": ("coh-b", change(render_guard="off"), {"type": "run"}),
    "another near plane": ("coh-b", change(near_plane="query"), {"type": "run"}),
    "another area": ("coh-b", change(mu_area="unclipped"), {"type": "run"}),
    "an unknown reading": ("coh-b", change(pull_up="wait"), {"type": "run"}),
    "another latency": ("coh-b", change(latency="draws:8"), {"type": "run"}),
    "another strategy": ("coh-b", change(strategy="simp-b"), {"type": "run"}),
    "another viewport": ("bool", change(viewport=[160, 121]), {"type": "run"}),
    **{
        f"another count of {name}": ("coh-b", change(**{name: lambda n: n + 1}), {"type": "end"})
        for name in ("dn", "rarn", "d", "delays", "queries", "triangles")
    },
}


@pytest.fixture(scope="module")
def starts(yard):
    """The first frames of the traces with latency draws:7, right as they are."""
    frames = 14
    result = {}
    for strategy, lines in yard.traces("draws:7").items():
        events = [json.loads(line) for line in lines]
        result[strategy] = events[: find(events, type="end", frame=frames - 1) + 1]
    return result


def check(yard, events):
    return check_trace(yard.info, [json.dumps(e) for e in events])


def test_starts_of_traces_are_right(yard, starts):
    for events in starts.values():
        check(yard, events)


@pytest.mark.parametrize("name", ALTERED)
def test_an_altered_decision_is_noticed(yard, starts, name):
    strategy, alter, wanted = ALTERED[name]
    events = [dict(event) for event in starts[strategy]]
    alter(events, **wanted)
    assert events != starts[strategy]
    with pytest.raises(Disagreement, match=r"^line \d+: "):
        check(yard, events)


def test_results_in_another_order_are_noticed(yard, starts):
    events = [dict(event) for event in starts["coh-b"]]
    exchange_results(events)
    with pytest.raises(Disagreement, match="expected result of node"):
        check(yard, events)


def run_tool(*arguments):
    tool = pathlib.Path(__file__).with_name("trace_checker.py")
    command = [sys.executable, str(tool), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True)


def test_the_checker_is_a_tool(yard, starts, tmp_path):
    lines = [json.dumps(e) for e in starts["coh-b"]]
    trace = tmp_path / "a trace.jsonl"
    trace.write_text("\n".join(lines) + "\n", encoding="utf-8")
    right = run_tool(yard.folder / "info.json", trace)
    assert (right.returncode, right.stderr) == (0, "")
    assert right.stdout.startswith("ok, ") and right.stdout.endswith(" decisions\n")
    trace.write_text("\n".join(lines[:-1]) + "\n", encoding="utf-8")
    wrong = run_tool(yard.folder / "info.json", trace)
    assert wrong.returncode == 1
    assert wrong.stdout == f"{trace}: line {len(lines)}: expected end, found the end of the file\n"
    assert run_tool(trace).returncode == 2
    assert run_tool(yard.folder / "missing", trace).returncode == 2
