"""Checks every decision in a trace of `hlodbench run --trace` against the papers' algorithms.

    python3 trace_checker.py INFO.json TRACE.jsonl

INFO.json is what `hlodbench info --json` prints of the same hierarchy. Prints the first
disagreement, or "ok, N decisions"; exit code 0 if the trace is right, 1 if not, 2 for files that
cannot be read. It shares no code with the program. The traversals are those of

    Charalambos, Bittner, Wimmer, Romero. Optimized HLOD Refinement Driven by Hardware Occlusion
    Queries. ISVC 2007, Figs. 2 and 3;
    Bittner, Wimmer, Piringer, Purgathofer. Coherent Hierarchical Culling. CGF 23(3), 2004.

What cannot be known from outside, it takes from the trace: the pixels that passed, with the
driver's own latency when a result was there, and the predictions of `ideal`, which must then prove
right. `oracle` decides nothing, so there is nothing to check: refused, exit code 2. Where nine
digits are too few to decide, either way is right.
"""

import heapq
import json
import math
import sys
from dataclasses import dataclass, field

from trace_events import Disagreement, Events, Node, Unsupported, read_hierarchy
from trace_view import RELATIVE, Lens, View


def sigmoid(mu, t, p):
    """Concave above the turn-over point t, convex below; fixed at 0, t and 1."""
    if mu <= t:
        return 0.0 if t == 0 else t * (mu / t) ** p
    return 1 - (1 - t) * ((1 - mu) / (1 - t)) ** p


SWITCHES = {  # of later versions: the values that are known, the default first
    "pull_up": ("refine", "delay"),
    "render_guard": ("on", "off"),
    "near_plane": ("visible", "query"),
    "query_faces": ("front", "both"),  # what passed is taken from the trace
    "mu_area": ("clipped", "unclipped"),
}


@dataclass
class Frame:
    """What is counted and queued in one frame."""

    number: int
    view: View
    queue: list = field(default_factory=list)  # heap of (distance, id)
    waiting: list = field(default_factory=list)  # queried nodes, oldest first
    queried: dict = field(default_factory=dict)  # id -> draws before its query
    biases: list = field(default_factory=list)  # of visible results, in order
    counts: dict = field(default_factory=dict)

    def count(self, name, by=1):
        self.counts[name] = self.counts.get(name, 0) + by


class Checker:
    def __init__(self, nodes, lines):
        self.nodes = nodes
        self.events = Events(lines)
        self.header = self.events.take("run")
        self.switches = {name: self.header.get(name, SWITCHES[name][0]) for name in SWITCHES}
        self.tau = self.header["tau"]
        kind, _, number = self.header["latency"].partition(":")
        self.latency = (kind, int(number or 0))
        self.draws = 0  # in all frames: the clock of latencies in draws
        self.frame = None
        self.unsure = False  # set when a comparison was too close to tell
        predictions = {
            "bool": self.predict_bool,
            "sw-b": lambda node: "delay",
            "simp-b": self.predict_simp,
            "coh-b": self.predict_coh,
            "ideal": lambda node: self.told,
            "none": lambda node: "stop" if self.stops(node) else "refine",
            "full": lambda node: "refine" if node.children else "stop",
        }
        strategy = self.header["strategy"]
        if strategy not in predictions:
            known = ", ".join(predictions)
            raise Unsupported(f"line 1: strategy: can check one of {known}, found {strategy!r}")
        self.predict = predictions[strategy]
        self.asks = strategy not in ("none", "full")
        self.is_ideal = strategy == "ideal"
        self.told = None  # the prediction of the visit at hand

    def check(self):
        """Number of decisions found right; raises Disagreement at the first that is not."""
        self.events.expect("version", 1, self.header["version"])
        for name, value in self.switches.items():
            if value not in SWITCHES[name]:
                known = " or ".join(SWITCHES[name])
                raise self.events.disagree(f"expected {name} {known}, found {value}")
        number = 0
        while self.events.at < len(self.events.lines):
            self.check_frame(number)
            number += 1
        if number == 0:
            raise self.events.disagree("expected at least one frame, found none")
        return len(self.events.lines) - 1 - 2 * number

    def check_frame(self, number):
        header = self.header
        start = self.events.take("frame")
        self.events.expect("frame", number, start["frame"])
        lens = Lens(*header["viewport"], header["fovy_rad"], header["near"], header["far"])
        view = View(lens, start["position"], start["orientation"])
        self.frame = frame = Frame(number, view)
        self.push([self.nodes[0]])
        while frame.queue or frame.waiting:
            while frame.waiting and (not frame.queue or self.result_comes_first()):
                self.finish(frame.waiting.pop(0))
            if frame.queue:
                self.visit(self.nearest())
        end = self.events.take("end")
        self.events.expect("frame", number, end["frame"])
        for name in ("dn", "rarn", "d", "delays", "queries", "triangles"):
            self.events.expect(name, frame.counts.get(name, 0), end[name])

    # The queues

    def push(self, nodes):
        for node in nodes:
            heapq.heappush(self.frame.queue, (self.frame.view.distance(node.box), node.id))

    def nearest(self):
        """The node that the trace takes up next, which must be the nearest, ties by id."""
        queue = self.frame.queue
        distance, best = queue[0]
        event = self.events.peek()
        if event["type"] != "visit" or event["node"] == best:
            return self.nodes[heapq.heappop(queue)[1]]
        for entry in queue:
            gap = entry[0] - distance
            if entry[1] == event["node"] and 0 < gap <= RELATIVE * max(1e-3, distance):
                queue.remove(entry)
                heapq.heapify(queue)
                return self.nodes[entry[1]]
        return self.nodes[best]  # taking its event will fail and say so

    def result_comes_first(self):
        """Whether the oldest query's result is there, though nodes are left to go on with."""
        kind, number = self.latency
        if self.header["strategy"] == "sw-b":
            return True
        if kind == "draws":
            return self.draws - self.frame.queried[self.frame.waiting[0].id] >= number
        if kind == "frames":
            return number == 0
        return self.events.peek()["type"] == "result"

    # Decisions

    def visit(self, node):
        event = self.events.take("visit", node)
        inside, unsure = self.frame.view.sees(node.box)
        if not unsure:
            self.events.expect("in_frustum", inside, event["in_frustum"])
        if not event["in_frustum"]:
            return
        sse = self.sse(node)
        self.events.expect("sse_px", sse, event["sse_px"], RELATIVE * sse)
        self.unsure = False
        self.told = event["prediction"]
        mode = self.predict(node)  # from what the last frame left in the node
        if self.unsure and event["prediction"] in ("refine", "stop", "delay"):
            mode = event["prediction"]
        self.events.expect("prediction", mode, event["prediction"])
        node.visible, node.visited = False, self.frame.number
        node.stop, node.delayed = mode != "refine", mode == "delay"
        self.frame.count("delays", node.delayed)
        if mode == "refine" or not self.asks:
            self.traverse(node)
        elif self.is_near(node):
            self.decide_near(node)
        else:
            self.query(node)
            if mode == "stop":
                self.traverse(node)

    def is_near(self, node):
        if self.switches["near_plane"] == "query":
            near, unsure = self.frame.view.is_inside(node.box)
        else:
            near, unsure = self.frame.view.cuts(node.box)
        return self.events.peek()["type"] == "near" if unsure else near

    def decide_near(self, node):
        """No box to query: seen whole."""
        event = self.events.take("near", node)
        self.pull_up_visibility(node)
        node.bias = 1.0
        node.stop = self.stops(node)
        if self.unsure:
            following = self.events.peek()
            node.stop = following["type"] == "draw" and following["node"] == event["node"]
        self.traverse(node)

    def query(self, node):
        self.events.take("query", node)
        if node.id in self.frame.queried:
            raise self.events.disagree(f"second query of node {node.id} in one frame")
        self.frame.queried[node.id] = self.draws
        self.frame.waiting.append(node)
        self.frame.count("queries")

    def finish(self, node):
        event = self.events.take("result", node)
        expect = self.events.expect
        pixels = event["pixels"]
        clipped = self.switches["mu_area"] == "clipped"
        box_px, slack = self.frame.view.box_pixels(node.box, clipped)
        expect("box_px", box_px, event["box_px"], slack)
        mu = min(1.0, pixels / event["box_px"])
        expect("mu", mu, event["mu"], RELATIVE * mu)
        if pixels > 0:
            self.pull_up_visibility(node)
            node.bias = self.bias(event["mu"])
        elif self.header["zero_pixels"] == "zero":
            node.bias = self.bias(0.0)
        expect("bias", node.bias, event["bias"], RELATIVE)
        node.bias = event["bias"]
        self.unsure = False
        stop = self.stops(node) if pixels > 0 else node.stop
        if not self.unsure:
            expect("stop", stop, event["stop"])
        node.stop = event["stop"]
        if self.is_ideal and (node.delayed != (pixels == 0) or not node.stop):
            raise self.events.disagree(f"the prediction for node {node.id} was wrong")
        if pixels > 0:
            self.frame.biases.append(node.bias)
            self.traverse(node)

    def traverse(self, node):
        """Draws a node of the front, once a frame; goes on to the children of another."""
        if node.stop:
            if node.drawn == self.frame.number and self.switches["render_guard"] == "on":
                return
            self.events.take("draw", node)
            node.drawn = self.frame.number
            self.draws += 1
            self.frame.count("dn")
            self.frame.count("d", node.delayed)
            self.frame.count("triangles", node.triangles)
            return
        if not node.children:
            raise self.events.disagree(f"node {node.id} is refined, but is a leaf")
        if node.drawn == self.frame.number:
            self.events.take("rarn", node)
            self.frame.count("rarn")
        self.push(node.children)

    @staticmethod
    def pull_up_visibility(node):
        while node is not None and not node.visible:
            node.visible = True
            node = node.parent

    # Conditions

    def sse(self, node):
        return self.frame.view.screen_error(node.box, node.error)

    def bias(self, mu):
        """B_{s,t}(mu); 1 for the strategy that takes query results as yes or no."""
        if self.header["strategy"] == "bool":
            return 1.0
        s = self.header["s"]
        return (1 - s) * mu + s * sigmoid(mu, self.header["t"], self.header["exponent"])

    def tolerable(self, node, bias):
        vmsse = bias * self.sse(node)
        self.unsure |= math.isclose(vmsse, self.tau, rel_tol=RELATIVE)
        return vmsse <= self.tau

    def stops(self, node):
        self.unsure = False
        return not node.children or self.tolerable(node, node.bias)

    def was_visible(self, node):
        return node.visible and node.visited == self.frame.number - 1

    # Predictions

    def predict_bool(self, node):
        if not self.was_visible(node):
            return "delay"
        return "stop" if self.tolerable(node, 1.0) else "refine"

    def predict_simp(self, node):
        """By the bias of what was processed before in this frame; 1 while there is nothing."""
        if not self.was_visible(node):
            return "delay"
        biases = self.frame.biases or [1.0]
        if self.header["simp_estimate"] == "mean":
            estimate = math.fsum(biases) / len(biases)
        else:
            estimate = biases[-1]
        return "stop" if self.tolerable(node, estimate) else "refine"

    def predict_coh(self, node):
        """Fig. 3."""
        if not self.was_visible(node):
            return "delay"
        if node.stop:
            stop = self.tolerable(node, node.bias) or not node.children
            return "stop" if stop else "refine"
        front = node.children
        if self.header["stale_children"] == "skip":
            front = [c for c in front if c.visited == self.frame.number - 1]
        stays = [c.stop and self.tolerable(c, c.bias) for c in front]
        if self.switches["pull_up"] == "delay" and not all(stays):
            return "delay"
        if front and all(stays):
            mean = math.fsum(c.bias for c in front) / len(front)
            if self.tolerable(node, mean):
                return "delay"
        return "refine"


def check_trace(info, lines):
    """Number of decisions in the trace; raises Disagreement at the first wrong one."""
    checker = None
    try:
        checker = Checker(read_hierarchy(info), lines)
        return checker.check()
    except KeyError as error:
        line = checker.events.at if checker else 1
        raise Disagreement(f"line {line}: expected a key or value {error}, found none") from None


def main(arguments):
    if len(arguments) != 2:
        print("usage: trace_checker.py INFO.json TRACE.jsonl", file=sys.stderr)
        return 2
    try:
        with open(arguments[0], encoding="utf-8") as file:
            info = json.load(file)
        with open(arguments[1], encoding="utf-8") as file:
            lines = file.read().splitlines()
    except (OSError, ValueError) as error:
        print(f"trace_checker: {error}", file=sys.stderr)
        return 2
    try:
        print(f"ok, {check_trace(info, lines)} decisions")
    except Unsupported as error:
        print(f"trace_checker: {arguments[1]}: {error}", file=sys.stderr)
        return 2
    except Disagreement as error:
        print(f"{arguments[1]}: {error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
