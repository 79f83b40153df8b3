"""A night as Markdown, for a CI job to show."""

from .exact import describe_difference
from .timing import describe_change

MOST_DIFFERENCES = 12  # of one cell; pictures of every frame are as many lines


def make_summary(night, history):
    """The text. history: what was there before the night."""
    verdict = describe_verdict(night)
    lines = [f"# Night of {night['time_utc']}: {verdict}", "",
             f"Revision `{night['revision']}` on `{night['machine']['key']}` "
             f"({escape(night['machine']['gl_renderer'])}), earlier nights: "
             f"{len(history.nights)}.",
             "", "| Cell | exact | times | change [95 %] | why |", "|---|---|---|--:|---|"]
    for cell, verdicts in night["verdicts"].items():
        timing = verdicts["timing"] or {}
        reason = escape(timing.get("reason") or "not measured")
        if timing.get("stage"):
            reason += f"; most of it in {timing['stage']}"
        unclear = count_unclear(history, cell) if timing.get("verdict") == "UNCLEAR" else 0
        if unclear:
            reason += f"; night {unclear + 1} in a row that cannot tell"
        lines.append(f"| {cell} | {verdicts['exact']['verdict']} | {timing.get('verdict', '–')} "
                     f"| {_change(timing)} | {reason} |")
    for cell, verdicts in night["verdicts"].items():
        differences = verdicts["exact"]["differences"]
        if differences:
            lines += ["", f"**{cell}** differs from the accepted night "
                      f"`{verdicts['exact']['reference']}`:", ""]
            lines += [f"- {describe_difference(d)}" for d in differences[:MOST_DIFFERENCES]]
            if len(differences) > MOST_DIFFERENCES:
                lines.append(f"- and {len(differences) - MOST_DIFFERENCES} more")
    lines += ["", *_describe_timing(night["timing"])]
    if any(v["exact"]["differences"] for v in night["verdicts"].values()):
        lines += ["", "Wanted? `scripts/nightly.sh accept --why REASON`"]
    lines += [f"\nCrashed: {escape(line)}" for line in night.get("crashes", [])]
    lines += [f"\nProblem: {escape(problem)}" for problem in history.problems]
    return "\n".join(lines) + "\n"


def describe_verdict(night):
    """All of it in a few words."""
    counts = {}
    for verdicts in night["verdicts"].values():
        for part in ("exact", "timing"):
            name = (verdicts.get(part) or {}).get("verdict")
            if name in ("DIFFERENT", "SLOW", "FAST", "UNCLEAR"):
                counts[name] = counts.get(name, 0) + 1
    said = ", ".join(f"{count} {name}" for name, count in counts.items())
    return ("regression" if is_regression(night) else "nothing worse") + (f" ({said})" * bool(said))


def is_regression(night):
    """Whether the exit code is 1."""
    return any((v.get("exact") or {}).get("verdict") == "DIFFERENT"
               or (v.get("timing") or {}).get("verdict") == "SLOW"
               for v in night["verdicts"].values())


def count_unclear(history, cell):
    """How many of the last nights in a row had no timing verdict for a cell: a gate that never can
    tell is asleep."""
    count = 0
    for night in reversed(history.nights):
        timing = (night.data["verdicts"].get(cell) or {}).get("timing") or {}
        if timing.get("verdict") != "UNCLEAR":
            break
        count += 1
    return count


def _describe_timing(timing):
    if not timing:
        return ["Times were not measured."]
    against = (f"the baseline `{escape(timing['baseline'])}`, run beside each other"
               if timing["mode"] == "baseline" else "earlier nights, normalised by the calibration")
    share = timing["others_share"]
    busy = "unknown" if share is None else f"{100 * share:.0f} %"
    return [f"{timing['repetitions']} repetitions against {against}; other programs used {busy} of "
            f"the processors. Changes are of frame times: above 0 is slower. Least change: "
            f"{100 * timing['rule']['min_change']:g} %."]


def _change(timing):
    if timing.get("change") is None:
        return "–"
    return describe_change(timing["change"], timing["low"], timing["high"])


def escape(text):
    """A text for a cell of a table."""
    return str(text).replace("|", "\\|").replace("\n", " ")
