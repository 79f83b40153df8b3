"""Colours and dashes of the strategies on a screen: those of strategy_style, on light and on dark.

Widths and dashes there are in points and in widths of a line on paper.
"""

from strategy_style import styles_of

PIXELS_PER_POINT = 1.4
DARK_PAPER = (0x16, 0x18, 0x1C)  # --paper of the dark page
CONTRAST = 4.5  # what text needs (WCAG 2, level AA); lines would do with 3


def make_styles(strategies):
    """{id: {color, darkColor (on a dark page), dash (pixels on, off, ...; [] is solid), width}}."""
    made = {}
    for strategy, style in styles_of(strategies).items():
        width = style.width * PIXELS_PER_POINT
        made[strategy] = {
            "color": style.color,
            "darkColor": lighten(style.color),
            "dash": [round(length * width, 1) for length in style.dashes],
            "width": round(width, 2),
        }
    return made


def lighten(color):
    """The colour "#rrggbb", mixed with white until it can be told from the dark page."""
    rgb = [int(color[i : i + 2], 16) for i in (1, 3, 5)]
    if max(rgb) - min(rgb) < 8:  # black on white is white on black
        rgb = [max(255 - v, 128) for v in rgb]
    mixed = rgb
    for step in range(1, 20):
        if compute_contrast(mixed, DARK_PAPER) >= CONTRAST:
            break
        mixed = [round(v + (255 - v) * step / 20) for v in rgb]
    return "#" + "".join(f"{v:02x}" for v in mixed)


def compute_contrast(one, other):
    """The contrast ratio of two colours, 1 to 21, as WCAG 2 defines it; rgb of 0 to 255."""
    bright, dark = sorted((compute_luminance(one), compute_luminance(other)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


def compute_luminance(rgb):
    """Relative luminance of an sRGB colour, 0 to 1."""
    linear = [v / 255 / 12.92 if v / 255 <= 0.04045 else ((v / 255 + 0.055) / 1.055) ** 2.4
              for v in rgb]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
