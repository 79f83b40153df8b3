"""What the trend page says of each night: revision, subject, verdicts, who accepted it, links."""

import os
import pathlib
import urllib.parse

from .exact import DIFFERENT, describe_difference
from .summary import describe_verdict, is_regression

MOST_DIFFERENCES = 3  # of one cell; the night's summary has all
LINKS = {"summary": "summary.md", "report": "report.html"}  # in the folder of the night's results


def describe_nights(history, subjects, folder, page):
    """A list, in order. subjects: of commits, by revision. folder: of the history. page: the file
    that links start from."""
    accepted = {}
    for entry in history.acceptances:
        accepted.setdefault(entry.data["night"], []).append(entry.data)
    described = []
    for night in history.nights:
        data = night.data
        described.append({
            "id": night.id,
            "time": data["time_utc"],
            "revision": data["revision"],
            "subject": subjects.get(data["revision"], ""),
            "verdict": describe_verdict(data),
            "regression": is_regression(data),
            "accepted": [{key: entry[key] for key in ("time_utc", "who", "why", "cells")}
                         for entry in accepted.get(night.id, [])],
            "links": find_links(data, folder, page),
            "cells": {cell: describe_cell(verdicts)
                      for cell, verdicts in data["verdicts"].items()},
        })
    return described


def list_lost(history):
    """A line for each acceptance whose night is not there."""
    known = {night.id for night in history.nights}
    return [f"{entry.id}.json: accepts the night {entry.data['night']}, which is not there"
            for entry in history.acceptances if entry.data["night"] not in known]


def describe_cell(verdicts):
    """[exact verdict, timing verdict, why]; texts, empty for none."""
    exact, timing = verdicts.get("exact") or {}, verdicts.get("timing") or {}
    reasons = []
    if exact.get("verdict") == DIFFERENT:
        reasons += describe_differences(exact.get("differences"))
    if timing.get("verdict"):
        reasons.append(str(timing.get("reason") or ""))
    if timing.get("stage"):
        reasons.append(f"most of it in {timing['stage']}")
    said = "; ".join(filter(None, reasons))
    return [exact.get("verdict") or "", timing.get("verdict") or "", said]


def describe_differences(differences):
    """The first as texts, and how many more there are. Files of others may have anything there."""
    texts = []
    for difference in differences if isinstance(differences, list) else []:
        try:
            texts.append(describe_difference(difference))
        except (TypeError, KeyError, ValueError, ZeroDivisionError):
            texts.append("a difference that cannot be read")
    left = len(texts) - MOST_DIFFERENCES
    return texts[:MOST_DIFFERENCES] + ([f"and {left} more"] if left > 0 else [])


def find_links(data, folder, page):
    """[text, URL relative to the page] of what the night left and is still there."""
    context = data.get("context")
    place = context.get("results") if isinstance(context, dict) else None
    if not isinstance(place, str) or not place or "\0" in place:
        return []
    found = []
    for text, name in LINKS.items():
        path = pathlib.Path(folder) / place / name
        try:
            is_there = path.is_file()
        except OSError:  # a name that is too long, say
            is_there = False
        if is_there:
            relative = os.path.relpath(path, pathlib.Path(page).parent)
            # "./", so that no name is taken for the scheme of a URL.
            found.append([text, "./" + urllib.parse.quote(relative)])
    return found
