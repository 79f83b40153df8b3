#!/usr/bin/env python3
"""Measures what each debatable reading of the paper amounts to (docs/ablations.md).

Replays the session once as hlodbench does by default and once with each reading, every one with
the strategies that it concerns and with Bool, by `hlodbench run`. By default the latency is fixed,
so that node counts are exact and any difference from the default is the reading's. The result
folders stay in OUT; one that is there is not run again, so that an interrupted measurement goes on
where it stopped. Writes OUT/ablations.csv and OUT/ablations.md and prints the latter.

Exit codes: 0 all was run; 1 a run failed, the others are in the table; 2 wrong usage or bad input;
130 interrupted.
"""

import argparse
import json
import pathlib
import sys
from dataclasses import dataclass

from atomic_file import write_text_atomically
from run_cells import (DEFAULT_PROGRAM, BadInput, CellFailed, Progress, read_comparison, read_table,
                       run_cell, write_rows)

BIASED = ("sw-b", "simp-b", "coh-b")
EVERY = ("bool", *BIASED)


@dataclass(frozen=True)
class Reading:
    """Options of `hlodbench run` that differ from the default, and whom they concern."""

    name: str
    options: tuple
    strategies: tuple


READINGS = (
    Reading("default", (), EVERY),
    Reading("stale-children", ("--stale-children", "literal"), ("coh-b",)),
    Reading("zero-pixels", ("--zero-pixels", "literal"), ("coh-b",)),
    Reading("pull-up", ("--pull-up", "delay"), ("coh-b",)),
    Reading("simp-mean", ("--simp", "mean"), ("simp-b",)),
    Reading("render-guard", ("--render-guard", "off"), ("bool", "simp-b", "coh-b")),
    Reading("near-plane", ("--near-plane", "query"), EVERY),
    Reading("query-faces", ("--query-faces", "both"), BIASED),
    Reading("mu-area", ("--mu-area", "unclipped"), BIASED),
    Reading("s-0", ("--s", "0"), BIASED),
    Reading("t-0.1", ("--t", "0.1"), BIASED),
    Reading("t-0.5", ("--t", "0.5"), BIASED),
)
DEFAULT = READINGS[0]

# Column -> key of `hlodbench table` without "ours_", and of `hlodbench compare`.
VALUES = {"dn": ("dn", "dn"), "rarn": ("rarn", "rarn"), "d": ("d", "d"), "fps": ("fps", "fps"),
          "psnr_y": ("psnr_y", "vs_reference.y"), "psnr_full_y": ("psnr_full_y", "vs_full.y")}
COLUMNS = ("reading", "options", "strategy", "repetitions", "frames", "dn_different_frames",
           "psnr_identical", *(c + part for c in VALUES
                               for part in ("", "_change", "_change_low", "_change_high",
                                            "_verdict")), "error")


def parse_readings(text):
    """A comma-separated list of names; the default is always among them, first."""
    known = {reading.name: reading for reading in READINGS}
    for name in (names := text.split(",")):
        if name not in known:
            raise argparse.ArgumentTypeError(
                f"expected some of {', '.join(known)}, found {name!r}")
    return [r for r in READINGS if r is DEFAULT or r.name in names]


def parse_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", required=True, help="hierarchy (.hlod), scene or mesh file")
    parser.add_argument("--session", required=True, help="camera session (.json)")
    parser.add_argument("--out", required=True, type=pathlib.Path,
                        help="folder of the result folders and of the table")
    parser.add_argument("--readings", type=parse_readings, default=list(READINGS),
                        help="which, comma-separated (all): "
                             + ", ".join(reading.name for reading in READINGS))
    parser.add_argument("--latency", default="draws:12",
                        help="as for `hlodbench run` (draws:12); with gl, counts are not exact")
    parser.add_argument("--repetitions", type=int, default=1, help="of each replay (1)")
    parser.add_argument("--images", default="20",
                        help="pictures to compare, as for `hlodbench run` (20)")
    parser.add_argument("--size", default="", help="viewport WIDTHxHEIGHT, pixels (the session's)")
    parser.add_argument("--hlodbench", default=DEFAULT_PROGRAM,
                        help="the program (build/release/bench/hlodbench)")
    return parser.parse_args()


def check_settings(options):
    """Refuses a folder whose cells were run with other settings."""
    settings = {"scene": str(pathlib.Path(options.scene).resolve()),
                "session": str(pathlib.Path(options.session).resolve()),
                "latency": options.latency, "repetitions": options.repetitions,
                "images": options.images, "size": options.size}
    path = options.out / "settings.json"
    if not path.exists():
        write_text_atomically(path, json.dumps(settings, indent=2) + "\n")
        return
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise BadInput(f"{path}: expected JSON: {error}") from None
    for key, value in settings.items():
        found = stored.get(key) if isinstance(stored, dict) else None
        if found != value:
            raise BadInput(f"{path}: {key}: the runs here have {found!r}, asked for is {value!r}; "
                           "choose another --out")


def run_reading(options, reading):
    """Runs one reading into its folder; Bool is in each, as the reference of the pictures."""
    arguments = ["--scene", options.scene, "--session", options.session,
                 "--strategy", ",".join(dict.fromkeys(("bool", *reading.strategies))),
                 "--latency", options.latency, "--repetitions", options.repetitions,
                 "--images", options.images, *reading.options]
    if options.size:
        arguments += ["--size", options.size]
    run_cell(options.hlodbench, arguments, options.out / reading.name, reading.name)


def read_rows(options, reading):
    """The table's rows of one reading, one a strategy; what is absent is an empty text."""
    folder = options.out / reading.name
    table = read_table(options.hlodbench, folder, reading.strategies)
    rows = []
    for strategy in reading.strategies:
        ours = table[strategy]
        row = {"reading": reading.name, "options": " ".join(reading.options),
               "strategy": strategy, "repetitions": ours["repetitions"], "frames": ours["frames"],
               "psnr_identical": ours["ours_psnr_identical"]}
        row |= {column: ours["ours_" + key] for column, (key, _) in VALUES.items()}
        if reading is not DEFAULT:
            add_changes(row, read_comparison(options.hlodbench, options.out / DEFAULT.name, folder,
                                             strategy))
        rows.append(row)
    return rows


def add_changes(row, comparison):
    """The differences from the default: in the values' own units, with 95 % intervals."""
    for column, (_, key) in VALUES.items():
        found = comparison.get(key)
        if not found or not found["difference"]:
            continue
        difference = found["difference"]
        row[column + "_change"] = repr(difference["value"])
        for bound in ("low", "high"):
            if difference[bound] is not None:
                row[f"{column}_change_{bound}"] = repr(difference[bound])
        row[column + "_verdict"] = found["verdict"]
    if comparison.get("dn", {}).get("different_frames") is not None:
        row["dn_different_frames"] = str(comparison["dn"]["different_frames"])


def format_table(rows, options):
    """The rows as Markdown."""

    def number(row, key, digits, sign=""):
        return f"{float(row[key]):{sign}.{digits}f}" if row.get(key) else "–"

    def change(row, key, digits):
        text = number(row, key + "_change", digits, "+")
        low, high = row.get(key + "_change_low"), row.get(key + "_change_high")
        if low and high and low != high:
            text += f" [{float(low):+.{digits}f}, {float(high):+.{digits}f}]"
        return text

    header = ["Reading", "Strategy", "DN", "change [95 %]", "frames that differ", "RARN", "change",
              "D", "change", "FPS", "Y, dB", "change", "Y of full model, dB", "change"]
    lines = ["| " + " | ".join(header) + " |", "|---|---|" + "--:|" * (len(header) - 2)]
    for row in rows:
        name = row["reading"] + (f" (`{row['options']}`)" if row["options"] else "")
        if row.get("error"):
            lines.append(f"| {name} | {row['error']} |" + " – |" * (len(header) - 2))
            continue
        against_bool = number(row, "psnr_y", 2)
        if row.get("psnr_identical") not in (None, "", "0"):
            against_bool += f", {row['psnr_identical']} identical"
        cells = [name, row["strategy"], number(row, "dn", 1), change(row, "dn", 2),
                 row.get("dn_different_frames") or "–", number(row, "rarn", 2),
                 number(row, "rarn_change", 2, "+"), number(row, "d", 2),
                 number(row, "d_change", 2, "+"), number(row, "fps", 1), against_bool,
                 number(row, "psnr_y_change", 2, "+"), number(row, "psnr_full_y", 2),
                 number(row, "psnr_full_y_change", 2, "+")]
        lines.append("| " + " | ".join(cells) + " |")
    size = options.size or "the session's size"
    plural = "repetition" if options.repetitions == 1 else "repetitions"
    lines += ["", f"Latency {options.latency}, {size}; FPS over {options.repetitions} {plural}. "
              "Changes are from the default; the interval is a bootstrap over frames. Y: PSNR "
              "against Bool with the same reading. Identical planes have no finite PSNR: means are "
              "over the other frames, changes over those that are finite in both."]
    return "\n".join(lines) + "\n"


def measure(options):
    """Runs what is missing and writes the table; the errors of what failed."""
    options.out.mkdir(parents=True, exist_ok=True)
    check_settings(options)
    rows, errors, progress = [], [], Progress(len(options.readings))
    for number, reading in enumerate(options.readings, 1):
        try:
            if not (options.out / reading.name).exists():
                progress.begin(number, " ".join((reading.name, *reading.options)))
                run_reading(options, reading)
                progress.end()
            rows += read_rows(options, reading)
        except CellFailed as error:
            if reading is DEFAULT:
                raise  # nothing to compare with
            errors.append(str(error))
            rows.append({"reading": reading.name, "options": " ".join(reading.options),
                         "error": "failed"})
        write_rows(options.out / "ablations.csv", COLUMNS, rows)
        write_text_atomically(options.out / "ablations.md", format_table(rows, options))
    print(format_table(rows, options), end="")
    return errors


def main():
    """Measures, and says what failed."""
    options = parse_arguments()
    try:
        errors = measure(options)
    except (BadInput, OSError) as error:
        print(f"ablations.py: {error}".replace("\n", " "), file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
    for error in errors:
        print(f"ablations.py: failed: {error}", file=sys.stderr)
    sys.exit(1 if errors else 0)


if __name__ == "__main__":
    main()
