"""The geometry behind a trace, worked out anew: what a camera sees of an axis-aligned box.

Boxes are handled as the eight points they have; nothing here is taken from the program.
"""

import math
from dataclasses import dataclass

RELATIVE = 1e-6  # traces have nine digits; poses that have more are rounded in them


@dataclass(frozen=True)
class Box:
    low: tuple
    high: tuple

    def corners(self):
        return [
            (x, y, z)
            for x in (self.low[0], self.high[0])
            for y in (self.low[1], self.high[1])
            for z in (self.low[2], self.high[2])
        ]


@dataclass(frozen=True)
class Lens:
    width: int  # pixels
    height: int
    fovy: float  # vertical, radians
    near: float  # world units
    far: float


def rotate_back(quaternion, vector):
    """The vector in the camera's axes; the unit quaternion x y z w turns camera to world."""
    x, y, z, w = quaternion
    x, y, z = -x, -y, -z  # the inverse rotation
    tx = 2 * (y * vector[2] - z * vector[1])
    ty = 2 * (z * vector[0] - x * vector[2])
    tz = 2 * (x * vector[1] - y * vector[0])
    return (
        vector[0] + w * tx + y * tz - z * ty,
        vector[1] + w * ty + z * tx - x * tz,
        vector[2] + w * tz + x * ty - y * tx,
    )


def convex_hull(points):
    """Corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    points = sorted(set(points))
    if len(points) < 3:
        return points

    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2], chain[-1]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0:
                    break
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return half(points) + half(points[::-1])


def cut(polygon, inside):
    """The part of a convex polygon where inside(point) >= 0; `inside` is linear."""
    kept = []
    for i, point in enumerate(polygon):
        before = polygon[i - 1]
        a, b = inside(before), inside(point)
        if (a < 0) != (b < 0):
            share = a / (a - b)
            kept.append(tuple(p + share * (q - p) for p, q in zip(before, point)))
        if b >= 0:
            kept.append(point)
    return kept


def polygon_area(polygon):
    return 0.5 * sum(
        polygon[i - 1][0] * p[1] - p[0] * polygon[i - 1][1] for i, p in enumerate(polygon)
    )


def polygon_length(polygon):
    return sum(math.dist(polygon[i - 1], p) for i, p in enumerate(polygon))


class View:
    """One frame's camera. Answers come with how far rounding may have moved them."""

    def __init__(self, lens, position, orientation):
        self.lens = lens
        self.position = position
        length = math.sqrt(sum(c * c for c in orientation))
        self.orientation = [c / length for c in orientation]
        self.tan_y = math.tan(lens.fovy / 2)
        self.tan_x = self.tan_y * lens.width / lens.height
        self.seen = {}  # what points() found out

    def points(self, box):
        """The box's corners as right, up, depth (along the view direction)."""
        if box in self.seen:
            return self.seen[box]
        result = self.seen[box] = []
        for corner in box.corners():
            x, y, z = rotate_back(
                self.orientation, [c - e for c, e in zip(corner, self.position)]
            )
            result.append((x, y, -z))
        return result

    def sees(self, box):
        """Whether no plane of the frustum has the whole box behind it; and: too close to tell."""
        points = self.points(box)
        slack = RELATIVE * max(1.0, *(abs(c) for p in points for c in p))
        sides = (
            lambda x, y, d: d - self.lens.near,
            lambda x, y, d: self.lens.far - d,
            lambda x, y, d: d * self.tan_x - x,
            lambda x, y, d: d * self.tan_x + x,
            lambda x, y, d: d * self.tan_y - y,
            lambda x, y, d: d * self.tan_y + y,
        )
        most = min(max(side(*p) for p in points) for side in sides)
        return most >= 0, abs(most) <= slack

    def cuts(self, box):
        """Whether the near plane reaches the box, so that no query can count it; too close?"""
        nearest = min(depth for _, _, depth in self.points(box)) - self.lens.near
        return nearest <= 0, abs(nearest) <= RELATIVE * max(1.0, self.lens.near)

    def distance(self, box):
        """From the eye to the nearest point of the box; 0 inside."""
        x, y, z = (
            max(low - e, e - high, 0.0)
            for low, e, high in zip(box.low, self.position, box.high)
        )
        return math.sqrt(x * x + y * y + z * z)

    def screen_error(self, box, error):
        """Pixels that `error` world units cover at the nearest point of the box."""
        pixels_at_1 = self.lens.height / (2 * self.tan_y)
        return error * pixels_at_1 / max(self.lens.near, self.distance(box))

    def is_inside(self, box):
        """Whether the eye is inside the box; too close?"""
        gaps = [max(low - e, e - high) for low, e, high in zip(box.low, self.position, box.high)]
        return max(gaps) <= 0, abs(max(gaps)) <= RELATIVE

    def pieces(self, box):
        """Corners of the box's faces, cut to the pyramid that the viewport spans from the eye."""
        planes = (
            lambda p: p[2] * self.tan_x - p[0],
            lambda p: p[2] * self.tan_x + p[0],
            lambda p: p[2] * self.tan_y - p[1],
            lambda p: p[2] * self.tan_y + p[1],
        )
        corners = self.points(box)
        points = []
        for face in ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4),
                     (1, 3, 7, 5)):  # fmt: skip
            polygon = [corners[i] for i in face]
            for plane in planes:
                polygon = cut(polygon, plane)
            points += polygon
        return points

    def box_pixels(self, box, clipped=True):
        """Pixels of the viewport that a box covers, at least 1; slack.

        Outline of the eight projected corners, cut to the viewport if asked for. Of a box that the
        near plane cuts, outline of what the viewport's pyramid leaves of it.
        """
        width, height = self.lens.width, self.lens.height
        is_cut = self.cuts(box)[0]
        polygon = convex_hull(
            [
                ((x / (d * self.tan_x) + 1) / 2 * width, (y / (d * self.tan_y) + 1) / 2 * height)
                for x, y, d in (self.pieces(box) if is_cut else self.points(box))
            ]
        )
        for inside in () if is_cut or not clipped else (
            lambda p: p[0],
            lambda p: width - p[0],
            lambda p: p[1],
            lambda p: height - p[1],
        ):
            polygon = cut(polygon, inside)
        area = max(1.0, polygon_area(polygon))
        return area, RELATIVE * area + 1e-5 * polygon_length(polygon)
