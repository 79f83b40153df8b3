"""The pictures of a run as the page's viewer wants them, within a budget of bytes.

Differences and worst regions are computed from the exact files; what is seen is coded with loss.
"""

from dataclasses import dataclass, field

from result_folder import find_worst_region

from .encoding import AMPLIFY, LEVELS, Album, compute_difference, cut

REGION = (80, 60)  # pixels of the region that is magnified
SAMPLES = 3  # frames of each scene that a level is judged by
VALUES = ("rarn_nodes", "vs_reference", "vs_full", "wrong_pixels", "crack_pixels")


@dataclass
class Embedded:
    """What goes into the page for one run."""

    data: dict = field(default_factory=dict)  # for the scripts
    uris: list = field(default_factory=list)  # data URIs, by index
    size: int = 0  # bytes of them


def has_pictures(run):
    """Whether the run has pictures that can be shown here."""
    if not run.images or not run.image_frames():
        return False
    if run.images.get("format", "png") != "png":
        run.note(f"{run.folder / 'images'}: expected PNG, found {run.images['format']}: "
                 "these pictures are not shown")
        return False
    return True


def embed_all(runs, budget):
    """(list of Embedded, one for each run; the Level used). budget: bytes for all data URIs."""
    shown = [run for run in runs if has_pictures(run)]
    for level in LEVELS:
        if shown and estimate(shown, level) > budget:
            continue
        made = {id(run): embed(run, level, pick_frames(run, level)) for run in shown}
        if sum(e.size for e in made.values()) <= budget:
            break
    return [made.get(id(run), Embedded()) for run in runs], level


def estimate(runs, level):
    """About how many bytes the pictures take, judged by a few frames."""
    total = 0
    for run in runs:
        frames = pick_frames(run, level)
        sample = frames[:: max(1, len(frames) // SAMPLES)][:SAMPLES]
        total += embed(run, level, sample).size * len(frames) / len(sample)
    return total


def pick_frames(run, level):
    """The frames that are embedded."""
    return sorted(set(run.image_frames()))[:: level.stride]


def embed(run, level, frames):
    """The pictures of these frames of one run."""
    album = Album()
    images = run.images
    data = {
        "width": images["width"], "height": images["height"], "amplify": AMPLIFY,
        "reference": images.get("reference"), "region": list(REGION),
        "overlays": list_overlays(run, level),
        "frames": [embed_frame(run, level, frame, album) for frame in frames],
    }
    return Embedded(data, album.uris, album.size)


def embed_frame(run, level, frame, album):
    """One frame: indices into the album, differences, and the numbers of images.json."""
    exact = {}
    for strategy in ["full", *run.image_strategies()]:
        if run.image_entry(strategy, frame) is None:
            run.note(f"{run.folder / 'images' / 'images.json'}: frame {frame}: expected a picture "
                     f"of {strategy}, found none")
            continue
        picture = run.image(strategy, frame)
        if picture is not None:
            exact[strategy] = picture
    entry = {"frame": frame, "overlays": {}, "values": {}, "against": {},
             "shown": {s: album.add(p, level.quality) for s, p in exact.items()}}
    for reference in dict.fromkeys(("full", run.images.get("reference"))):
        if reference in exact:
            entry["against"][reference] = {
                s: compare(picture, exact[reference], level, album)
                for s, picture in exact.items() if s not in (reference, "full")}
    for strategy in run.image_strategies():
        described = run.image_entry(strategy, frame) or {}
        entry["values"][strategy] = {key: described.get(key) for key in VALUES}
        entry["overlays"][strategy] = embed_overlays(run, strategy, level, described, album)
    return entry


def compare(picture, reference, level, album):
    """The difference of two pictures, and where it is worst; None if there is none."""
    difference = compute_difference(picture, reference)
    if not difference.any():
        return None
    left, top, error = find_worst_region(picture, reference, *REGION)
    width, height = min(REGION[0], picture.shape[1]), min(REGION[1], picture.shape[0])
    window = left, top, width, height
    return {
        "difference": album.add(difference, level.quality),
        "region": window,
        "error": round(error, 2),
        # Magnified pixels are looked at closely: these stay exact.
        "crops": [album.add(cut(p, *window)) for p in (reference, picture, difference)],
    }


def list_overlays(run, level):
    """Names of the overlays that are embedded."""
    return (run.images.get("overlays") or [])[: level.overlays]


def embed_overlays(run, strategy, level, described, album):
    """Overlay name -> index, of the overlays of one picture (its entry in images.json)."""
    found = {}
    for overlay in list_overlays(run, level):
        if overlay not in (described.get("overlays") or {}):
            continue
        picture = run.image(strategy, described["frame"], overlay)
        if picture is not None:
            found[overlay] = album.add(picture, level.quality)
    return found


def describe_level(level, runs):
    """Lines of the report on how pictures were embedded."""
    lines = [
        f"Pictures are coded with loss (WebP, quality {level.quality}) to keep this file small. "
        "PSNR, differences and worst regions were computed from the lossless files."
    ]
    names = dict.fromkeys(name for run in runs if run.images
                          for name in (run.images.get("overlays") or [])[level.overlays :])
    if names:
        lines.append(f"The overlay pictures {', '.join(names)} were left out: with them this file "
                     "would be too large.")
    if level.stride > 1:
        lines.append(f"Only every {level.stride}th frame with pictures is shown, or this file "
                     "would be too large.")
    return lines
