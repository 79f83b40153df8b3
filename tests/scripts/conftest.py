"""What the tests of the scripts that draw figures and reports share."""

import json
import pathlib
import subprocess
import sys

import pytest
from nightly_machine import Machine

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))


@pytest.fixture(scope="session")
def root():
    """The folder of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def result_schema():
    """The JSON Schema of run.json."""
    return json.loads((ROOT / "results" / "result.schema.json").read_text(encoding="utf-8"))


@pytest.fixture
def run_script(tmp_path):
    """Runs a script of scripts/: run_script("figures.py", ...) gives a CompletedProcess."""

    def run(name, *arguments, timeout=300, **options):
        return subprocess.run(
            [sys.executable, ROOT / "scripts" / name, *map(str, arguments)],
            cwd=tmp_path, timeout=timeout, capture_output=True, text=True, **options,
        )

    return run


@pytest.fixture
def machine(tmp_path):
    """Programs that are stand-ins, a history, and nights of scripts/nightly.sh with them."""
    return Machine(tmp_path)
