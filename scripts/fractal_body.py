#!/usr/bin/env python3
"""Writes a closed fractal body, the same at any number of triangles but for how fine it is.

A cube's faces are cut into n by n squares of two triangles and blown up to a sphere of radius 1,
whose radius then varies by ridges from nearly the body's size down to a few edges, as a scan shows
what its resolution lets it see. Binary little-endian PLY; takes little memory at any size.
"""

import argparse
import math
import sys

import numpy as np

from atomic_file import write_atomically

WAVES = 6  # an octave
ROUGHNESS = 0.48  # amplitude of an octave of that before it
LARGEST = 0.16  # amplitude of the first octave, of the radius
EDGES_A_WAVE = 6.0  # the finest ridges are no shorter
ROWS = 64  # of squares in memory at a time
FACES = ((0, 1, 2, 1), (0, 1, 2, -1), (1, 2, 0, 1), (1, 2, 0, -1), (2, 0, 1, 1), (2, 0, 1, -1))


def squares_along_an_edge(triangles):
    """The number n of squares along an edge whose body of 12 n^2 triangles is nearest in size."""
    return max(1, round(math.sqrt(triangles / 12)))


def cube_coordinates(n):
    """n + 1 coordinates from -1 to 1 that part the sphere more evenly than equal steps."""
    coordinates = np.tan(np.linspace(-math.pi / 4, math.pi / 4, n + 1))
    coordinates[0], coordinates[-1] = -1.0, 1.0  # what two faces share must be the same
    return coordinates


def make_octaves(n):
    """[(amplitude, [(direction times frequency, phase)])], the coarsest first."""
    random = np.random.default_rng(1)
    octaves = []
    frequency, amplitude = 2.0, LARGEST
    while 2 * math.pi / frequency > EDGES_A_WAVE * (math.pi / 2) / n or not octaves:
        directions = random.normal(size=(WAVES, 3))
        directions *= frequency / np.linalg.norm(directions, axis=1, keepdims=True)
        octaves.append((amplitude, list(zip(directions, random.uniform(0, 2 * math.pi, WAVES)))))
        frequency *= 2
        amplitude *= ROUGHNESS
    return octaves


def compute_points(x, y, z, octaves):
    """Points of the body in the directions (x, y, z): float32, one a row."""
    length = np.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    radius = np.ones_like(length)
    for amplitude, waves in octaves:
        total = sum(np.sin(x * d[0] + y * d[1] + z * d[2] + phase) for d, phase in waves)
        radius += amplitude * (0.5 - np.abs(total) / math.sqrt(WAVES))
    points = np.stack((x * radius, y * radius, z * radius), axis=-1)
    return points.reshape(-1, 3).astype("<f4")


def write_points(file, n):
    octaves = make_octaves(n)
    coordinates = cube_coordinates(n)
    for axis, first, second, side in FACES:
        for row in range(0, n + 1, ROWS):
            u, v = np.meshgrid(coordinates[row:row + ROWS], coordinates, indexing="ij")
            place = [None, None, None]
            place[axis], place[first], place[second] = np.full_like(u, side), u, v
            file.write(compute_points(*place, octaves).tobytes())


def write_triangles(file, n):
    record = np.dtype([("corners", "u1"), ("vertex", "<i4", 3)])
    for face, (_, _, _, side) in enumerate(FACES):
        for row in range(0, n, ROWS):
            rows = np.arange(row, min(n, row + ROWS))[:, None]
            a = face * (n + 1) ** 2 + rows * (n + 1) + np.arange(n)[None, :]
            b, c, d = a + n + 1, a + n + 2, a + 1  # counter-clockwise seen from the side's end
            corners = ((a, b, c), (a, c, d)) if side > 0 else ((a, c, b), (a, d, c))
            triangles = np.empty((rows.size, n, 2), record)
            triangles["corners"] = 3
            for i, three in enumerate(corners):
                for k, vertex in enumerate(three):
                    triangles["vertex"][:, :, i, k] = vertex
            file.write(triangles.tobytes())


def write_fractal_body(path, triangles):
    """Writes about `triangles` triangles, 12 n^2; returns their number."""
    n = squares_along_an_edge(triangles)
    with write_atomically(path) as temporary:
        with open(temporary, "wb") as file:
            file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {6 * (n + 1) ** 2}\n"
                       "property float x\nproperty float y\nproperty float z\n"
                       f"element face {12 * n * n}\n"
                       "property list uchar int vertex_indices\nend_header\n".encode())
            write_points(file, n)
            write_triangles(file, n)
    return 12 * n * n


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("triangles", type=float, help="how many, about; 1.5e6 is fine")
    parser.add_argument("out", help="PLY file to write")
    options = parser.parse_args()
    if not 12 <= options.triangles <= 2e9:
        parser.error(f"triangles: expected a number from 12 to 2e9, found {options.triangles:g}")
    print(f"{options.out}: {write_fractal_body(options.out, options.triangles)} triangles",
          file=sys.stderr)


if __name__ == "__main__":
    main()
