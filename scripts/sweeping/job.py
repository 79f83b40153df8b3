#!/usr/bin/env python3
"""One job of a sweep, as the Snakefile calls it in the sweep's folder.

job.py hierarchy KEY THREADS, or job.py cell IDENTITY THREADS. What it says goes to LOGS/KEY.log, whose
last line is the reason if it fails.
"""

import os
import pathlib
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from sweeping import child  # noqa: E402
from sweeping.cell import CellFailed, find_flaw, run_whole  # noqa: E402
from sweeping.plan import CELLS, DONE, LOGS, READY, read_plan  # noqa: E402
from sweeping.program import hash_file  # noqa: E402


def build(plan, key, threads, log):
    """Builds a hierarchy unless its file is there and up to date, which the program finds out."""
    hierarchy = plan.hierarchies[key]
    os.makedirs(os.path.dirname(hierarchy.file), exist_ok=True)
    command = [plan.program, "build", hierarchy.scene, "-o", hierarchy.file,
               "--threads", threads, *hierarchy.arguments]
    with child.start(command, stdout=log, stderr=subprocess.STDOUT) as process:
        code = process.wait()
    if code != 0:
        raise CellFailed(f"hlodbench build ended with code {code}", code)
    pathlib.Path(READY, key).touch()


def run(plan, identity, threads, log):
    """Runs a cell."""
    cell, folder = plan.cells[identity], pathlib.Path(CELLS, identity)
    if folder.exists() and not find_flaw(folder):  # by a job of an earlier attempt, on a cluster
        pathlib.Path(DONE, identity).touch()
        return
    for path, expected in ((plan.program, plan.program_hash), (cell.session, cell.session_hash)):
        if hash_file(path) != expected:
            raise CellFailed(f"{path}: changed while the sweep ran; start it again")
    planned = plan.hierarchies.get(cell.hierarchy)
    command = [plan.program, "run", "--scene", planned.file if planned else cell.hierarchy,
               "--session", cell.session, *cell.arguments]
    environment = dict(os.environ)
    if not cell.timing:
        # Mesa's software rasteriser has so many threads besides the one that draws.
        environment["LP_NUM_THREADS"] = str(int(threads) - 1)
    run_whole(command, folder, find_flaw, stdout=log, stderr=subprocess.STDOUT, env=environment)
    pathlib.Path(DONE, identity).touch()


def main(arguments):
    child.die_with_parent()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that what is begun is removed
    kind, key, threads = arguments
    os.makedirs(LOGS, exist_ok=True)
    with open(pathlib.Path(LOGS, f"{key}.log"), "w", encoding="utf-8") as log:
        try:
            {"hierarchy": build, "cell": run}[kind](read_plan("."), key, threads, log)
            return 0
        except CellFailed as error:
            # The program has said why, unless it died without a word.
            if error.code is None or error.code < 0 or log_is_empty(log):
                print(f"{error}", file=log)
        except OSError as error:
            print(f"{error.filename}: {error.strerror}", file=log)
        except KeyboardInterrupt:
            print("interrupted", file=log)
            return 130
    return 1


def log_is_empty(log):
    return os.fstat(log.fileno()).st_size == 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
