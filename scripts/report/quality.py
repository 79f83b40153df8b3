"""The table of PSNR: from the summaries in images.json, beside what the paper prints."""

from .values import DASH, TIE, format_fixed, format_share, get_path, to_number

PLANES = ("y", "cb", "cr")


def format_psnr(statistic):
    """Mean ± standard deviation in dB, and how many planes were identical (their PSNR is infinite,
    they are in no mean)."""
    mean = to_number(get_path(statistic, "mean"))
    identical = int(to_number(get_path(statistic, "identical")) or 0)
    if mean is None:
        return f"{identical}{TIE}identical" if identical else DASH
    deviation = to_number(get_path(statistic, "stddev"))
    text = f"{mean:.2f}" + ("" if deviation is None else f"{TIE}±{TIE}{deviation:.2f}")
    return text + (f" ({identical}{TIE}identical)" if identical else "")


def make_quality(run, paper):
    """Rows of the table for one run, [] if it has no pictures.

    A row: label, y, cb, cr (against the reference), full_y, wrong, cracks, all text, and
    `is_paper`.
    """
    if not run.images:
        return []
    rows = []
    for strategy in run.image_strategies():
        summary = next((s.get("summary") for s in run.images["strategies"]
                        if s["strategy"] == strategy), None)
        is_reference = strategy == run.images.get("reference")
        cells = {plane: "reference" if is_reference else
                 format_psnr(get_path(summary, "vs_reference", plane)) for plane in PLANES}
        largest = format_share(get_path(summary, "wrong_share", "max"))
        wrong = format_share(get_path(summary, "wrong_share", "mean"))
        rows.append({
            "label": run.label(strategy),
            **cells,
            "full_y": format_psnr(get_path(summary, "vs_full", "y")),
            "wrong": wrong if wrong == DASH else f"{wrong} (at{TIE}most{TIE}{largest})",
            "cracks": format_fixed(get_path(summary, "crack_pixels"), 0),
            "is_paper": False,
        })
        printed = find_printed(run.scene, strategy, paper)
        if printed:
            rows.append(printed)
    return rows


def find_printed(scene, strategy, paper):
    """The row of what the paper prints for the strategy in this scene, or None."""
    for entry in (paper or {}).get("scenes", []):
        psnr = entry.get("psnr_db")
        if entry.get("id") == scene and psnr and psnr.get("test") == strategy:
            return {
                "label": f"paper, {entry['label']}",
                **{plane: format_psnr(psnr.get(plane)) for plane in PLANES},
                "full_y": DASH, "wrong": DASH, "cracks": DASH, "is_paper": True,
            }
    return None


def describe_selection(run):
    """Which frames have pictures, as a sentence's part."""
    images = run.images or {}
    count = len(run.image_frames())
    how = {"random": f"drawn at random (seed {images.get('seed')})", "all": "all",
           "list": "chosen by hand"}.get(str(images.get("selection")), "")
    return f"{count} frames" + (f", {how}" if how else "")
