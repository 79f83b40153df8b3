"""Every scene, keyframe and session file that is shipped is what its schema says."""

import copy
import json
from pathlib import Path

import jsonschema
import pytest

SESSIONS = Path(__file__).resolve().parents[2] / "sessions"


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def validator(kind):
    return jsonschema.Draft7Validator(read(SESSIONS / f"{kind}.schema.json"))


def kind_of(path):
    middle = path.name.split(".")[-2]
    return middle if middle in ("scene", "keyframes", "schema") else "session"


SHIPPED = sorted(p for p in SESSIONS.glob("*.json") if kind_of(p) != "schema")


@pytest.mark.parametrize("kind", ["scene", "session", "keyframes"])
def test_schema_is_a_schema(kind):
    jsonschema.Draft7Validator.check_schema(read(SESSIONS / f"{kind}.schema.json"))


def test_something_is_shipped():
    assert {"courtyard.scene.json", "scene1.scene.json", "scene2.scene.json"} <= {
        path.name for path in SHIPPED
    }


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_shipped_file_is_valid_and_an_unknown_key_is_not(path):
    check = validator(kind_of(path))
    content = read(path)
    check.validate(content)
    content["unknown"] = 1
    assert not check.is_valid(content)


def objects_in(value, path=()):
    if isinstance(value, dict):
        yield path
        for key, child in value.items():
            yield from objects_in(child, path + (key,))
    elif isinstance(value, list):
        for index, child in enumerate(value):
            yield from objects_in(child, path + (index,))


def changed(content, path, change):
    content = copy.deepcopy(content)
    place = content
    for step in path:
        place = place[step]
    change(place)
    return content


SCENE = {
    "version": 1,
    "name": "a",
    "up": "z",
    "meshes": {"m": {"file": "m.ply"}},
    "instances": [
        {
            "mesh": "m",
            "name": "first",
            "color": [0, 0.5, 1],
            "normalize": True,
            "scale": [1, 2, 3],
            "rotate": {"axis": [0, 1, 0], "degrees": -30},
            "translate": [1, 2, 3],
        },
        {"mesh": "m", "matrix": list(range(16))},
    ],
}
COURTYARD = {"version": 1, "name": "c", "generator": {"type": "courtyard", "seed": 0}}
SESSION = {
    "version": 1,
    "name": "s",
    "viewport": [640, 480],
    "fovy_rad": 0.87,
    "near": 0.02,
    "far": 100,
    "frames": [[0, 0, 0, 0, 0, 0, 1]],
}
RECORDED = {
    **SESSION,
    "scene": {"name": "bunny", "hash": "0123456789abcdef"},
    "up": [0, 1, 0],
    "time_step_s": 0.02,
    "made": "by hand",
}
KEYFRAMES = {
    "name": "k",
    "viewport": [640, 480],
    "fovy_deg": 50,
    "near": 0.1,
    "far": 10,
    "keyframes": [
        {"t": 0, "eye": [0, 0, 0], "look_at": [0, 0, 1]},
        {"t": 1, "eye": [0, 0, 0], "look_at": [0, 0, 1]},
    ],
}
EXAMPLES = [("scene", SCENE), ("scene", COURTYARD), ("session", SESSION), ("keyframes", KEYFRAMES)]
OPTIONAL = [("session", RECORDED)]


@pytest.mark.parametrize("kind, content", EXAMPLES + OPTIONAL)
def test_no_object_takes_an_unknown_key(kind, content):
    check = validator(kind)
    check.validate(content)
    for path in objects_in(content):
        if path == ("meshes",):  # its keys are the user's
            continue
        assert not check.is_valid(changed(content, path, lambda o: o.update(unknown=1))), path


@pytest.mark.parametrize(
    "kind, content, path, key, value",
    [
        ("scene", SCENE, (), "version", 2),
        ("scene", SCENE, (), "up", "x"),
        ("scene", SCENE, (), "instances", []),
        ("scene", SCENE, (), "meshes", {}),
        ("scene", SCENE, (), "generator", {"type": "courtyard"}),
        ("scene", SCENE, ("instances", 0), "scale", -1),
        ("scene", SCENE, ("instances", 0), "scale", [1, 0, 1]),
        ("scene", SCENE, ("instances", 0), "color", [0, 0, 2]),
        ("scene", SCENE, ("instances", 0), "matrix", list(range(16))),
        ("scene", SCENE, ("instances", 1), "translate", [0, 0, 0]),
        ("scene", COURTYARD, ("generator",), "type", "city"),
        ("scene", COURTYARD, ("generator",), "triangles", 49999),
        ("session", SESSION, (), "frames", []),
        ("session", SESSION, (), "frames", [[0, 0, 0, 0, 0, 1]]),
        ("session", SESSION, (), "viewport", [640, 0]),
        ("session", SESSION, (), "viewport", [16385, 480]),
        ("session", SESSION, (), "fovy_rad", 3.2),
        ("session", SESSION, (), "near", 0),
        ("session", RECORDED, (), "scene", "bunny"),
        ("session", RECORDED, (), "scene", {"name": "bunny"}),
        ("session", RECORDED, ("scene",), "name", ""),
        ("session", RECORDED, ("scene",), "hash", "0123456789abcde"),
        ("session", RECORDED, ("scene",), "hash", "0123456789ABCDEF"),
        ("session", RECORDED, (), "time_step_s", 0),
        ("session", RECORDED, (), "made", ""),
    ],
)
def test_a_wrong_value_is_refused(kind, content, path, key, value):
    assert not validator(kind).is_valid(changed(content, path, lambda o: o.update({key: value})))


@pytest.mark.parametrize("kind, content", [e for e in EXAMPLES if e[0] != "scene"])
def test_required_keys_are_required(kind, content):
    for key in content:
        assert not validator(kind).is_valid(changed(content, (), lambda o, k=key: o.pop(k))), key
