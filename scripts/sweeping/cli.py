"""Options of scripts/sweep, and the order of things."""

import argparse
import fcntl
import os
import pathlib
import shutil
import sys
import tempfile

from .cell import find_flaw
from .description import read_description
from .errors import SweepError
from .inputs import Inputs
from .plan import CELLS, DONE, LOGS, READY, make_plan, name_of
from .program import Program
from .runner import (dry_run_snakemake, explain_failure, find_profile, find_snakemake,
                     run_snakemake)
from .table import TABLE, make_rows, write_table

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "release" / "bench" / "hlodbench"
LOCK = ".lock"

DESCRIPTION = """\
Runs `hlodbench run` for every cell of a matrix (scenes, sessions, s, t, tau, latency, sizes, ...)
that one YAML file describes, and writes OUT/sweep.csv: a row for each cell and strategy.
Cells whose times are wanted run one at a time with nothing beside them; the others on all cores."""

EPILOG = """\
example:
  scripts/sweep sessions/courtyard.sweep.yaml --out results/runs/courtyard-sweep
  scripts/report.py results/runs/courtyard-sweep

What is finished stays: the same command again runs only what is missing, failed or changed. Keys of
the file and a profile for Slurm: docs/sweeps.md.
Exit codes: 0 every cell is there; 1 some failed, and the others are there; 2 wrong usage or input;
130 interrupted."""


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(prog="sweep", description=DESCRIPTION, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE.yaml", type=pathlib.Path,
                        help="description of the sweep")
    parser.add_argument("--out", metavar="DIR", type=pathlib.Path, required=True,
                        help="folder of results; made if need be, and gone on with if it has some")
    parser.add_argument("--cores", metavar="N", type=int, default=count_cores(),
                        help="cores to use (default: all, here %(default)s)")
    parser.add_argument("--dry-run", action="store_true",
                        help="print what would be run, and run nothing")
    parser.add_argument("--profile", metavar="P",
                        help="Snakemake profile of a cluster: a folder, or one of "
                        "scripts/sweep_profiles (slurm); --cores then means nothing")
    parser.add_argument("--cache", metavar="DIR", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get("HLODBENCH_CACHE") or ROOT / ".cache"),
                        help="folder of hierarchies (default: $HLODBENCH_CACHE, or .cache in the "
                        "repository)")
    parser.add_argument("--hlodbench", metavar="PROGRAM", type=pathlib.Path, default=PROGRAM,
                        help="the program (default: build/release/bench/hlodbench in the "
                        "repository)")
    options = parser.parse_args(arguments)
    if not 1 <= options.cores <= 1024:
        parser.error(f"--cores: expected 1 to 1024, found {options.cores}")
    return options


def count_cores():
    """Those that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        return sweep(options)
    except SweepError as error:
        return fail(str(error))
    except OSError as error:
        return fail(f"{error.filename or options.out}: {error.strerror}")
    except KeyboardInterrupt:
        return 130


def sweep(options):
    """Everything; returns the exit code."""
    find_snakemake()
    profile = find_profile(options.profile) if options.profile else None
    program = Program(options.hlodbench)
    description = read_description(options.file, program.run_options)
    plan = make_plan(description, program, Inputs(), options.cache.resolve(),
                     None if profile else options.cores)
    for warning in description.warnings:
        print(f"sweep: warning: {warning}", file=sys.stderr)
    if options.dry_run:
        return show(options, plan, profile)
    options.out.mkdir(parents=True, exist_ok=True)
    with Lock(options.out):
        plan.pending = list_pending(options.out, plan, say=True)
        prepare(options.out, plan, is_local=not profile)
        interrupted = False
        if plan.pending:
            print(f"sweep: {len(plan.cells)} cells, {len(plan.pending)} to run", file=sys.stderr)
            interrupted = run_snakemake(options.out, options.cores, profile, plan.pending)
        return finish(options, plan, interrupted)


def list_pending(out, plan, say=False):
    """Identities of the cells without a whole result."""
    pending = []
    for identity in plan.cells:
        folder = out / CELLS / identity
        is_begun = (folder / "run.json").exists()
        flaw = find_flaw(folder) if is_begun else "none"
        if flaw:
            pending.append(identity)
        if flaw and is_begun and say:
            print(f"sweep: run again: {flaw}", file=sys.stderr)
    return pending


def prepare(out, plan, is_local):
    """Takes away what is left of earlier attempts at the pending cells, and writes the plan."""
    for name in (CELLS, DONE, LOGS, READY):
        (out / name).mkdir(exist_ok=True)
    for identity in plan.pending:
        shutil.rmtree(out / CELLS / identity, ignore_errors=True)
        (out / DONE / identity).unlink(missing_ok=True)
        (out / LOGS / f"{identity}.log").unlink(missing_ok=True)
    for key in plan.hierarchies:
        # Asked for anew each time: the program knows whether the file in the cache is up to date.
        (out / READY / key).unlink(missing_ok=True)
        (out / LOGS / f"{key}.log").unlink(missing_ok=True)
    if is_local:  # elsewhere jobs of an earlier attempt may still be at it
        for partial in (out / CELLS).glob(".*"):
            shutil.rmtree(partial, ignore_errors=True)
    plan.write(out)


def finish(options, plan, interrupted):
    """The table, and what is missing in it."""
    out = options.out
    failed = list_pending(out, plan)
    write_table(out, [row for row in make_rows(plan, out) if row["cell"] not in set(failed)])
    done = len(plan.cells) - len(failed)
    print(out / TABLE)
    if interrupted:
        print(f"sweep: interrupted: {done} of {len(plan.cells)} cells are there", file=sys.stderr)
        return 130
    for identity in failed:
        print(f"sweep: {describe(plan.cells[identity])}: failed: "
              f"{explain_failure(out, plan, identity)} ({LOGS}/{identity}.log)", file=sys.stderr)
    if failed:
        print(f"sweep: {len(failed)} of {len(plan.cells)} cells failed", file=sys.stderr)
    return 1 if failed else 0


def show(options, plan, profile):
    """A dry run: prints each cell, and lets Snakemake check the plan in a folder of its own."""
    plan.pending = list_pending(options.out, plan)
    for identity, cell in plan.cells.items():
        state = "to run" if identity in plan.pending else "done"
        kind = "timed" if cell.timing else f"counts, {cell.threads} cores"
        print(f"{identity} {state}: {describe(cell)} ({kind})")
    needed = {plan.cells[i].hierarchy for i in plan.pending} & plan.hierarchies.keys()
    print(f"{len(plan.cells)} cells, {len(plan.pending)} to run, on {len(needed)} hierarchies")
    with tempfile.TemporaryDirectory(prefix="sweep-") as folder:
        plan.write(folder)
        if plan.pending:
            dry_run_snakemake(folder, options.cores, profile)
    return 0


def describe(cell):
    """A cell's parameters on one line."""
    return " ".join(f"{key.removeprefix('option.')}="
                    f"{name_of(value) if key in ('scene', 'session') else value}"
                    for key, value in cell.parameters.items())


class Lock:
    """Keeps a second sweep out of the folder; gone with the process, however it ends."""

    def __init__(self, folder):
        self._path = folder / LOCK

    def __enter__(self):
        self._file = open(self._path, "w", encoding="utf-8")
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._file.close()
            raise SweepError(f"{self._path.parent}: expected a folder that no other sweep is "
                             "working in, found one at work") from None

    def __exit__(self, *_):
        self._file.close()


def fail(message):
    print(f"sweep: {message}", file=sys.stderr)
    return 2
