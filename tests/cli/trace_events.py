"""What a checker of traces reads: the hierarchy's nodes, and the events in their order."""

import json
from dataclasses import dataclass

from trace_view import Box


class Disagreement(Exception):
    """The trace says something that the algorithm would not have done."""


class Unsupported(Exception):
    """The trace is of a strategy whose decisions are not known here."""


@dataclass
class Node:
    """A node of the hierarchy, and what a traversal remembers of it."""

    id: int
    parent: "Node"
    children: list
    box: Box
    error: float
    triangles: int
    bias: float = 1.0
    visited: int = -1  # frame in which it was last taken up inside the frustum
    drawn: int = -1
    visible: bool = False
    stop: bool = False
    delayed: bool = False


def read_hierarchy(info):
    """Nodes by id from the content of `hlodbench info --json`."""
    nodes = [
        Node(n["id"], None, [], Box(tuple(n["min"]), tuple(n["max"])), n["error"], n["triangles"])
        for n in info["nodes"]
    ]
    for node, stored in zip(nodes, info["nodes"]):
        node.parent = None if stored["parent"] is None else nodes[stored["parent"]]
        node.children = [nodes[c] for c in stored["children"]]
    return nodes


class Events:
    """The lines of a trace, one after the other, with their numbers."""

    def __init__(self, lines):
        self.lines = lines
        self.at = 0

    def peek(self):
        if self.at == len(self.lines):
            return {"type": "the end of the file"}
        try:
            return json.loads(self.lines[self.at])
        except ValueError as error:
            self.at += 1
            raise self.disagree(f"not JSON: {error}") from None

    def take(self, kind, node=None):
        """The next event, which must be of this kind and of this node."""
        event = self.peek()
        self.at += 1
        wanted = kind if node is None else f"{kind} of node {node.id}"
        found = event["type"] + (f" of node {event['node']}" if "node" in event else "")
        if event["type"] != kind or (node is not None and event["node"] != node.id):
            raise self.disagree(f"expected {wanted}, found {found}")
        return event

    def expect(self, name, expected, found, slack=None):
        if slack is None:
            right = expected == found and isinstance(expected, bool) == isinstance(found, bool)
        else:
            right = abs(expected - found) <= slack
        if not right:
            raise self.disagree(f"expected {name} {expected}, found {found}")

    def disagree(self, text):
        return Disagreement(f"line {self.at}: {text}")
