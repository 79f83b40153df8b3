"""A small sweep.csv for the tests of what reads it."""

import csv
import itertools

HEAD = ("cell", "strategy", "label", "scene", "session", "size", "tau", "s", "t", "latency", "seed",
        "repetitions", "timing", "option.simp", "program", "revision", "scene_hash",
        "scene_triangles", "scene_nodes", "frames", "dn", "rarn", "frame_ms", "fps")
FIXED = {"scene": "walls", "session": "path", "size": "64x48", "tau": "1", "t": "0.25", "seed": "1",
         "repetitions": "1", "timing": "true", "program": "0123", "revision": "4567",
         "scene_hash": "89", "scene_triangles": "1000", "scene_nodes": "20", "frames": "30"}


def write_sweep(folder):
    """Three parameters, two strategies; DN is 100 + 10 · the row's number. gl has no value but DN,
    and not every combination is there."""
    folder.mkdir()
    with open(folder / "sweep.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, HEAD, restval="", lineterminator="\n")
        writer.writeheader()
        number = 0
        for s, latency, simp in itertools.product(("0.5", "1"), ("draws:20", "draws:5", "gl"),
                                                  ("last", "mean")):
            if (s, latency) == ("1", "gl"):
                continue
            for strategy, label in (("bool", "Bool"), ("mine", "<Mine>")):
                times = {} if latency == "gl" else {"frame_ms": "12.5", "fps": "80"}
                writer.writerow({"cell": f"{s}{latency}{simp}", "strategy": strategy, "s": s,
                                 "label": label, "latency": latency, "option.simp": simp,
                                 "dn": str(100 + 10 * number), **FIXED, **times})
                number += 1
