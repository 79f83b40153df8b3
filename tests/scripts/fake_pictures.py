"""The pictures of a fake run (fake_run.py): a shaded sphere under a sky, with small errors of each
strategy's own, and images/images.json with what is true of them."""

import json
import math

import numpy as np
from PIL import Image

SKY = (158, 189, 219)
# Of full-range BT.601; rows Y, Cb, Cr.
TO_YCBCR = np.array([[0.299, 0.587, 0.114],
                     [-0.168736, -0.331264, 0.5],
                     [0.5, -0.418688, -0.081312]])
MODULATION = ((0, 114, 255), (255, 0, 255), (255, 0, 0))  # weak, moderate, strong


def make(folder, strategies, frames, size, overlays, seed, edit, label):
    """Writes the pictures and images.json; returns the pictures and what images.json says."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    pictures = {}
    for frame in frames:
        full = paint(frame, size)
        pictures["full", frame] = full
        for strategy in strategies:
            # sw-b shows what bool shows; the others differ by at most one step in some pixels.
            differs = strategy not in ("bool", "sw-b")
            noise = rng.integers(0, 2, full.shape) if differs else 0
            pictures[strategy, frame] = np.clip(full.astype(int) - noise, 0, 255).astype(np.uint8)
    if edit:
        edit(pictures)
    for (strategy, frame), picture in pictures.items():
        save(folder / f"{strategy}.{frame:05}.png", picture)
    images = _describe(pictures, strategies, frames, size, overlays, seed, label)
    for entry in (e for s in images["strategies"] for e in s["frames"]):
        for name in entry["overlays"].values():
            save(folder / name, paint_overlay(entry["frame"], size))
    (folder / "images.json").write_text(json.dumps(images, indent=2) + "\n", encoding="utf-8")
    return pictures, images


def save(path, picture):
    """Writes (height, width, 3) uint8 as PNG."""
    Image.fromarray(np.asarray(picture, dtype=np.uint8)).save(path)


def paint(frame, size):
    """A picture of a sphere that moves with the frame: (height, width, 3) uint8."""
    inside, x, y, centre = _sphere(frame, size)
    shade = np.clip(1.2 - np.hypot(x - centre[0] + size[0] / 10, y - centre[1]) / size[1], 0, 1)
    picture = np.full((size[1], size[0], 3), SKY, dtype=np.uint8)
    picture[inside] = np.stack([shade * 200, shade * 160, shade * 90], axis=-1)[inside]
    return picture


def paint_overlay(frame, size):
    """The sphere in the three colours of modulation, one a third."""
    inside, x, _, _ = _sphere(frame, size)
    picture = np.full((size[1], size[0], 3), SKY, dtype=np.uint8)
    third = np.clip((x * 3 // size[0]).astype(int), 0, 2)
    picture[inside] = np.array(MODULATION, dtype=np.uint8)[third][inside]
    return picture


def psnr(picture, reference):
    """Of the planes Y, Cb and Cr, dB: {"y": ..., "cb": ..., "cr": ...}, None where identical."""
    difference = (picture.astype(float) - reference.astype(float)) @ TO_YCBCR.T
    errors = (difference**2).mean(axis=(0, 1))
    return {plane: 10 * math.log10(255**2 / error) if error > 0 else None
            for plane, error in zip(("y", "cb", "cr"), errors)}


def _sphere(frame, size):
    y, x = np.mgrid[: size[1], : size[0]]
    centre = (size[0] * (0.5 + 0.1 * math.sin(frame / 20)), size[1] * 0.55)
    return np.hypot(x - centre[0], y - centre[1]) < size[1] * 0.4, x, y, centre


def _describe(pictures, strategies, frames, size, overlays, seed, label):
    reference = "bool" if "bool" in strategies else None
    full = [{"frame": f, "file": f"full.{f:05}.png",
             "covered_pixels": int((pictures["full", f] != SKY).any(axis=2).sum())} for f in frames]
    described = []
    for strategy in strategies:
        entries = []
        for i, frame in enumerate(frames):
            picture = pictures[strategy, frame]
            compared = reference and strategy != reference
            entries.append({
                "frame": frame, "file": f"{strategy}.{frame:05}.png",
                "overlays": {o: f"{strategy}.{frame:05}.{o}.png" for o in overlays},
                "rarn_nodes": i % 3 if strategy in ("simp-b", "coh-b") else 0,
                "vs_reference": psnr(picture, pictures[reference, frame]) if compared else None,
                "vs_full": psnr(picture, pictures["full", frame]),
                "wrong_pixels": i, "crack_pixels": 0})
        described.append({"strategy": strategy, "label": label(strategy), "frames": entries,
                          "summary": _summarise(entries, full)})
    return {"schema_version": "1.0.0", "selection": "list", "seed": seed, "frames": list(frames),
            "format": "png", "width": size[0], "height": size[1],
            "color_matrix": "BT.601 full range", "crack_margin": 2, "reference": reference,
            "complete": True, "overlays": list(overlays), "full": full, "strategies": described}


def _summarise(entries, full):
    shares = [e["wrong_pixels"] / max(f["covered_pixels"], 1) for e, f in zip(entries, full)]
    compared = all(e["vs_reference"] for e in entries)
    return {"vs_reference": _summarise_planes(entries, "vs_reference") if compared else None,
            "vs_full": _summarise_planes(entries, "vs_full"),
            "wrong_share": {"mean": float(np.mean(shares)), "max": float(np.max(shares))},
            "crack_pixels": sum(e["crack_pixels"] for e in entries)}


def _summarise_planes(entries, against):
    summary = {}
    for plane in ("y", "cb", "cr"):
        values = [e[against][plane] for e in entries if e[against][plane] is not None]
        summary[plane] = {
            "mean": float(np.mean(values)) if values else None,
            "stddev": float(np.std(values, ddof=1)) if len(values) > 1 else None,
            "count": len(values), "identical": len(entries) - len(values)}
    return summary
