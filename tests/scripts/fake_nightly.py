"""A stand-in for the program that scripts/nightly.sh measures: what it does stands in a JSON file
beside it, PROGRAM.json, so that a test can change it from night to night.

slower: share by which queries and so frames take longer. turns: whether it can take turns. noise: relative deviation of its frame times.
add: {counter: number added to the counter in one frame}. picture: a number added to a pixel.
code: it ends with this code, after a line on stderr. sleep: seconds that a timed run takes.
strategies: those it has. tree: hash of its hierarchy. renderer: its OpenGL. drop: a counter that it lacks.
crash: numbers of its runs that a signal ends, from 1. Every call of it is a line in PROGRAM.log, and in
PROGRAM.cores the cores of the processor that it might run on.
"""

import contextlib
import json
import os
import pathlib
import random
import signal
import socket
import sys
import time

STRATEGIES = ("bool", "sw-b", "simp-b", "coh-b", "reuse-b")
PROGRAM = """#!{python}
import sys
sys.path.insert(0, {folder!r})
import fake_nightly
sys.exit(fake_nightly.main(__file__, sys.argv[1:]))
"""
FRAME_MS = 20.0
FRAMES = 10
SLOWED = {"draw_ms": "draw", "query_ms": "query", "wait_ms": "query",
          "traversal_ms": "traversal"}


def add_program(path, **state):
    """Makes one."""
    path.write_text(PROGRAM.format(python=sys.executable, folder=str(pathlib.Path(__file__).parent)),
                    encoding="utf-8")
    path.chmod(0o755)
    set_state(path, **state)
    return path


def set_state(path, **state):
    path.with_name(path.name + ".json").write_text(json.dumps(state), encoding="utf-8")


def read_calls(path):
    """The arguments of its calls."""
    return read_lines(path.with_name(path.name + ".log"))


def read_timed_cores(path):
    """Of each of its timed replays, the cores of the processor."""
    cores = read_lines(path.with_name(path.name + ".cores"))
    return [allowed for call, allowed in zip(read_calls(path), cores)
            if "gl" in call and "--size" not in call]


def read_lines(path):
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def main(program, arguments):
    with open(program + ".log", "a", encoding="utf-8") as log:
        log.write(json.dumps(arguments) + "\n")
    with open(program + ".cores", "a", encoding="utf-8") as log:
        log.write(json.dumps(sorted(os.sched_getaffinity(0))) + "\n")
    state = json.loads(pathlib.Path(program + ".json").read_text(encoding="utf-8"))
    if arguments[0] == "list":
        names = state.get("strategies", STRATEGIES)
        print("Strategies (--strategy):\n" + "".join(f"  {n:15}{n}\n" for n in names)
              + "\nContexts (--context):\n  auto           any")
        return 0
    if arguments == ["run", "--help"]:
        print("  --turns INT  a socket" if state.get("turns", True) else "no such thing")
        return 0
    if arguments[0] == "build":
        pathlib.Path(arguments[arguments.index("-o") + 1]).write_text("tree", encoding="utf-8")
        return 0
    values = dict(zip(arguments[1::2], arguments[2::2]))
    if state.get("code"):
        print("a line\nhlodbench: the reason why", file=sys.stderr)
        return state["code"]
    if sum("--out" in call for call in read_calls(pathlib.Path(program))) in state.get("crash", []):
        os.kill(os.getpid(), signal.SIGKILL)
    folder = pathlib.Path(values["--out"])
    if values["--latency"] == "gl":
        if "--size" not in values:  # no timed one, but a probe
            time.sleep(state.get("sleep", 0))
        write_timed(folder, values, state)
    else:
        write_exact(folder, values, state)
    return 0


def write_timed(folder, values, state):
    """Without numpy, as there are many of them."""
    # the folder is PASS/SCENE/.STRATEGY.REPETITION.SIDE.HOST.PROCESS
    place = (folder.parts[-3], *folder.name.split(".")[1:4], state.get("seed"))
    chance = random.Random(" ".join(map(str, place)))
    noise = 1 + chance.gauss(0, state.get("noise", 0.003))
    stages = {"draw_ms": 3.0 * noise, "traversal_ms": 1.0 * noise, "wait_ms": 2.0 * noise}
    query = FRAME_MS * noise * (1 + state.get("slower", 0)) - sum(stages.values())
    stages = {**stages, "query_ms": query}
    slowed, _, percent = os.environ.get("HLODBENCH_TEST_SLOWDOWN", "").partition("=")
    for stage in [key for key in stages if slowed == SLOWED.get(key)]:
        stages[stage] *= 1 + float(percent) / 100
    turns = Turns(values) if "--turns" in values else None
    rows = []
    for frame in range(FRAMES):
        if turns:
            turns.take(frame)
        rows.append(f"{frame},{int(frame < 2)}," + ",".join(f"{v:.9g}" for v in stages.values()))
    if turns:
        turns.finish()
    folder.mkdir(parents=True)
    case = {"strategy": values["--strategy"], "repetition": 0, "csv": "frames.csv", "error": None,
            "summary": {"fps": 1000 / sum(stages.values()),
                        "counters": {key: {"mean": value} for key, value in stages.items()}}}
    (folder / "frames.csv").write_text(
        "\n".join(["frame,warm_up," + ",".join(stages), *rows]) + "\n", encoding="utf-8")
    (folder / "run.json").write_text(json.dumps({
        "schema_version": "1.0.0",
        "context": {"gl": {"renderer": state.get("renderer", "llvmpipe")}},
        "scene": {"name": "courtyard", "hash": state.get("tree", "00")},
        "session": {"name": "courtyard", "frames": FRAMES}, "cases": [case]}), encoding="utf-8")


class Turns:
    """As bench/turns.h has them."""

    def __init__(self, values):
        self._frames = int(values["--turn-frames"])
        self._end = socket.socket(fileno=int(values["--turns"]))
        self._has_turn = False

    def take(self, frame):
        if frame % self._frames == 0:
            self.finish()
            with contextlib.suppress(OSError):  # the other one is gone
                self._end.recv(1)
            self._has_turn = True

    def finish(self):
        if self._has_turn:
            with contextlib.suppress(OSError):
                self._end.send(b"t")
        self._has_turn = False


def write_exact(folder, values, state):
    """Changed in frame 7, which is no warm-up."""
    import fake_run  # pylint: disable=import-outside-toplevel

    def edit(pictures):
        for pixels in pictures.values():
            pixels[0, 0, 0] ^= state.get("picture", 0)

    run = fake_run.make_run(folder, values["--strategy"].split(","), frames=12, repetitions=1,
                            image_frames=(6, 9), overlays=(), scene="courtyard", edit=edit)
    for case in run.data["cases"]:
        path = folder / case["csv"]
        lines = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines()]
        for counter, number in state.get("add", {}).items():
            field = lines[8][lines[0].index(counter)] or "0"
            lines[8][lines[0].index(counter)] = f"{float(field) + number:.9g}"
            case["summary"]["counters"][counter]["mean"] += number / case["summary"]["frames"]
        path.write_text("\n".join(map(",".join, lines)) + "\n", encoding="utf-8")
        case["summary"]["counters"].pop(state.get("drop"), None)
    run.data["context"]["gl"]["renderer"] = state.get("renderer", "llvmpipe")
    fake_run.write_json(folder / "run.json", run.data)
