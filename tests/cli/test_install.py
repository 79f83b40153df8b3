"""cmake --install, and another project that finds what it installed."""

import os
import pathlib
import re
import subprocess

import pytest
from plugins import FAULTY

PROJECT = """cmake_minimum_required(VERSION 3.21)
project(separate LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(hlodbench {version} REQUIRED)
if(WAY STREQUAL "by function")
  hlodbench_add_plugin(mine mine.cpp)
else()
  add_library(mine MODULE mine.cpp)
  target_link_libraries(mine PRIVATE hlodbench::plugin)
endif()
"""


def run(*command, **options):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=120,
                          **options)


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    build = os.environ.get("HLODBENCH_BUILD")
    if not build:
        pytest.skip("HLODBENCH_BUILD does not name a build; run the tests by ctest")
    folder = tmp_path_factory.mktemp("install") / "a prefix"
    result = run("cmake", "--install", build, "--prefix", folder)
    assert result.returncode == 0, result.stderr
    return folder


def configure(prefix, folder, version="", way="by function"):
    (folder / "CMakeLists.txt").write_text(PROJECT.format(version=version))
    (folder / "mine.cpp").write_text(FAULTY)
    return run("cmake", "-S", folder, "-B", folder / "build", f"-DWAY={way}",
               f"-DCMAKE_PREFIX_PATH={prefix}")


@pytest.mark.parametrize("way", ["by function", "by target"])
def test_a_separate_project_builds_a_plugin(prefix, tmp_path, way):
    made = configure(prefix, tmp_path, "0.1", way)
    assert made.returncode == 0, made.stderr
    built = run("cmake", "--build", tmp_path / "build")
    assert built.returncode == 0, built.stdout
    listed = run(prefix / "bin/hlodbench", "list", "--plugin", tmp_path / "build/libmine.so",
                 cwd="/")
    assert listed.returncode == 0, listed.stderr
    assert re.search(r"^  faulty +Faulty: of a test$", listed.stdout, re.MULTILINE)


def test_another_version_is_not_found(prefix, tmp_path):
    made = configure(prefix, tmp_path, "17.0")
    assert made.returncode != 0
    assert "17.0" in made.stderr


def test_installed_are_the_program_the_headers_and_the_package(prefix):
    headers = pathlib.Path(__file__).resolve().parents[2] / "src/traversals/plugin/hlodbench"
    names = {p.name for p in (prefix / "include/hlodbench").iterdir()}
    assert names == {p.name for p in headers.glob("*.h")}
    (config,) = prefix.rglob("hlodbenchConfig.cmake")
    for file in (*config.parent.iterdir(), *(prefix / "include/hlodbench").iterdir()):
        text = file.read_text()
        assert str(headers) not in text and os.environ["HLODBENCH_BUILD"] not in text
    assert run(prefix / "bin/hlodbench", "--version", cwd="/").returncode == 0
