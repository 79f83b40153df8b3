"""The program that a sweep runs: its hash, and the options it knows."""

import hashlib
import os
import re
import subprocess

from .errors import SweepError

OPTION = re.compile(r"^\s+(?:-\w,)?--([a-z][a-z0-9-]*)\b(?![^\n]*REQUIRED)", re.MULTILINE)
FLAG = re.compile(r"^\s+(?:-\w,)?--([a-z][a-z0-9-]*) {2,}", re.MULTILINE)


def hash_file(path):
    """SHA-256 of a file's bytes, as hex digits. Raises OSError."""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


class Program:
    """hlodbench, or what stands in for it."""

    def __init__(self, path):
        """Raises SweepError where it cannot be run."""
        self.path = os.path.abspath(path)
        try:
            self.hash = hash_file(path)
        except OSError as error:
            raise SweepError(f"{path}: expected the program hlodbench: {error.strerror}; build it, "
                             "or name it by --hlodbench") from None
        run_help, build_help = self._read_help("run"), self._read_help("build")
        self.build_options = frozenset(OPTION.findall(build_help)) - {"help", "output"}
        self.run_options = frozenset(OPTION.findall(run_help)) | self.build_options
        self.flags = frozenset(FLAG.findall(run_help))  # those without a value

    def _read_help(self, command):
        try:
            done = subprocess.run([self.path, command, "--help"], capture_output=True, text=True,
                                  timeout=60, check=False)
        except (OSError, UnicodeDecodeError, subprocess.TimeoutExpired) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise SweepError(f"{self.path}: expected the program hlodbench: {reason}") from None
        if done.returncode != 0 or not OPTION.search(done.stdout):
            raise SweepError(f"{self.path} {command} --help: expected the options of hlodbench, "
                             f"found exit code {done.returncode}")
        return done.stdout
