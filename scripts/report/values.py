"""Numbers as the report shows them."""

import math

DASH = "–"
TIE = "\N{NO-BREAK SPACE}"


def to_number(value):
    """The value as a float, or None if it is no finite number (true and false are none)."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return float(value) if math.isfinite(value) else None


def format_fixed(value, digits, absent=DASH):
    """With so many digits behind the point; `absent` for what is no number."""
    number = to_number(value)
    return absent if number is None else f"{number:.{digits}f}"


def format_count(count):
    """A large count in short, as the program's tables have it: 5.23M, 11k, 950."""
    number = to_number(count)
    if number is None:
        return DASH
    if number >= 1e6:
        return f"{number / 1e6:.2f}M"
    if number >= 1e4:
        return f"{number / 1e3:.0f}k"
    return f"{number:.0f}"


def format_share(share):
    """A share as per cent with three significant digits, or a dash."""
    number = to_number(share)
    if number is None:
        return DASH
    return f"0{TIE}%" if number == 0 else f"{100 * number:.3g}{TIE}%"


def get_path(tree, *keys):
    """tree[key][key]..., or None where it ends early: files written by others may lack anything."""
    for key in keys:
        if not isinstance(tree, dict):
            return None
        tree = tree.get(key)
    return tree
