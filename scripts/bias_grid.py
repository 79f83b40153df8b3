#!/usr/bin/env python3
"""Runs Coh(B) with a grid of s and t and prints what each costs, as a Markdown table.

For each pair the session is replayed with Bool and Coh(B), interleaved, by `hlodbench run`; its
result folder is kept in OUT and a pair that is already there is not run again, so that an
interrupted grid goes on where it stopped. s = 0 gives B = mu whatever t is: it is run once. The
table is also written as OUT/grid.csv. For other parameters, and all cores, see scripts/sweep.
"""

import argparse
import pathlib
import sys

from run_cells import DEFAULT_PROGRAM, BadInput, Progress, read_table, run_cell, write_rows

COLUMNS = ("s", "t", "dn", "dn_share", "rarn", "delayed_share", "fps", "speedup", "speedup_low",
           "speedup_high", "psnr_y", "psnr_cb", "psnr_cr", "psnr_identical", "psnr_full_y")


def parse_numbers(text):
    """A comma-separated list of numbers from 0 to 1."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected numbers, found {text!r}") from None
    for number in numbers:
        if not 0 <= number <= 1:
            raise argparse.ArgumentTypeError(f"expected numbers from 0 to 1, found {number:g}")
    return numbers


def plan(s_values, t_values):
    """The pairs to run, s outermost; for s = 0 the first t alone."""
    pairs = []
    for s in dict.fromkeys(s_values):
        pairs += [(s, t) for t in (list(dict.fromkeys(t_values)) if s > 0 else t_values[:1])]
    return pairs


def run_pair(options, s, t, folder):
    """Replays the session with one pair into `folder`, which appears when it is complete."""
    run_cell(options.hlodbench,
             ["--scene", options.scene, "--session", options.session, "--strategy", "bool,coh-b",
              "--s", s, "--t", t, "--repetitions", options.repetitions,
              "--images", options.images], folder, f"s = {s:g}, t = {t:g}")


def read_row(options, s, t, folder):
    """The grid's row of one pair, by column; an absent value is an empty text."""
    rows = read_table(options.hlodbench, folder, ["bool", "coh-b"])
    coh, boolean = rows["coh-b"], rows["bool"]
    row = {"s": f"{s:g}", "t": f"{t:g}" if s > 0 else ""}
    row |= {key: coh["ours_" + key] for key in ("dn", "rarn", "delayed_share", "fps", "psnr_y",
                                                "psnr_cb", "psnr_cr", "psnr_identical",
                                                "psnr_full_y")}
    row |= {key: boolean["ours_" + key] for key in ("speedup", "speedup_low", "speedup_high")}
    if coh["ours_dn"] and boolean["ours_dn"]:
        row["dn_share"] = repr(float(coh["ours_dn"]) / float(boolean["ours_dn"]))
    return row


def format_table(rows):
    """The rows as Markdown."""

    def number(row, key, digits, factor=1.0):
        return f"{factor * float(row[key]):.{digits}f}" if row.get(key) else "–"

    lines = ["| s | t | DN | DN / Bool | RARN | D/DN, % | FPS | Speedup over Bool | Y, dB | Cb, dB "
             "| Cr, dB | Y of full model, dB |", "|--:" * 12 + "|"]
    for row in rows:
        speedup = number(row, "speedup", 2)
        if row.get("speedup_low") and has_interval(row):
            speedup += f" [{number(row, 'speedup_low', 2)}, {number(row, 'speedup_high', 2)}]"
        cells = [row["s"], row["t"] or "any", number(row, "dn", 1), number(row, "dn_share", 3),
                 number(row, "rarn", 2), number(row, "delayed_share", 2, 100.0),
                 number(row, "fps", 1), speedup, number(row, "psnr_y", 2),
                 number(row, "psnr_cb", 2), number(row, "psnr_cr", 2),
                 number(row, "psnr_full_y", 2)]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def has_interval(row):
    """Whether the speedup has an interval that says something: more than one repetition."""
    return row["speedup_low"] != row["speedup_high"]


def parse_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", required=True, help="hierarchy (.hlod), scene or mesh file")
    parser.add_argument("--session", required=True, help="camera session (.json)")
    parser.add_argument("--out", required=True, type=pathlib.Path,
                        help="folder of the result folders and of grid.csv")
    parser.add_argument("--s", type=parse_numbers, default=[0.0, 0.5, 1.0],
                        help="values of s, 0 to 1, comma-separated (0,0.5,1)")
    parser.add_argument("--t", type=parse_numbers, default=[0.0, 0.1, 0.25, 0.5],
                        help="values of t, 0 to 1, comma-separated (0,0.1,0.25,0.5)")
    parser.add_argument("--repetitions", type=int, default=1, help="of each replay (1)")
    parser.add_argument("--images", default="20",
                        help="pictures to compare, as for `hlodbench run` (20)")
    parser.add_argument("--hlodbench", default=DEFAULT_PROGRAM,
                        help="the program (build/release/bench/hlodbench)")
    return parser.parse_args()


def main():
    """Runs what is missing and prints the table."""
    options = parse_arguments()
    try:
        options.out.mkdir(parents=True, exist_ok=True)
        pairs = plan(options.s, options.t)
        rows, progress = [], Progress(len(pairs))
        for i, (s, t) in enumerate(pairs):
            folder = options.out / (f"s{s:g}-t{t:g}" if s > 0 else "s0")
            if not folder.exists():
                progress.begin(i + 1, f"s = {s:g}, t = {t:g}")
                run_pair(options, s, t, folder)
                progress.end()
            rows.append(read_row(options, s, t, folder))
            write_rows(options.out / "grid.csv", COLUMNS, rows)
        print(format_table(rows), end="")
    except (BadInput, OSError) as error:
        print(f"bias_grid.py: {error}".replace("\n", " "), file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
