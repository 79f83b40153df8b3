#!/usr/bin/env python3
"""Makes a camera session (sessions/session.schema.json) from a few keyframes.

Eye and look-at point each run along a natural cubic spline through the keyframes: twice
continuously differentiable in time, so the camera's acceleration has no jumps. The path is sampled
at a fixed rate; the orientation of each frame comes from the look-at point and the up direction.
"""

import argparse
import json
import math
import os
import sys

from atomic_file import write_text_atomically

try:
    import numpy as np
except ImportError:
    sys.exit("make_session.py: needs numpy (Debian: python3-numpy)")

EPILOG = """\
The keyframe file is JSON; sessions/keyframes.schema.json describes it:
  {"name": "walk", "viewport": [640, 480], "fovy_deg": 50, "near": 0.02, "far": 100,
   "fps": 30, "up": [0, 1, 0],
   "keyframes": [{"t": 0.0, "eye": [0, 1.6, 8], "look_at": [0, 1, 0]},
                 {"t": 4.0, "eye": [2, 1.6, 4], "look_at": [0, 1, 0]}, ...]}
t is in seconds and rises; eye and look_at are in world units; fps defaults to 30, up to [0, 1, 0].
Both ends of the path, t of the first and of the last keyframe, are frames where fps allows.
"""

KEYS = {"name", "viewport", "fovy_deg", "near", "far", "fps", "up", "keyframes"}
REQUIRED = KEYS - {"fps", "up"}
KEYFRAME_KEYS = {"t", "eye", "look_at"}
DIGITS = 9  # behind the point: a quaternion's length then stays 1 within 1e-8
SWAY_PERIODS_S = (0.9, 1.7, 3.1)  # of a person standing and walking slowly


class BadInput(Exception):
    """A wrong input file; the message is one line."""


def natural_spline(times, values, at):
    """Values at the times `at` of the natural cubic spline through (times, values).

    times: (n,), rising, n >= 2; values: (n, d); at: (m,) within times. Returns (m, d).
    """
    steps = np.diff(times)
    count = len(times)
    # Unknowns: the second derivatives; zero at both ends.
    matrix = np.eye(count)
    right = np.zeros_like(values)
    for i in range(1, count - 1):
        matrix[i, i - 1 : i + 2] = steps[i - 1], 2 * (steps[i - 1] + steps[i]), steps[i]
        slopes = (values[i + 1] - values[i]) / steps[i] - (values[i] - values[i - 1]) / steps[i - 1]
        right[i] = 6 * slopes
    bends = np.linalg.solve(matrix, right)

    piece = np.clip(np.searchsorted(times, at, side="right") - 1, 0, count - 2)
    step = steps[piece][:, None]
    after = (at - times[piece])[:, None]
    before = step - after
    return (
        bends[piece] * before**3 / (6 * step)
        + bends[piece + 1] * after**3 / (6 * step)
        + (values[piece] / step - bends[piece] * step / 6) * before
        + (values[piece + 1] / step - bends[piece + 1] * step / 6) * after
    )


def compute_sway(times, amplitude, seed):
    """A smooth wobble of the given amplitude (world units): (m, 3), 0 on average."""
    rng = np.random.default_rng(seed)
    sway = np.zeros((len(times), 3))
    for period in SWAY_PERIODS_S:
        phases = rng.uniform(0, 2 * math.pi, 3)
        sway += np.sin(2 * math.pi * times[:, None] / period + phases)
    return amplitude * sway / len(SWAY_PERIODS_S)


def look_rotation(forward, up):
    """The camera-to-world rotation matrix that looks along `forward` (unit), or None when up is
    (nearly) parallel to it."""
    right = np.cross(forward, up)
    length = np.linalg.norm(right)
    if length < 1e-6 * np.linalg.norm(up):
        return None
    right = right / length
    return np.stack([right, np.cross(right, forward), -forward], axis=1)


def quaternion_of(rotation):
    """The unit quaternion x y z w of a rotation matrix, by its largest component."""
    trace = np.trace(rotation)
    squares = np.append(1 + 2 * np.diag(rotation) - trace, 1 + trace)  # 4 x^2, 4 y^2, 4 z^2, 4 w^2
    largest = int(np.argmax(squares))
    m = rotation
    rows = [
        [squares[0], m[1, 0] + m[0, 1], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
        [m[1, 0] + m[0, 1], squares[1], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
        [m[0, 2] + m[2, 0], m[2, 1] + m[1, 2], squares[2], m[1, 0] - m[0, 1]],
        [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], squares[3]],
    ]
    quaternion = np.array(rows[largest])
    return quaternion / np.linalg.norm(quaternion)


def orient(eyes, targets, up, times):
    """Quaternions (m, 4), x y z w, of cameras at `eyes` that look at `targets`; neighbours have the
    same sign, so that they can be interpolated."""
    quaternions = np.zeros((len(eyes), 4))
    for i, (eye, target) in enumerate(zip(eyes, targets)):
        direction = target - eye
        distance = np.linalg.norm(direction)
        rotation = look_rotation(direction / distance, up) if distance > 0 else None
        if rotation is None:
            raise BadInput(
                f"at t = {times[i]:.3f} s: the eye is at the look-at point, or looks along up"
            )
        quaternions[i] = quaternion_of(rotation)
        if i > 0 and np.dot(quaternions[i], quaternions[i - 1]) < 0:
            quaternions[i] = -quaternions[i]
    return quaternions


def measure_smoothness(eyes, quaternions):
    """The largest turn (degrees) and the largest way (world units) from one frame to the next."""
    if len(eyes) < 2:
        return 0.0, 0.0
    # By the chord, not by acos: exact for small turns.
    chords = np.linalg.norm(np.diff(quaternions, axis=0), axis=1)
    turns = 4 * np.arcsin(np.clip(chords / 2, 0, 1))
    ways = np.linalg.norm(np.diff(eyes, axis=0), axis=1)
    return math.degrees(turns.max()), ways.max()


def expect(condition, pointer, expected, found):
    if not condition:
        raise BadInput(f"{pointer}: expected {expected}, found {json.dumps(found)[:60]}")


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def check_keys(value, pointer, known, required):
    expect(isinstance(value, dict), pointer or "/", "an object", value)
    for key in sorted(set(value) - known):
        raise BadInput(f"{pointer}/{key}: unknown key; known are {', '.join(sorted(known))}")
    for key in sorted(required - set(value)):
        raise BadInput(f'{pointer or "/"}: the key "{key}" is missing')


def check_vector(value, pointer):
    good = isinstance(value, list) and len(value) == 3 and all(map(is_number, value))
    expect(good, pointer, "an array of 3 numbers", value)


def check_keyframes(keys):
    """Raises BadInput unless `keys` is what sessions/keyframes.schema.json says, with t rising."""
    check_keys(keys, "", KEYS, REQUIRED)
    expect(isinstance(keys["name"], str) and keys["name"], "/name", "a text", keys["name"])
    for name in ("near", "far", "fovy_deg", "fps"):
        value = keys.get(name, 1)
        expect(is_number(value) and value > 0, f"/{name}", "a number above 0", value)
    expect(keys["fovy_deg"] < 180, "/fovy_deg", "fewer than 180 degrees", keys["fovy_deg"])
    expect(keys["far"] > keys["near"], "/far", f"more than /near ({keys['near']})", keys["far"])
    size = keys["viewport"]
    good = isinstance(size, list) and len(size) == 2
    good = good and all(type(n) is int and 1 <= n <= 16384 for n in size)
    expect(good, "/viewport", "width and height, 1 to 16384 pixels", size)
    check_vector(keys.get("up", [0, 1, 0]), "/up")
    expect(any(keys.get("up", [0, 1, 0])), "/up", "a direction that is not 0 0 0", keys.get("up"))
    frames = keys["keyframes"]
    good = isinstance(frames, list) and len(frames) >= 2
    expect(good, "/keyframes", "2 or more keyframes", frames)
    for i, frame in enumerate(frames):
        pointer = f"/keyframes/{i}"
        check_keys(frame, pointer, KEYFRAME_KEYS, KEYFRAME_KEYS)
        expect(is_number(frame["t"]), f"{pointer}/t", "a number of seconds", frame["t"])
        if i > 0:
            before = frames[i - 1]["t"]
            expected = f"more than the one before ({before})"
            expect(frame["t"] > before, f"{pointer}/t", expected, frame["t"])
        check_vector(frame["eye"], f"{pointer}/eye")
        check_vector(frame["look_at"], f"{pointer}/look_at")


def make_session(keys, made, fps=None, sway=0.0, seed=1):
    """The session of a checked keyframe file, and its largest turn and way per frame."""
    fps = fps or keys.get("fps", 30)
    frames = keys["keyframes"]
    times = np.array([frame["t"] for frame in frames], dtype=float)
    # A tiny excess keeps the last keyframe when its time is a whole number of frames.
    count = int(math.floor((times[-1] - times[0]) * fps + 1e-6)) + 1
    at = np.minimum(times[0] + np.arange(count) / fps, times[-1])
    eyes = natural_spline(times, np.array([f["eye"] for f in frames], dtype=float), at)
    targets = natural_spline(times, np.array([f["look_at"] for f in frames], dtype=float), at)
    eyes = eyes + compute_sway(at, sway, seed)
    targets = targets + compute_sway(at, sway, seed + 1)
    up = np.array(keys.get("up", [0, 1, 0]), dtype=float)
    quaternions = orient(eyes, targets, up, at)
    session = {
        "version": 1,
        "name": keys["name"],
        "viewport": keys["viewport"],
        "fovy_rad": math.radians(keys["fovy_deg"]),
        "near": keys["near"],
        "far": keys["far"],
        "up": keys.get("up", [0, 1, 0]),
        "time_step_s": 1 / fps,
        "made": made,
        "frames": np.round(np.hstack([eyes, quaternions]), DIGITS).tolist(),
    }
    return session, measure_smoothness(eyes, quaternions)


def format_session(session):
    """The session as JSON text, one frame a line."""
    head = {key: value for key, value in session.items() if key != "frames"}
    lines = [f"  {json.dumps(key)}: {json.dumps(value)}," for key, value in head.items()]
    frames = ",\n".join("    " + json.dumps(frame) for frame in session["frames"])
    return "{\n" + "\n".join(lines) + '\n  "frames": [\n' + frames + "\n  ]\n}\n"


def read_keyframes(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise BadInput(error.strerror) from error
    except ValueError as error:
        raise BadInput(f"expected JSON: {error}") from error


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("keyframes", help="keyframe file (*.keyframes.json)")
    parser.add_argument("session", help="session file to write (*.session.json)")
    parser.add_argument("--fps", type=float, help="frames per second (default: the file's, or 30)")
    parser.add_argument(
        "--sway",
        type=float,
        default=0.0,
        help="hand-held sway of eye and look-at point, at most this many world units (default: 0)",
    )
    parser.add_argument("--seed", type=int, default=1, help="of the sway, 0 or more (default: 1)")
    options = parser.parse_args(arguments)
    if options.fps is not None and not (math.isfinite(options.fps) and options.fps > 0):
        parser.error(f"--fps: expected a number above 0, found {options.fps}")
    if not (math.isfinite(options.sway) and options.sway >= 0):
        parser.error(f"--sway: expected 0 or more world units, found {options.sway}")
    if options.seed < 0:
        parser.error(f"--seed: expected 0 or more, found {options.seed}")
    return options


def main(arguments=None):
    options = parse_arguments(arguments)
    made = f"scripts/make_session.py {os.path.basename(options.keyframes)}"
    made += f" --fps {options.fps:g}" if options.fps else ""
    made += f" --sway {options.sway:g} --seed {options.seed}" if options.sway else ""
    try:
        keys = read_keyframes(options.keyframes)
        check_keyframes(keys)
        session, (turn, way) = make_session(keys, made, options.fps, options.sway, options.seed)
    except BadInput as error:
        print(f"make_session.py: {options.keyframes}: {error}", file=sys.stderr)
        return 2
    try:
        write_text_atomically(options.session, format_session(session))
    except OSError as error:
        print(f"make_session.py: {options.session}: {error.strerror}", file=sys.stderr)
        return 2
    print(
        f"{options.session}: {len(session['frames'])} frames, at most {turn:.3f} degrees and "
        f"{way:.4f} units from one to the next",
        file=sys.stderr,
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
