"""scripts/fractal_body.py: closed, evenly wound, of the size asked for, the same at any size."""

import pathlib
import subprocess
import sys

import numpy as np
import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "fractal_body.py"


def write_body(path, triangles):
    return subprocess.run([sys.executable, SCRIPT, str(triangles), path], capture_output=True,
                          text=True)


def read_body(path):
    """(points, triangles over distinct points)"""
    header, _, data = path.read_bytes().partition(b"end_header\n")
    vertices, faces = (int(line.split()[2]) for line in header.decode().splitlines()
                       if line.startswith("element"))
    points = np.frombuffer(data, "<f4", 3 * vertices).reshape(-1, 3)
    record = np.dtype([("corners", "u1"), ("vertex", "<i4", 3)])
    triangles = np.frombuffer(data, record, faces, 12 * vertices)
    assert (triangles["corners"] == 3).all() and len(data) == 12 * vertices + 13 * faces
    distinct, number = np.unique(points, axis=0, return_inverse=True)
    return distinct, number.reshape(-1)[triangles["vertex"]]


@pytest.mark.parametrize("asked", [12, 3000, 60_000])
def test_is_a_closed_surface_wound_outwards(tmp_path, asked):
    result = write_body(tmp_path / "body.ply", asked)
    assert result.returncode == 0, result.stderr
    points, triangles = read_body(tmp_path / "body.ply")
    assert abs(len(triangles) - asked) <= 0.1 * asked
    edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    there = {tuple(edge) for edge in edges.tolist()}
    assert len(there) == len(edges)  # no edge is passed twice in one direction,
    assert all((b, a) in there for a, b in there)  # and each once in the other
    a, b, c = (points[triangles[:, i]].astype(float) for i in range(3))
    assert (np.cross(a, b) * c).sum() / 6 > 1  # the volume
    assert len(points) - len(there) // 2 + len(triangles) == 2  # a sphere, by Euler


def test_is_the_same_body_at_any_size(tmp_path):
    for size in (20_000, 80_000):
        assert write_body(tmp_path / f"{size}.ply", size).returncode == 0
    radii = [np.linalg.norm(read_body(tmp_path / f"{size}.ply")[0], axis=1)
             for size in (20_000, 80_000)]
    for share in (0.01, 0.5, 0.99):
        assert abs(np.quantile(radii[0], share) - np.quantile(radii[1], share)) < 0.02


def test_refuses_sizes_that_make_no_sense(tmp_path):
    for size in ("3", "1e12", "nan"):
        result = write_body(tmp_path / "body.ply", size)
        assert result.returncode == 2 and "expected a number from 12" in result.stderr
    assert not list(tmp_path.iterdir())
