"""`hlodbench run --images`: the pictures, what is said of them, and the table of their quality."""

import csv
import io
import json
import math

import jsonschema
import numpy as np
import pytest
from PIL import Image
from small_scene import past_the_walls, write_session, write_walls

STRATEGIES = ("bool", "sw-b", "simp-b", "coh-b")
BT601 = np.array([[0.299, 0.587, 0.114],
                  [-0.299 / 1.772, -0.587 / 1.772, 0.886 / 1.772],
                  [0.701 / 1.402, -0.587 / 1.402, -0.114 / 1.402]])


@pytest.fixture(scope="module")
def world(hlodbench, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pictures")
    hlod = folder / "walls.hlod"
    scene = write_walls(folder)
    assert hlodbench("build", scene, "-o", hlod, "--max-triangles", "100").returncode == 0
    session = write_session(folder / "path.session.json", past_the_walls(24))

    def run(out, *options):
        arguments = ["--scene", hlod, "--session", session, "--out", out, "--latency", "draws:4"]
        result = hlodbench("run", *arguments, *options)
        assert result.returncode == 0, result.stderr
        return out

    return run


@pytest.fixture(scope="module")
def full_run(world, tmp_path_factory):
    return world(tmp_path_factory.mktemp("runs") / "full", "--images", "6",
                 "--overlay", "bias,level,node,rarn")


def load(out):
    return json.loads((out / "images" / "images.json").read_text(encoding="utf-8"))


def read(path):
    with Image.open(path) as picture:
        assert picture.mode == "RGB"
        return np.asarray(picture).astype(float)


def psnr(a, b):
    """Of Y, Cb and Cr by the definition, None where the planes are identical."""
    planes = (a - b) @ BT601.T
    errors = (planes**2).mean(axis=(0, 1))
    return [10 * math.log10(255**2 / e) if e > 1e-9 else None for e in errors]


def test_what_is_written_is_what_images_json_says(full_run, root):
    images = load(full_run)
    schema = json.loads((root / "results" / "images.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    jsonschema.validate(images, schema)
    assert images["selection"] == "random" and images["seed"] == 1 and images["complete"]
    frames = images["frames"]
    assert len(frames) == 6 and frames == sorted(set(frames)) and min(frames) >= 5
    named = {entry["file"] for entry in images["full"]} | {"images.json"}
    for strategy in images["strategies"]:
        assert [f["frame"] for f in strategy["frames"]] == frames
        for entry in strategy["frames"]:
            assert set(entry["overlays"]) == {"bias", "level", "node", "rarn"}
            named |= {entry["file"], *entry["overlays"].values()}
    assert [s["strategy"] for s in images["strategies"]] == list(STRATEGIES)
    assert {p.name for p in (full_run / "images").iterdir()} == named
    for name in named - {"images.json"}:
        assert read(full_run / "images" / name).shape == (120, 160, 3)


def test_psnr_is_that_of_the_pictures(full_run):
    images = load(full_run)
    folder = full_run / "images"
    compared = 0
    for strategy in images["strategies"]:
        for entry in strategy["frames"]:
            picture = read(folder / entry["file"])
            for member, other in (("vs_reference", "bool"), ("vs_full", "full")):
                if entry[member] is None:
                    assert strategy["strategy"] == "bool" and member == "vs_reference"
                    continue
                expected = psnr(picture, read(folder / f"{other}.{entry['frame']:05}.png"))
                for name, value in zip(("y", "cb", "cr"), expected):
                    assert (entry[member][name] is None) == (value is None)
                    if value is not None:
                        assert entry[member][name] == pytest.approx(value, abs=0.02)
                        compared += 1
    assert compared > 30


def test_summaries_are_those_of_the_frames(full_run):
    for strategy in load(full_run)["strategies"]:
        summary = strategy["summary"]
        for member in ("vs_reference", "vs_full"):
            if summary[member] is None:
                assert strategy["strategy"] == "bool" and member == "vs_reference"
                continue
            for name in ("y", "cb", "cr"):
                values = [f[member][name] for f in strategy["frames"]]
                finite = [v for v in values if v is not None]
                found = summary[member][name]
                assert found["count"] == len(finite)
                assert found["identical"] == len(values) - len(finite)
                if finite:
                    assert found["mean"] == pytest.approx(np.mean(finite))
                if len(finite) > 1:
                    assert found["stddev"] == pytest.approx(np.std(finite, ddof=1))
        assert summary["crack_pixels"] == sum(f["crack_pixels"] for f in strategy["frames"])


def test_pictures_are_of_the_frames_that_were_measured(full_run):
    """RARN of the pictures is that of the frame log, and the table's picture columns agree."""
    images = load(full_run)
    for strategy in images["strategies"]:
        with open(full_run / f"{strategy['strategy']}.0.csv", encoding="utf-8") as file:
            log = list(csv.DictReader(file))
        for entry in strategy["frames"]:
            assert entry["rarn_nodes"] == int(float(log[entry["frame"]]["rarn"]))


def test_table_shows_the_quality(hlodbench, full_run):
    images = {s["strategy"]: s["summary"] for s in load(full_run)["strategies"]}
    rows = list(csv.DictReader(io.StringIO(
        hlodbench("table", full_run, "--format", "csv").stdout)))
    assert [row["strategy"] for row in rows] == list(STRATEGIES)
    for row in rows:
        summary = images[row["strategy"]]
        assert int(row["pictures"]) == 6
        assert float(row["ours_psnr_full_y"]) == pytest.approx(summary["vs_full"]["y"]["mean"])
        assert int(row["ours_crack_pixels"]) == summary["crack_pixels"]
        if row["strategy"] == "bool":
            assert row["ours_psnr_y"] == ""
        elif summary["vs_reference"]["y"]["mean"] is not None:
            assert float(row["ours_psnr_y"]) == pytest.approx(
                summary["vs_reference"]["y"]["mean"])
    markdown = hlodbench("table", full_run).stdout
    assert "PSNR" in markdown and "42.84 ± 3.22" in markdown  # the paper's beside ours
    latex = hlodbench("table", full_run, "--format", "latex").stdout
    assert latex.count(r"\begin{tabular}") == 2 and r"42.84 $\pm$ 3.22" in latex


def test_without_pictures(hlodbench, world, tmp_path):
    out = world(tmp_path / "out", "--images", "none", "--strategy", "bool")
    assert not (out / "images").exists()
    markdown = hlodbench("table", out)
    assert markdown.returncode == 0 and "PSNR" not in markdown.stdout


def test_without_bool_there_is_no_reference(world, tmp_path):
    images = load(world(tmp_path / "out", "--images", "7,", "--strategy", "coh-b"))
    assert images["reference"] is None and images["selection"] == "list"
    assert images["frames"] == [7]
    (entry,) = images["strategies"][0]["frames"]
    assert entry["vs_reference"] is None and entry["vs_full"]["y"] > 20


def test_the_same_seed_gives_the_same_pictures(full_run, world, tmp_path):
    again = world(tmp_path / "out", "--images", "6")
    assert load(again)["frames"] == load(full_run)["frames"]
    for entry in load(again)["full"]:
        name = entry["file"]
        assert (again / "images" / name).read_bytes() == (full_run / "images" / name).read_bytes()
    other = world(tmp_path / "other", "--images", "6", "--seed", "2", "--strategy", "bool")
    assert load(other)["frames"] != load(full_run)["frames"]


def test_exr_holds_what_png_holds(world, tmp_path):
    options = ("--images", "8,", "--strategy", "bool")
    exr = world(tmp_path / "exr", *options, "--image-format", "exr") / "images"
    assert {p.suffix for p in exr.iterdir()} == {".exr", ".json"}
    for path in exr.glob("*.exr"):
        assert path.read_bytes()[:4] == b"\x76\x2f\x31\x01"


def test_overlay_of_the_bias_shows_modulation_where_there_is_some(full_run):
    """Bool is not modulated: all blue. SW(B) is, behind the first wall: towards magenta and red."""
    for strategy in load(full_run)["strategies"]:
        modulated = 0
        for entry in strategy["frames"]:
            r, g, b = np.moveaxis(read(full_run / "images" / entry["overlays"]["bias"]), 2, 0)
            modulated += int(((r > 0.5 * b) & (r > 1.5 * g)).sum())
        if strategy["strategy"] == "bool":
            assert modulated == 0
        elif strategy["strategy"] == "sw-b":
            assert modulated > 20
