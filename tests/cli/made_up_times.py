"""Result folders with times that are made up, from those that `hlodbench run` left."""

import csv
import json
import shutil


def read_log(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write_log(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def edit_json(path, edit):
    content = json.loads(path.read_text(encoding="utf-8"))
    edit(content)
    path.write_text(json.dumps(content), encoding="utf-8")


def copy_with_times(source, target, times):
    """Copies a result folder; each frame of repetition r of strategy s takes times[s][r] ms, and
    every stage of it a fixed part. Repetitions that have no time are taken out."""
    shutil.copytree(source, target)

    def edit(run):
        run["cases"] = [
            c for c in run["cases"] if c["repetition"] < len(times.get(c["strategy"], []))
        ]
        for case in run["cases"]:
            rows = read_log(target / case["csv"])
            time = times[case["strategy"]][case["repetition"]]
            for i, row in enumerate(rows):
                ms = time * (0.9 + 0.1 * (i % 3))  # the mean of three is the time
                for name in row:
                    if name.endswith("_ms") and row[name]:
                        row[name] = repr(ms if name == "frame_ms" else 0.1 * ms)
            write_log(target / case["csv"], rows)

    edit_json(target / "run.json", edit)
    return target
