"""What readers rely on in run.json and images.json: checked once, so that nobody else has to.

A shape is a type, a list with the shape of its elements, or a dict of members; a name that ends in
"?" may be absent or null. int means a whole number from 0 to LARGEST. Members not named here are free.
"""

RUN = {
    "scene": {"name": str},
    "session": {"frames": int},
    "context": {},
    "cases": [{"strategy": str, "repetition": int, "label?": str, "csv?": str, "error?": str}],
    "missing?": [{"strategy": str, "repetition": int}],
}
PICTURE = {"frame": int, "file": str, "overlays?": {}}
IMAGES = {
    "frames": [int],
    "width": int,
    "height": int,
    "format?": str,
    "reference?": str,
    "overlays?": [str],
    "full?": [PICTURE],
    "strategies": [{"strategy": str, "frames": [PICTURE]}],
}
LARGEST = 10_000_000  # more frames or pixels than that are a damaged file
NAMES = {str: "a text", int: f"a whole number from 0 to {LARGEST}", dict: "an object", list: "a list"}


def find_flaw(value, shape, place=""):
    """The first place where the value differs from its shape, as "place: expected ..., found ...";
    None if there is none."""
    kind = _kind(shape)
    is_kind = isinstance(value, kind) and not (kind is int and isinstance(value, bool))
    if not is_kind or (kind is int and not 0 <= value <= LARGEST):
        return f"{place or 'the whole'}: expected {NAMES[kind]}, found {str(value)[:40]!r}"
    if kind is list:
        flaws = (find_flaw(v, shape[0], f"{place}[{i}]") for i, v in enumerate(value))
        return next((flaw for flaw in flaws if flaw), None)
    if kind is not dict:
        return None
    for name, member in shape.items():
        key = name.rstrip("?")
        if value.get(key) is None and name.endswith("?"):
            continue
        inside = f"{place}.{key}" if place else key
        if key not in value:
            return f"{inside}: expected {NAMES[_kind(member)]}, found none"
        flaw = find_flaw(value[key], member, inside)
        if flaw:
            return flaw
    return None


def _kind(shape):
    return shape if isinstance(shape, type) else type(shape)
