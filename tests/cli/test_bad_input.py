"""Whatever is wrong with what the program is given: one line that says where, the right exit code,
nothing half-written, and nothing of the user's touched."""

import gzip
import json

import pytest
from refusal import BAD_INPUT, NO_GL, complain, hlod, place  # noqa: F401 (fixtures)
from small_scene import write_json, write_ply, write_session

TRIANGLE = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
MESH_SCENE = {
    "version": 1,
    "name": "s",
    "meshes": {"m": {"file": "relief.ply"}},
    "instances": [{"mesh": "m"}],
}
POSE = [0, 0, 3, 0, 0, 0, 1]


# Files that are not there

@pytest.mark.parametrize("name", ["missing.scene.json", "missing.ply", "missing.hlod"])
def test_missing_scene(place, name):
    path = place.folder / name
    if not name.endswith(".hlod"):
        place.refuse(place.build(path), BAD_INPUT, path)
    place.refuse(place.run(scene=path), BAD_INPUT, path)


def test_missing_others(place):
    path = place.folder / "missing.json"
    place.refuse(place.run(session=path), BAD_INPUT, path)
    place.refuse(["info", path], BAD_INPUT, path)
    place.refuse(["table", path], BAD_INPUT, path)
    scene = {**MESH_SCENE, "meshes": {"m": {"file": "missing.ply"}}}
    scene = write_json(place.folder / "s.json", scene)
    place.refuse(place.build(scene), BAD_INPUT, place.folder / "missing.ply")


def test_a_folder_or_a_device_instead_of_a_file(place):
    for path in (place.folder, "/dev/zero"):
        place.refuse(place.build(path), BAD_INPUT, path, "expected a file")
        place.refuse(place.run(session=path), BAD_INPUT, path)
        place.refuse(["info", path], BAD_INPUT, path)


# Scenes and sessions

SCENES = {
    "not JSON": ("{", "expected JSON"),
    "an array": ([], "an object"),
    "another version": ({**MESH_SCENE, "version": 2}, "/version"),
    "no version": ({k: v for k, v in MESH_SCENE.items() if k != "version"}, "version"),
    "an unknown key": ({**MESH_SCENE, "colour": 1}, "/colour"),
    "an unknown key inside": (
        {**MESH_SCENE, "instances": [{"mesh": "m", "turn": 1}]},
        "/instances/0/turn",
    ),
    "a mesh nobody defined": ({**MESH_SCENE, "instances": [{"mesh": "n"}]}, "/instances/0"),
    "a scale of 0": (
        {**MESH_SCENE, "instances": [{"mesh": "m", "scale": 0}]},
        "/instances/0/scale",
    ),
    "no instance": ({**MESH_SCENE, "instances": []}, "/instances"),
    "an unknown generator": (
        {"version": 1, "name": "g", "generator": {"type": "city"}},
        "/generator/type",
    ),
    "too few triangles": (
        {"version": 1, "name": "g", "generator": {"type": "courtyard", "triangles": 10}},
        "/generator/triangles",
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_bad_scene(place, name):
    content, word = SCENES[name]
    path = place.folder / "bad.scene.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    place.refuse(place.run(scene=path), BAD_INPUT, path, word)


SESSIONS = {
    "another version": ({"version": 3}, "/version"),
    "an unknown key": ({"fps": 30}, "/fps"),
    "no frames": ({"frames": []}, "/frames"),
    "a frame too short": ({"frames": [POSE, POSE[:6]]}, "/frames/1"),
    "a frame of texts": ({"frames": [["a"] * 7]}, "/frames/0/0"),
    "a quaternion of length 0": ({"frames": [[0, 0, 3, 0, 0, 0, 0]]}, "/frames/0"),
    "a quaternion of length 2": ({"frames": [POSE, [0, 0, 3, 0, 0, 0, 2]]}, "/frames/1"),
    "a viewport of 0": ({"viewport": [0, 120]}, "/viewport/0"),
    "a viewport of a half": ({"viewport": [160, 0.5]}, "/viewport/1"),
    "a near plane of 0": ({"near": 0}, "/near"),
    "a far plane before the near one": ({"near": 1, "far": 0.5}, "/far"),
    "an angle of pi": ({"fovy_rad": 3.15}, "/fovy_rad"),
}


@pytest.mark.parametrize("name", SESSIONS)
def test_bad_session(place, name):
    changes, word = SESSIONS[name]
    poses = changes.pop("frames", [POSE])
    path = write_session(place.folder / "bad.json", poses, **changes)
    place.refuse(place.run(session=path), BAD_INPUT, path, word)


def test_a_session_is_not_json_of_numbers_that_are_none(place):
    path = place.folder / "bad.json"
    text = place.session.read_text()
    for bad in ("NaN", "Infinity", "1e999"):
        path.write_text(text.replace("0.9", bad))
        place.refuse(place.run(session=path), BAD_INPUT, path)


# Meshes

DAMAGED_PLY = {  # made of the text of a good one
    "truncated": (lambda text: text[: len(text) * 2 // 3], ""),
    "truncated in its header": (lambda text: text[:60], "header"),
    "no PLY": (lambda text: text.replace("ply", "plx", 1), ""),
    "an unknown format": (lambda text: text.replace("ascii", "morse"), "morse"),
    "an unknown type": (lambda text: text.replace("float x", "text x"), "text"),
    "no x": (lambda text: text.replace("float x", "float w"), ""),
    "a count that is no number": (lambda text: text.replace("vertex 25", "vertex many"), "many"),
    "too many vertices": (lambda text: text.replace("vertex 25", "vertex 99999999999"), ""),
    "a negative count": (lambda text: text.replace("face 32", "face -1"), "-1"),
    "a coordinate that is no number": (lambda text: text.replace("-1.000000", "x", 1), "x"),
    "empty": (lambda text: "", "empty"),
    "control characters": (lambda text: "ply\nformat \x1b[31m 1.0\n", ""),
}


@pytest.mark.parametrize("name", DAMAGED_PLY)
def test_damaged_ply(place, name):
    damage, word = DAMAGED_PLY[name]
    good = place.mesh.read_text()
    text = damage(good)
    assert text != good
    path = place.folder / "bad.ply"
    path.write_text(text)
    place.refuse(place.build(path), BAD_INPUT, path, word)


@pytest.mark.parametrize("bad", ["nan", "-inf"])
def test_vertices_that_are_not_finite(place, bad):
    vertices, triangles = [*TRIANGLE, (0, bad, 1)], [(0, 1, 2), (1, 2, 3)]
    path = write_ply(place.folder / "bad.ply", vertices, triangles)
    place.refuse(place.build(path), BAD_INPUT, path, "vertex 3", "expected a number")
    write_ply(path, vertices, triangles, binary=True)
    place.refuse(place.build(path), BAD_INPUT, path, "vertex 3", "finite", bad)


@pytest.mark.parametrize("index", [3, -1, 4294967296])
def test_indices_out_of_range(place, index):
    path = write_ply(place.folder / "bad.ply", TRIANGLE, [(0, 1, 2), (0, 1, index)])
    place.refuse(place.build(path), BAD_INPUT, path)


def test_meshes_of_nothing(place):
    flat = [(0, 0, 0), (1, 1, 1), (2, 2, 2)]
    for vertices, triangles, word in (
        (TRIANGLE, [], "face"),
        ([], [], "face"),
        (flat, [(0, 1, 2)], "area"),
        ([(0, 0, 0)], [(0, 0, 0)], "area"),
    ):
        path = write_ply(place.folder / "relief.ply", vertices, triangles)
        place.refuse(place.build(path), BAD_INPUT, path, word)
        scene = write_json(place.folder / "s.json", MESH_SCENE)
        place.refuse(place.build(scene), BAD_INPUT, path, word)


def test_other_files_that_are_no_meshes(place):
    files = {"a.obj": "v 0 0\n", "a.off": "OFF\n1 1", "a.stl": "x", "a.txt": "x"}
    for name, content in files.items():
        path = place.folder / name
        path.write_text(content)
        place.refuse(place.build(path), BAD_INPUT, path)
    path = place.folder / "a.ply.gz"
    path.write_bytes(gzip.compress(place.mesh.read_bytes())[:-20])
    place.refuse(place.build(path), BAD_INPUT, path, "gzip")


# Hierarchies

def flipped(content, at):
    return content[:at] + bytes([content[at] ^ 0x10]) + content[at + 1 :]


HIERARCHIES = {
    "a byte of the header flipped": lambda h: flipped(h, 40),
    "a byte of the geometry flipped": lambda h: flipped(h, 400),
    "a byte of the nodes flipped": lambda h: flipped(h, len(h) - 500),
    "the last byte flipped": lambda h: flipped(h, len(h) - 1),
    "truncated by a byte": lambda h: h[:-1],
    "truncated to half": lambda h: h[: len(h) // 2],
    "truncated in its header": lambda h: h[:30],
    "a byte too long": lambda h: h + b"x",
    "another version": lambda h: flipped(h, 8),
    "no hierarchy": lambda h: b"some notes of mine\n" * 20,
    "empty": lambda h: b"",
}


@pytest.mark.parametrize("name", HIERARCHIES)
def test_damaged_hierarchy(place, hlod, name):
    place.hlod.write_bytes(HIERARCHIES[name](hlod))
    place.refuse(place.run(), BAD_INPUT, place.hlod)
    error = place.refuse(["info", "--json", "--check", place.hlod], BAD_INPUT, place.hlod)
    assert "version" in error or "version" not in name


def test_every_byte_of_a_hierarchy_is_guarded(place, hlod):
    """A sample of flips all over the file: never a crash, never accepted."""
    for at in [*range(0, 88, 11), *range(88, len(hlod), len(hlod) // 6)]:
        place.hlod.write_bytes(flipped(hlod, at))
        complain(place.hlodbench("info", "--check", place.hlod), BAD_INPUT, place.hlod)


# Options

OPTIONS = {
    **{
        f"{name} {value}": ([name, value], name)
        for name, values in {
            "--s": ["-0.1", "1.1", "nan", "x"],
            "--t": ["2", "nan"],
            "--tau": ["0", "-1", "nan", "inf", "1px"],
            "--exponent": ["0.5"],
            "--repetitions": ["0", "1.5"],
            "--warm-up": ["-1", "4"],  # the session has 4 frames
            "--frames-in-flight": ["-1"],
            "--latency": ["slow", "draws:", "draws:-1", "frames:1e3", "gl:1"],
            "--context": ["glx"],
            "--size": ["640", "640x", "0x0", "-1x5", "640x480x1", "99999x5"],
            "--images": ["1,4", "first", "-1"],
            "--image-format": ["jpg"],
            "--overlay": ["magic"],
            "--stale-children": ["maybe"],
            "--zero-pixels": ["maybe"],
            "--simp": ["first"],
            "--max-triangles": ["0", "-5", "100"],  # 100: the scene is built
            "--seed": ["-1"],
            "--gpu-memory": ["0", "x", "-5M", "1.5G", "256MB", "99999999999G", "1"],
        }.items()
        for value in values
    },
    "unknown strategy": (["--strategy", "bool,magic"], "magic"),
    "strategy twice": (["--strategy", "bool,coh-b,bool"], "twice"),
    "unknown option": (["--fast"], "--fast"),
    "stray argument": (["--gl-debug", "stray"], "stray"),
}


@pytest.mark.parametrize("name", OPTIONS)
def test_bad_option(place, name):
    arguments, word = OPTIONS[name]
    place.refuse(place.run(*arguments), BAD_INPUT, word)


def test_an_unknown_name_is_answered_with_those_known(place):
    place.refuse(place.run("--strategy", "magic"), BAD_INPUT, "bool, sw-b, simp-b, coh-b")
    place.refuse(place.run("--context", "magic"), BAD_INPUT, "auto, egl")
    place.refuse(place.run("--latency", "magic"), BAD_INPUT, "gl, frames:N or draws:N")
    place.refuse(place.run("--simp", "magic"), BAD_INPUT, "last, mean")
    place.refuse(place.run("--overlay", "magic"), BAD_INPUT, "bias, level, node, rarn")
    place.refuse([*place.build(place.mesh), "--simplifier", "x"], BAD_INPUT, "openmesh")
    place.refuse(["table", place.folder, "--format", "html"], BAD_INPUT, "markdown", "latex", "csv")


def test_commands_without_what_they_need(place):
    place.refuse([], BAD_INPUT)
    place.refuse(["paint"], BAD_INPUT)
    for command in ("build", "info", "run", "table"):
        place.refuse([command], BAD_INPUT)


def test_table_of_what_is_no_run(place):
    place.refuse(["table", place.folder], BAD_INPUT, place.folder, "run.json")
    for content in ("{", "[]", '{"schema_version": "2.0.0"}'):
        (place.folder / "run.json").write_text(content)
        place.refuse(["table", place.folder], BAD_INPUT, place.folder / "run.json")


# No OpenGL

def test_no_usable_gl(place):
    nothing = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"}
    arguments = place.run("--context", "egl")
    place.refuse(arguments, NO_GL, "egl", "libegl-mesa0", "libgl1-mesa-dri", env=nothing)
    arguments = ["info", place.hlod, "--depth-complexity", place.session, "--context", "egl"]
    result = place.hlodbench(*arguments, env=nothing)
    assert result.returncode == NO_GL
    assert result.stderr.count("\n") == 1 and "libegl1" in result.stderr


def test_bad_input_is_found_without_gl(place):
    """Mistakes in the options are told first, whatever the machine lacks."""
    nothing = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"}
    arguments = place.run("--context", "egl", "--strategy", "magic")
    place.refuse(arguments, BAD_INPUT, "magic", env=nothing)
