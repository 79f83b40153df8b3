"""strategy_style.py: looks that can be told apart, also in grey, and never change."""

import itertools

import pytest
from strategy_style import KNOWN, MARKER_POINTS, style_of, styles_of


def luminance(color):
    """Relative, of sRGB, 0 to 1 (WCAG)."""
    channels = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear))


def test_known_styles_differ_in_colour_line_and_marker():
    for a, b in itertools.combinations(KNOWN.values(), 2):
        assert a.color != b.color and a.dashes != b.dashes and a.marker != b.marker


def test_known_colours_stand_out_from_white():
    for style in KNOWN.values():
        assert 1.05 / (luminance(style.color) + 0.05) >= 3


def test_others_never_look_like_known_ones_or_each_other():
    ids = [f"mine-{i}" for i in range(20)]
    styles = styles_of([*KNOWN, *ids])
    assert len(set(styles.values())) == 24
    known = {(s.color, s.dashes) for s in KNOWN.values()}
    assert all((styles[i].color, styles[i].dashes) not in known for i in ids)


def test_style_does_not_depend_on_order():
    ids = [f"mine-{i}" for i in range(20)]
    assert styles_of(ids) == styles_of(ids[::-1])


@pytest.mark.parametrize("strategy, color", (("coh-b", "#0072b2"), ("mine", "#7f7f7f")))
def test_style_is_always_the_same(strategy, color):
    assert style_of(strategy).color == color
    assert styles_of([strategy, "bool"])[strategy] == style_of(strategy)


def test_more_strategies_than_looks_still_work():
    assert len(styles_of(str(i) for i in range(100))) == 100


def test_every_marker_has_an_outline():
    ids = [f"mine-{i}" for i in range(36)]
    assert {s.marker for s in styles_of([*KNOWN, *ids]).values()} == set(MARKER_POINTS)
