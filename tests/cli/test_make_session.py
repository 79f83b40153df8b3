"""make_session.py: what it writes is a valid, smooth session through the keyframes."""

import importlib.util
import json
import math
import os
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

np = pytest.importorskip("numpy")

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "make_session.py"
sys.path.insert(0, str(SCRIPT.parent))  # as where the script itself runs
SCHEMA = json.loads((ROOT / "sessions" / "session.schema.json").read_text(encoding="utf-8"))

KEYS = {
    "name": "walk",
    "viewport": [640, 480],
    "fovy_deg": 50,
    "near": 0.02,
    "far": 100,
    "fps": 20,
    "keyframes": [
        {"t": 1.0, "eye": [0, 1.6, 8], "look_at": [0, 1, 0]},
        {"t": 2.5, "eye": [2, 1.6, 4], "look_at": [0.5, 1, 0]},
        {"t": 3.0, "eye": [2, 2.0, 3], "look_at": [1, 1, -1]},
        {"t": 6.0, "eye": [-2, 1.6, 1], "look_at": [0, 0, -3]},
    ],
}


def load_script():
    spec = importlib.util.spec_from_file_location("make_session", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run(tmp_path, keys, *options):
    source = tmp_path / "a.keyframes.json"
    source.write_text(keys if isinstance(keys, str) else json.dumps(keys), encoding="utf-8")
    target = tmp_path / "a.session.json"
    done = subprocess.run(
        [sys.executable, SCRIPT, source, target, *options], capture_output=True, text=True
    )
    return done, target


def make(tmp_path, keys=KEYS, *options):
    done, target = run(tmp_path, keys, *options)
    assert done.returncode == 0, done.stderr
    session = json.loads(target.read_text(encoding="utf-8"))
    jsonschema.Draft7Validator(SCHEMA).validate(session)
    return session, np.array(session["frames"]), done


def turn(quaternions, vector):
    """The vector turned by each quaternion x y z w."""
    axes, w = quaternions[:, :3], quaternions[:, 3:]
    cross = np.cross(axes, vector)
    return vector + 2 * (w * cross + np.cross(axes, cross))


def test_copies_the_lens(tmp_path):
    session, frames, _ = make(tmp_path)
    assert session["viewport"] == [640, 480]
    assert session["near"] == 0.02 and session["far"] == 100
    assert math.isclose(math.degrees(session["fovy_rad"]), 50)
    assert math.isclose(session["time_step_s"], 0.05)
    assert len(frames) == 101  # 5 s at 20 a second, both ends


def test_passes_through_the_keyframes(tmp_path):
    _, frames, _ = make(tmp_path)
    for key in KEYS["keyframes"]:
        frame = frames[round((key["t"] - 1.0) * 20)]
        assert np.allclose(frame[:3], key["eye"], atol=1e-8)
        ahead = turn(frame[None, 3:], np.array([0, 0, -1.0]))[0]
        way = np.subtract(key["look_at"], key["eye"])
        assert np.allclose(ahead, way / np.linalg.norm(way), atol=1e-7)


@pytest.mark.parametrize("options", [(), ("--sway", "0.02")])
def test_quaternions_are_unit_upright_and_of_one_sign(tmp_path, options):
    _, frames, _ = make(tmp_path, KEYS, *options)
    quaternions = frames[:, 3:]
    assert np.allclose(np.linalg.norm(quaternions, axis=1), 1, atol=1e-8)
    assert (np.sum(quaternions[1:] * quaternions[:-1], axis=1) > 0).all()
    assert np.allclose(turn(quaternions, np.array([1.0, 0, 0]))[:, 1], 0, atol=1e-7)  # no roll
    assert (turn(quaternions, np.array([0, 1.0, 0]))[:, 1] > 0).all()


def test_orientation_covers_every_direction():
    script = load_script()
    rng = np.random.default_rng(3)
    ways = rng.normal(size=(500, 3))
    eyes = np.zeros((500, 3))
    quaternions = script.orient(eyes, ways, np.array([0, 1.0, 0]), np.zeros(500))
    ahead = turn(quaternions, np.array([0, 0, -1.0]))
    assert np.allclose(ahead, ways / np.linalg.norm(ways, axis=1, keepdims=True), atol=1e-12)


def test_spline_has_two_continuous_derivatives_and_keeps_lines_straight():
    script = load_script()
    times = np.array([0.0, 0.5, 2.0, 2.2, 5.0])
    values = np.array([[0.0], [3.0], [-1.0], [0.5], [2.0]])
    step = 1e-3
    for knot in times[1:-1]:
        at = knot + step * np.arange(-3, 4)
        v = script.natural_spline(times, values, at)[:, 0]
        second = np.diff(v, 2) / step**2  # at the 5 inner points; the middle one is the knot
        slope = np.diff(v) / step
        scale = np.abs(second).max() + 1
        assert abs(slope[3] - slope[2]) < 2 * scale * step
        assert abs(second[4] - second[0]) < 0.2 * scale
    for end in (0.0, 5.0 - 2 * step):
        v = script.natural_spline(times, values, end + step * np.arange(3))[:, 0]
        assert abs(np.diff(v, 2)[0] / step**2) < 0.1
    line = script.natural_spline(times, 2 * times[:, None] + 1, np.linspace(0, 5, 50))
    assert np.allclose(line[:, 0], 2 * np.linspace(0, 5, 50) + 1)


def test_reports_the_largest_step(tmp_path):
    keys = dict(KEYS, fps=10)
    keys["keyframes"] = [
        {"t": 0, "eye": [0, 0, 0], "look_at": [0, 0, -1]},
        {"t": 2, "eye": [4, 0, 0], "look_at": [4, 0, -1]},
    ]
    _, _, done = make(tmp_path, keys)
    assert "21 frames, at most 0.000 degrees and 0.2000 units" in done.stderr


def test_sway_is_bounded_and_decided_by_the_seed(tmp_path):
    _, still, _ = make(tmp_path)
    _, first, _ = make(tmp_path, KEYS, "--sway", "0.02")
    _, again, _ = make(tmp_path, KEYS, "--sway", "0.02", "--seed", "1")
    _, other, _ = make(tmp_path, KEYS, "--sway", "0.02", "--seed", "2")
    assert (first == again).all()
    assert (first != other).any()
    offset = np.abs(first[:, :3] - still[:, :3])
    assert 0.002 < offset.max() <= 0.02 + 1e-8


def test_fps_option_wins(tmp_path):
    session, frames, _ = make(tmp_path, KEYS, "--fps", "30")
    assert len(frames) == 151 and math.isclose(session["time_step_s"], 1 / 30)


def change(**changes):
    return json.dumps(dict(KEYS, **changes))


@pytest.mark.parametrize(
    "text, message",
    [
        ("{", "expected JSON"),
        ("[]", "/: expected an object"),
        (change(speed=1), "/speed: unknown key"),
        (change(fovy_deg=180), "/fovy_deg: expected fewer than 180 degrees, found 180"),
        (change(near=-1), "/near: expected a number above 0, found -1"),
        (change(far=0.01), "/far: expected more than /near (0.02), found 0.01"),
        (change(viewport=[640]), "/viewport: expected width and height"),
        (change(up=[0, 0, 0]), "/up: expected a direction"),
        (change(keyframes=KEYS["keyframes"][:1]), "/keyframes: expected 2 or more keyframes"),
        (change(keyframes=[{"t": 0}] * 2), '/keyframes/0: the key "eye" is missing'),
        (
            change(keyframes=KEYS["keyframes"][:2] + KEYS["keyframes"][:1]),
            "/keyframes/2/t: expected more than the one before (2.5), found 1.0",
        ),
        (
            change(keyframes=[dict(k, look_at=k["eye"]) for k in KEYS["keyframes"]]),
            "the eye is at the look-at point",
        ),
    ],
)
def test_bad_input_is_one_line_and_leaves_no_file(tmp_path, text, message):
    done, target = run(tmp_path, text)
    assert done.returncode == 2
    assert message in done.stderr
    assert "a.keyframes.json: " in done.stderr
    assert done.stderr.count("\n") == 1
    assert os.listdir(tmp_path) == ["a.keyframes.json"] and not target.exists()


def test_a_failed_write_leaves_nothing(tmp_path):
    target = tmp_path / "a.session.json"
    target.mkdir()
    done, _ = run(tmp_path, KEYS)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert sorted(os.listdir(tmp_path)) == ["a.keyframes.json", "a.session.json"]


def test_help_names_units():
    done = subprocess.run([sys.executable, SCRIPT, "--help"], capture_output=True, text=True)
    assert done.returncode == 0
    for word in ("world units", "frames per second", "seconds", "default"):
        assert word in done.stdout
