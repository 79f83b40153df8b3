"""How a strategy looks in every figure, report and video: one colour, line and marker each.

The colours are those of Okabe and Ito, which the colour-blind can tell apart; dashes, widths and
markers differ as well, so that a print in grey does too. Standard library only.
"""

import zlib
from dataclasses import dataclass


@dataclass(frozen=True)
class Style:
    """Of lines on white."""

    color: str  # "#rrggbb"
    dashes: tuple  # lengths on, off, on, off, ... in widths of the line; () is a solid line
    width: float  # points
    marker: str  # as matplotlib names it; its outline is one of MARKER_POINTS


KNOWN = {
    "bool": Style("#000000", (1.0, 1.4), 1.3, "s"),
    "sw-b": Style("#009e73", (5.5, 1.8), 1.3, "^"),
    "simp-b": Style("#d55e00", (5.0, 1.5, 1.0, 1.5), 1.3, "D"),
    "coh-b": Style("#0072b2", (), 1.5, "o"),
}
# What the others share: 36 looks, none of them that of a known one.
OTHER_COLORS = ("#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f")
OTHER_DASHES = ((9.0, 2.0), (3.0, 1.2, 1.0, 1.2, 1.0, 1.2), (2.5, 2.5))
OTHER_MARKERS = ("v", "P", "X")
# Outlines in a square of -1 to 1, y upwards, for those who draw without matplotlib; a circle has
# none.
MARKER_POINTS = {
    "o": (),
    "s": ((-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)),
    "D": ((0, -1.2), (1.2, 0), (0, 1.2), (-1.2, 0)),
    "^": ((-1, -0.9), (1, -0.9), (0, 1.1)),
    "v": ((-1, 0.9), (1, 0.9), (0, -1.1)),
    "P": ((-0.35, -1), (0.35, -1), (0.35, -0.35), (1, -0.35), (1, 0.35), (0.35, 0.35), (0.35, 1),
          (-0.35, 1), (-0.35, 0.35), (-1, 0.35), (-1, -0.35), (-0.35, -0.35)),
    "X": ((-1, -0.5), (-0.5, -1), (0, -0.5), (0.5, -1), (1, -0.5), (0.5, 0), (1, 0.5), (0.5, 1),
          (0, 0.5), (-0.5, 1), (-1, 0.5), (-0.5, 0)),
}


def styles_of(strategies):
    """The style of each id: {id: Style}, all different as long as there are looks left.

    A known strategy always looks the same. Another's look follows from its id, and moves on to
    the next free one only if another of these has taken it.
    """
    strategies = list(strategies)
    styles = {s: KNOWN[s] for s in strategies if s in KNOWN}
    count = len(OTHER_COLORS) * len(OTHER_DASHES) * len(OTHER_MARKERS)
    taken = set()
    for strategy in sorted(set(strategies) - set(KNOWN)):
        place = zlib.crc32(strategy.encode()) % count
        while place in taken and len(taken) < count:
            place = (place + 1) % count
        taken.add(place)
        styles[strategy] = _other(place)
    return styles


def style_of(strategy):
    """The style of one strategy by itself."""
    return styles_of([strategy])[strategy]


def _other(place):
    """Neighbouring places differ in colour first."""
    color = OTHER_COLORS[place % len(OTHER_COLORS)]
    place //= len(OTHER_COLORS)
    dashes = OTHER_DASHES[place % len(OTHER_DASHES)]
    return Style(color, dashes, 1.3, OTHER_MARKERS[place // len(OTHER_DASHES)])
