"""What the tests of the program and of the scripts share."""

import os
import pathlib
import shutil
import subprocess

import pytest
from small_scene import write_walls
from stand_ins import CMAKE, DPKG_QUERY, HLODBENCH, PYTHON, add_program

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def root():
    """The folder of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def hlodbench():
    """Runs the program: hlodbench("list", env={...}) gives a CompletedProcess with text output."""
    exe = os.environ.get("HLODBENCH_EXE")
    if not exe:
        pytest.skip("HLODBENCH_EXE does not name the program; run the tests by ctest")

    def run(*arguments, env=None, timeout=300, **options):
        return subprocess.run(
            [exe, *map(str, arguments)],
            env={**os.environ, **(env or {})},
            timeout=timeout,
            capture_output=True,
            text=True,
            **options,
        )

    return run


@pytest.fixture(scope="module")
def walls_hlod(hlodbench, tmp_path_factory):
    """The hierarchy of a small scene, not to be written to."""
    folder = tmp_path_factory.mktemp("walls")
    file = folder / "walls.hlod"
    result = hlodbench("build", write_walls(folder), "-o", file, "--max-triangles", "200")
    assert result.returncode == 0, result.stderr
    return file


@pytest.fixture
def copy(tmp_path):
    """A copy of the scripts at a path with spaces."""
    folder = tmp_path / "a copy of it"
    shutil.copytree(ROOT / "scripts", folder / "scripts")
    return folder


@pytest.fixture
def environment(tmp_path):
    """An environment in which cmake and hlodbench are stand-ins that log how they are called."""
    programs = tmp_path / "stand ins"
    add_program(programs, "cmake", CMAKE)
    fake = add_program(tmp_path / "fake", "hlodbench", HLODBENCH)
    add_program(programs, "dpkg-query", DPKG_QUERY)
    inherited = {k: v for k, v in os.environ.items() if not k.startswith("HLODBENCH_")}
    return {
        **inherited,
        "PATH": f"{programs}:{os.environ['PATH']}",
        "LOG": str(tmp_path / "log"),
        "FAKE_HLODBENCH": str(fake),
        "HLODBENCH_PYTHON": str(add_program(tmp_path / "fake", "python", PYTHON)),
    }
