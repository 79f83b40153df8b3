"""A machine for the tests of scripts/nightly.sh: programs that are stand-ins, a history, nights."""

import json
import os
import pathlib
import subprocess

import fake_nightly

ROOT = pathlib.Path(__file__).resolve().parents[2]
CELL = "courtyard/coh-b"
TIMED = ("--cell", CELL, "--max-others", "100")  # whatever else the machine does
EXACT = ("--no-times",)
SCHEMA = json.loads((ROOT / "results/night.schema.json").read_text(encoding="utf-8"))


class Machine:
    """A history, a program and its baseline, and nights of them."""

    def __init__(self, folder):
        self.folder, self.history, self.count = folder, folder / "history", 0
        self.new = fake_nightly.add_program(folder / "new")
        self.base = fake_nightly.add_program(folder / "base", seed=1)
        (folder / "tmp").mkdir()
        self.options = ("--no-report",)
        self.environment = {**os.environ, "HLODBENCH_CACHE": str(folder / "cache"),
                            "TMPDIR": str(folder / "tmp")}

    def command(self, *arguments):
        self.count += 1
        self.out = self.folder / f"out-{self.count}"
        return [ROOT / "scripts/nightly.sh", "--history", self.history, "--out", self.out,
                "--program", self.new, "--calibration", "none", *self.options, *arguments]

    def run(self, *arguments, **state):
        fake_nightly.set_state(self.new, **state)
        return subprocess.run(self.command(*arguments), env=self.environment, cwd=self.folder,
                              capture_output=True, text=True, check=False, timeout=300)

    def compare(self, *arguments, **state):
        """A night against the baseline."""
        return self.run(*TIMED, "--baseline-program", self.base, *arguments, **state)

    def accept(self, *arguments):
        return subprocess.run([ROOT / "scripts/nightly.sh", "accept", "--history", self.history,
                               *arguments], env=self.environment, cwd=self.folder,
                              capture_output=True, text=True, check=False)

    def night(self):
        return json.loads((self.out / "night.json").read_text(encoding="utf-8"))

    def files(self):
        """In the order of writing: names of the same second are in any."""
        return sorted((p for p in self.history.rglob("*") if p.is_file()),
                      key=lambda path: path.stat().st_mtime_ns)

    def timing(self):
        """Of the last night: the verdict of CELL."""
        return self.night()["verdicts"][CELL]["timing"]
