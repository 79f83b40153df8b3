"""Small scenes and sessions for the tests of the program."""

import json
import math
import struct


def write_json(path, content):
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def write_ply(path, vertices, triangles, binary=False):
    """A PLY; coordinates may be texts, for what is no number."""
    header = [
        "ply",
        f"format {'binary_little_endian' if binary else 'ascii'} 1.0",
        f"element vertex {len(vertices)}",
        *(f"property float {axis}" for axis in "xyz"),
        f"element face {len(triangles)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    if binary:
        points = b"".join(struct.pack("<3f", *map(float, v)) for v in vertices)
        faces = b"".join(struct.pack("<B3i", 3, *t) for t in triangles)
        path.write_bytes("\n".join([*header, ""]).encode() + points + faces)
        return path
    points = [" ".join(str(c) for c in v) for v in vertices]
    faces = [" ".join(str(i) for i in (len(t), *t)) for t in triangles]
    path.write_text("\n".join([*header, *points, *faces, ""]), encoding="utf-8")
    return path


def write_relief(path, side=40, binary=False):
    """A square wall of hills, 2 side^2 triangles, about 2 units wide, facing +z."""
    vertices, triangles = [], []
    for j in range(side + 1):
        for i in range(side + 1):
            x, y = 2 * i / side - 1, 2 * j / side - 1
            z = 0.3 * math.sin(5 * x) * math.cos(4 * y) + 0.05 * math.sin(23 * x + 17 * y)
            vertices.append((f"{x:.6f}", f"{y:.6f}", f"{z:.6f}"))
    for j in range(side):
        for i in range(side):
            a = j * (side + 1) + i
            b, c, d = a + 1, a + side + 1, a + side + 2
            triangles += [(a, b, d), (a, d, c)]
    return write_ply(path, vertices, triangles, binary)


def write_walls(folder, walls=3):
    """A scene file of some reliefs one behind the other."""
    write_relief(folder / "relief.ply")
    instances = [{"mesh": "relief", "translate": [0.2 * i, 0, -1.5 * i]} for i in range(walls)]
    content = {
        "version": 1,
        "name": "walls",
        "meshes": {"relief": {"file": "relief.ply"}},
        "instances": instances,
    }
    return write_json(folder / "walls.scene.json", content)


def write_courtyard(path, triangles=60000):
    generator = {"type": "courtyard", "seed": 3, "triangles": triangles}
    return write_json(path, {"version": 1, "name": "yard", "generator": generator})


def look(eye, target):
    """A pose, px py pz qx qy qz qw, that looks from the eye to the target with y up."""
    x, y, z = (t - e for t, e in zip(target, eye))
    yaw = math.atan2(-x, -z)
    pitch = math.atan2(y, math.hypot(x, z))
    sy, cy = math.sin(yaw / 2), math.cos(yaw / 2)
    sp, cp = math.sin(pitch / 2), math.cos(pitch / 2)
    return [*(round(c, 4) for c in (*eye, cy * sp, sy * cp, -sy * sp, cy * cp))]


def write_session(path, poses, size=(160, 120), near=0.05, **changes):
    content = {
        "version": 1,
        "name": "path",
        "viewport": list(size),
        "fovy_rad": 0.9,
        "near": near,
        "far": 120,
        "frames": poses,
        **changes,
    }
    return write_json(path, content)


def past_the_walls(frames):
    """Poses in front of the walls of write_walls(), moving sideways and nearer."""
    steps = [i % 40 for i in range(frames)]
    return [look((0.05 * i - 1, 0.3, 3.2 - 0.04 * i), (0.2, 0, -1)) for i in steps]


def through_the_courtyard(frames):
    """A walk along the courtyard's axis whose gaze swings to the sides and back."""
    poses = []
    for i in range(frames):
        a = 0.28 * i
        eye = (0.3 + 0.11 * i, 1.7, 19.6 - 0.31 * i)
        poses.append(look(eye, (eye[0] + 4 * math.sin(a), 1.5, eye[2] - 4 * math.cos(0.6 * a))))
    return poses


def build_yard(hlodbench, folder, frames):
    """A small courtyard's hierarchy of many nodes, and a session through it: their paths."""
    hlod = folder / "yard.hlod"
    session = write_session(folder / "walk.json", through_the_courtyard(frames))
    scene = write_courtyard(folder / "yard.scene.json")
    build = hlodbench("build", scene, "-o", hlod, "--max-triangles", "200")
    assert build.returncode == 0, build.stderr
    return hlod, session
