"""Runs Snakemake on a plan: progress, signals, and why a job failed."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from . import child
from .errors import SweepError
from .plan import CELLS, LOGS

SNAKEFILE = pathlib.Path(__file__).resolve().parent / "Snakefile"
PROFILES = pathlib.Path(__file__).resolve().parents[1] / "sweep_profiles"
SAID = "snakemake.log"  # in LOGS
POLL_S = 0.2


def find_snakemake():
    """The program. Raises SweepError."""
    found = shutil.which("snakemake")
    if not found:
        raise SweepError("expected the program snakemake (Debian: snakemake), found none")
    return found


def find_profile(name):
    """A folder with a Snakemake profile: a path, one of scripts/sweep_profiles, or a name that
    Snakemake finds by itself."""
    for folder in (pathlib.Path(name), PROFILES / name):
        if (folder / "config.yaml").is_file():
            return str(folder.resolve())
    if os.sep in name:
        raise SweepError(f"--profile: expected a folder with config.yaml, found {name!r}")
    return name


def make_command(folder, cores, profile, dry_run=False):
    """Snakemake's command line. The results are whole or not there, so its own marks of unfinished
    files, which a killed process leaves behind, would only be in the way; so would its lock."""
    command = [find_snakemake(), "--snakefile", str(SNAKEFILE), "--directory", str(folder),
               "--keep-going", "--nolock", "--ignore-incomplete", "--rerun-triggers", "mtime",
               "--scheduler", "greedy", "--nocolor"]
    if profile:
        command += ["--profile", profile]
    else:
        command += ["--cores", str(cores), "--resources", "exclusive=1"]
    return [*command, "--dry-run"] if dry_run else command


def run_snakemake(folder, cores, profile, pending):
    """Runs the pending cells; returns whether it was interrupted. What Snakemake says goes to a
    log."""
    said = pathlib.Path(folder, LOGS, SAID)
    progress = Progress(folder, pending)
    with open(said, "w", encoding="utf-8") as log:
        # In a session of its own: Ctrl-C reaches it once, from here, whoever else got it.
        process = child.start(make_command(folder, cores, profile), signal.SIGKILL, stdout=log,
                              stderr=subprocess.STDOUT, start_new_session=True)
        stop = Stop(process)
        while process.poll() is None:
            progress.update()
            time.sleep(POLL_S)
        progress.update()
        stop.restore()
    return stop.asked


def dry_run_snakemake(folder, cores, profile):
    """Raises SweepError if Snakemake refuses the plan or the profile."""
    done = subprocess.run(make_command(folder, cores, profile, dry_run=True), capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        lines = (done.stderr + done.stdout).strip().splitlines() or ["no message"]
        raise SweepError(f"snakemake --dry-run ended with code {done.returncode}: {lines[-1]}")


class Stop:
    """Passes the first SIGINT, SIGTERM or SIGHUP on to Snakemake and its jobs; not those that are
    ignored, as SIGHUP is under nohup."""

    def __init__(self, process):
        self.asked, self._process = False, process
        self._before = {s: signal.signal(s, self._pass_on)
                        for s in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
                        if signal.getsignal(s) != signal.SIG_IGN}

    def _pass_on(self, *_):
        if not self.asked:
            self.asked = True
            print("sweep: stopping; finished cells stay", file=sys.stderr)
            os.killpg(self._process.pid, signal.SIGINT)

    def restore(self):
        for which, handler in self._before.items():
            signal.signal(which, handler)


class Progress:
    """A line on stderr for every cell that is done, with what is left by the pace so far."""

    def __init__(self, folder, pending):
        self._places = [pathlib.Path(folder, CELLS, cell, "run.json") for cell in pending]
        self._all, self._start = len(pending), time.monotonic()

    def update(self):
        before = len(self._places)
        self._places = [place for place in self._places if not place.exists()]
        if len(self._places) == before:
            return
        done = self._all - len(self._places)
        minutes = (time.monotonic() - self._start) / done * len(self._places) / 60
        left = f", about {minutes:.0f} min left" if minutes >= 1 else ""
        print(f"sweep: {done} of {self._all} cells{left}", file=sys.stderr, flush=True)


def explain_failure(folder, plan, identity):
    """Why a cell is not there, as one line."""
    keys = [identity]
    if plan.cells[identity].hierarchy in plan.hierarchies:
        keys.append(plan.cells[identity].hierarchy)
    for key in keys:
        last = _last_line(pathlib.Path(folder, LOGS, f"{key}.log"))
        # Without a log of its own the cell was not begun: its hierarchy failed, or nothing ran.
        if last:
            return last
    said = _last_line(pathlib.Path(folder, LOGS, SAID))
    return f"not run; {pathlib.Path(LOGS, SAID)} ends with: {said or 'nothing'}"


def _last_line(path):
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError:
        return ""
    return next((line.strip() for line in reversed(lines) if line.strip()), "")
