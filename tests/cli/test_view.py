"""`hlodbench view`: what it opens, recording a session by hand, and replaying it."""

import json
import math

import jsonschema
import pytest
from small_scene import write_relief, write_walls
from view_window import (  # noqa: F401 (fixtures)
    PANEL,
    SIZE,
    count_differing,
    read_picture,
    read_session,
    record,
    relief,
    screen,
    start,
)

BOX = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
          (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def write_obj(path):
    lines = [f"v {x} {y} {z}" for x, y, z in BOX]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")


def write_off(path):
    lines = ["OFF", f"{len(BOX)} {len(FACES)} 0", *(f"{x} {y} {z}" for x, y, z in BOX)]
    lines += [f"3 {a} {b} {c}" for a, b, c in FACES]
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")


def write_stl(path):
    lines = ["solid box"]
    for face in FACES:
        corners = ["  vertex {} {} {}".format(*BOX[i]) for i in face]
        lines += ["facet normal 0 0 0", " outer loop", *corners, " endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid box", ""]), encoding="utf-8")


WRITERS = {
    "box.obj": write_obj,
    "box.off": write_off,
    "box.stl": write_stl,
    "relief.ply": lambda path: write_relief(path, side=6),
}


@pytest.mark.parametrize("name", WRITERS)
def test_a_mesh_is_opened_directly_and_its_hierarchy_kept(start, tmp_path, name):
    mesh = tmp_path / name
    WRITERS[name](mesh)
    picture = tmp_path / "window.png"
    view = start(mesh, "--frames", "5", "--picture", picture)
    assert view.wait_for_end() == 0, view.errors()
    assert f"wrote {picture}" in view.errors().splitlines()
    shown = read_picture(picture)
    assert shown.shape == (SIZE[1], PANEL + SIZE[0], 3)
    scene = shown[:, PANEL:]
    assert count_differing(scene, scene[:1, :1] + 0 * scene) > 2000, "no mesh on the background"

    (kept,) = (tmp_path / "cache").glob("*.hlod")
    before = kept.stat().st_mtime_ns
    again = start(mesh, "--frames", "5")
    assert again.wait_for_end() == 0, again.errors()
    assert list((tmp_path / "cache").glob("*.hlod")) == [kept]
    assert kept.stat().st_mtime_ns == before
    assert "building" in view.errors() and "building" not in again.errors()


def test_a_scene_and_a_hierarchy_are_opened(start, relief, tmp_path):
    scene = start(write_walls(tmp_path), "--frames", "3")
    assert scene.wait_for_end() == 0, scene.errors()
    assert "showing walls: 9600 triangles" in scene.errors()
    built = start(relief, "--frames", "3")
    assert built.wait_for_end() == 0, built.errors()
    assert "showing relief: 3200 triangles" in built.errors()
    assert "building" not in built.errors()


def read_frames(trace):
    events = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    return [[*e["position"], *e["orientation"]] for e in events if e["type"] == "frame"]


def test_a_session_recorded_by_hand_is_replayed(hlodbench, start, root, tmp_path):
    view = start(write_relief(tmp_path / "relief.ply"), "--max-triangles", "200").open()
    before = view.look()
    view.drag((12, 0), (12, 0), (12, 0), (12, 0), (12, 0))
    assert count_differing(before, view.look()) > 3000

    file = tmp_path / "relief.session.json"
    journal = tmp_path / "relief.session.json.recording"
    record(view, journal, 60)
    view.press("ctrl+s")
    written = view.wait_for_line(rf"wrote {file}: (\d+) frames")
    assert not journal.exists()
    assert view.quit() == 0, view.errors()
    assert view.errors().count(f"wrote {file}") == 1

    session = read_session(file)
    schema = read_session(root / "sessions" / "session.schema.json")
    jsonschema.validate(session, schema)
    frames = session["frames"]
    assert len(frames) == int(written.group(1)) >= 60
    assert session["scene"]["name"] == "relief"
    assert session["time_step_s"] == pytest.approx(1 / 60)
    assert session["viewport"] == list(SIZE)
    assert session["fovy_rad"] == pytest.approx(math.radians(50))
    assert frames[0] != frames[-1] and len({tuple(f) for f in frames}) > 10
    # it starts 20 degrees to the side; a drag over the picture's height is half a turn
    yaw, pitch = math.radians(20 - 180 * 60 / SIZE[1]), math.radians(-20)
    (sy, cy), (sp, cp) = ((math.sin(a / 2), math.cos(a / 2)) for a in (yaw, pitch))
    turned = [cy * sp, sy * cp, -sy * sp, cy * cp]
    assert frames[0][3:] == pytest.approx(turned, abs=1e-9)

    (hlod,) = (tmp_path / "cache").glob("*.hlod")
    fixed = ["--strategy", "coh-b", "--warm-up", "0", "--repetitions", "1"]
    outputs = ["--out", tmp_path / "run", "--trace", tmp_path / "trace.jsonl"]
    run = hlodbench("run", "--scene", hlod, "--session", file, *outputs, *fixed)
    assert run.returncode == 0, run.stderr
    assert "recorded in scene" not in run.stderr
    (trace,) = tmp_path.glob("trace*.jsonl")
    shown = read_frames(trace)  # with 9 digits
    assert shown == [[float(f"{x:.9g}") for x in frame] for frame in frames]
