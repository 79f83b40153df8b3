"""latency.py: curves are those of the sweep's table, and the driver's latency is read off them."""

import csv
import itertools
import json
import re
import shutil

import pytest

np = pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("yaml", reason="needs python3-yaml")
pytest.importorskip("matplotlib", reason="needs python3-matplotlib")
pytest.importorskip("PIL", reason="needs python3-pil")

from figure_latency import draw_latency, frame_place  # noqa: E402
from figure_style import Skipped  # noqa: E402
from latency_data import (describe_equivalent, find_equivalent, place,  # noqa: E402
                          read_curves)
from test_sweep_jobs import Sweep  # noqa: E402

DRAWS, FRAMES = (0, 1, 10, 100), (0, 1)
STRATEGIES = ("bool", "coh-b", "mine", "another")


def write_folder(folder, driver=True, strategies=STRATEGIES):
    """A sweep's folder in which RARN of a strategy is its number + log10(1 + draws), and DN 100;
    the driver's RARN is that of 10 draws, in the spread from 1 to 100."""
    head = ("cell", "strategy", "label", "scene", "session", "size", "tau", "s", "t", "latency",
            "seed", "repetitions", "timing", "dn", "rarn")
    rows = []
    for latency in [f"draws:{n}" for n in DRAWS] + [f"frames:{n}" for n in FRAMES]:
        unit, count = latency.split(":")
        for i, strategy in enumerate(strategies):
            rarn = i + float(place(float(count))) if unit == "draws" else i + 4.0
            rows.append({"cell": latency.replace(":", ""), "strategy": strategy, "repetitions": 1,
                         "latency": latency, "timing": "false", "dn": 100, "rarn": repr(rarn)})
    for i, strategy in enumerate(strategies if driver else ()):
        rows.append({"cell": "c-gl", "strategy": strategy, "repetitions": 3, "latency": "gl",
                     "timing": "true", "dn": 100, "rarn": repr(i + float(place(10)))})
    fixed = {"scene": "yard", "session": "walk", "size": "64x48", "tau": "1", "s": "1", "t": "0.5",
             "seed": "1"}
    folder.mkdir(parents=True)
    with open(folder / "sweep.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, head)
        writer.writeheader()
        writer.writerows({**fixed, "label": row["strategy"].title(), **row} for row in rows)
    if not driver:
        return
    (folder / "cells" / "c-gl").mkdir(parents=True)
    cases = [{"strategy": s, "repetition": r, "csv": None, "summary": {"counters": {
        "rarn": {"mean": i + float(place(n)), "count": 9}, "dn": {"mean": 100, "count": 9}}}}
        for r, n in enumerate((1, 10, 100)) for i, s in enumerate(strategies)]
    (folder / "cells" / "c-gl" / "run.json").write_text(json.dumps({
        "schema_version": "1.0.0", "scene": {"name": "yard"}, "session": {"frames": 9},
        "context": {}, "cases": cases}), encoding="utf-8")


def line(axes, gid):
    (found,) = [item for item in [*axes.get_lines(), *axes.patches] if item.get_gid() == gid]
    return found


def test_lines_have_the_numbers_of_the_table(tmp_path):
    write_folder(tmp_path / "sweep")
    (curves,) = read_curves(tmp_path / "sweep")
    figure = draw_latency(curves, "title")
    dn, _, rarn, d, *_ = figure.axes
    for i, strategy in enumerate(STRATEGIES):
        x, y = line(rarn, f"rarn.{strategy}.draws").get_data()
        assert x.tolist() == place(DRAWS).tolist() and x[0] == 0
        assert y == pytest.approx([i + place(n) for n in DRAWS])
        x, y = line(rarn, f"rarn.{strategy}.frames").get_data()
        assert x == pytest.approx([frame_place(curves, n) for n in FRAMES]) and min(x) > place(100)
        assert y == pytest.approx([i + 4] * 2)
        assert line(rarn, f"rarn.{strategy}.gl").get_ydata() == pytest.approx([i + place(10)] * 2)
        band = line(rarn, f"rarn.{strategy}.gl-spread").get_xy()[:, 1]
        assert (min(band), max(band)) == pytest.approx((i + place(1), i + place(100)))
        assert line(dn, f"dn.{strategy}.draws").get_ydata().tolist() == [100] * 4
    assert [t.get_text() for t in d.texts] == ["no values"]
    for row in [row for key, rows in curves.fixed.items() if key[0] == "mine" for _, row in rows]:
        row["d"] = row["dn"]  # delays every node: no line, and no latency told
    d = draw_latency(curves, "title").axes[3]
    assert "d.mine.draws" not in [item.get_gid() for item in d.get_lines()]
    looks = {(h.get_color(), str(h.get_linestyle()), h.get_marker())
             for h in rarn.get_lines() if (h.get_gid() or "").endswith(".draws")}
    assert len(looks) == len(STRATEGIES)


def test_equivalent_latency_is_read_where_the_lines_cross(tmp_path):
    write_folder(tmp_path / "sweep")
    (curves,) = read_curves(tmp_path / "sweep")
    assert describe_equivalent(curves, "coh-b", "rarn") == "10 draws"
    assert describe_equivalent(curves, "coh-b", "dn") is None  # flat: nothing can be told
    assert describe_equivalent(curves, "coh-b", "d") is None
    curves.driver["coh-b"].means["rarn"] = 1 + float(place(30))
    assert describe_equivalent(curves, "coh-b", "rarn") == "about 30 draws (between 10 and 100)"
    curves.driver["coh-b"].means["rarn"] = 9.0
    assert describe_equivalent(curves, "coh-b", "rarn") == "none: 9 is above 1 to 3.004"


@pytest.mark.parametrize("values, target, expected", [
    ((0, 1, 2, 3), 1, [1]), ((0, 1, 1, 3), 1, [1]), ((3, 1, 3, 1), 1, [1, 100]),
    ((0, 2, 0, 2), 3, []), ((1, 1, 2, 2), 2, [10]), ((5,), 5, [0])])
def test_crossings(values, target, expected):
    latencies = np.array(DRAWS[: len(values)], dtype=float)
    found = find_equivalent(latencies, np.array(values, dtype=float), target)
    assert [at for _, at, _ in found] == expected


def test_one_latency_is_no_curve(tmp_path):
    write_folder(tmp_path / "sweep")
    (curves,) = read_curves(tmp_path / "sweep")
    for key in list(curves.fixed):
        curves.fixed[key] = curves.fixed[key][:1] if key[1] == "draws" else []
    with pytest.raises(Skipped, match="expected two or more fixed latencies"):
        draw_latency(curves, "title")


SWEEP = """
scene: one.scene.json
session: walk.json
strategy: [bool, coh-b, mine]
images: 2
blocks:
  - {latency: ["draws:0", "draws:3", "frames:1"], timing: false}
  - {latency: gl, repetitions: 2}
"""


@pytest.mark.skipif(not shutil.which("snakemake"), reason="needs snakemake")
def test_command_makes_figure_tables_and_captions_twice_alike(tmp_path, run_script):
    sweep = Sweep(tmp_path)
    (tmp_path / "x.yaml").write_text(SWEEP, encoding="utf-8")

    def run(out, *arguments):
        return run_script("latency.py", tmp_path / "x.yaml", "--out", tmp_path / out, "--dpi", 60,
                          "--hlodbench", sweep.program, "--cache", tmp_path / "cache", *arguments,
                          env=sweep.environment)
    done = run("made")
    assert done.returncode == 0, done.stderr
    names = ["latency.csv", "latency.md", "latency_gl.csv", "latency_one.pdf", "latency_one.png"]
    files = {name: (tmp_path / "made" / name).read_bytes() for name in names}
    assert all(files.values()) and files["latency_one.pdf"].startswith(b"%PDF")
    rows = list(csv.DictReader(files["latency.csv"].decode().splitlines()))
    assert [(r["strategy"], r["latency"]) for r in rows] == list(itertools.product(
        ("bool", "coh-b", "mine"), ("draws:0", "draws:3", "frames:1")))
    driver = list(csv.DictReader(files["latency_gl.csv"].decode().splitlines()))
    for row in driver:
        if row["low"]:
            assert float(row["low"]) <= float(row["mean"]) <= float(row["high"])
    assert {r["repetitions"] for r in driver if r["value"] == "rarn"} == {"2"}
    caption = files["latency.md"].decode()
    assert re.search(r"mean of 2 repetitions", caption) and "| Mine |" in caption
    before = sweep.log.read_text()
    assert run("made").returncode == 0 and sweep.log.read_text() == before
    for name in names:
        assert (tmp_path / "made" / name).read_bytes() == files[name], name


def test_wrong_usage(tmp_path, run_script):
    for arguments, said in ((["--dpi", "1"], "expected 50 to 1200"), (["--cores", "0"], "--cores"),
                            (["--nonsense"], "--nonsense")):
        done = run_script("latency.py", tmp_path / "none.yaml", "--out", tmp_path / "o", *arguments)
        assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr
