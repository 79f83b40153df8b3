"""The C++ sources are laid out as .clang-format says, by clang-format 14 as in Debian 12."""

import pathlib
import re
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION = 14  # others lay out some lines differently


def find_clang_format():
    for name in (f"clang-format-{VERSION}", "clang-format"):
        exe = shutil.which(name)
        if exe:
            text = subprocess.run([exe, "--version"], capture_output=True, text=True).stdout
            if re.search(rf"version {VERSION}\.", text):
                return exe
    return None


CLANG_FORMAT = find_clang_format()
if CLANG_FORMAT is None:
    pytest.skip(f"clang-format {VERSION} is not installed", allow_module_level=True)


def badly_laid_out(files):
    """The first complaint about each file, as "path:line:column: ..."."""
    result = subprocess.run(
        [CLANG_FORMAT, f"--style=file:{ROOT / '.clang-format'}", "--dry-run", "--Werror", *files],
        capture_output=True,
        text=True,
    )
    first = {}
    for line in result.stderr.splitlines():
        match = re.match(r"(.+?):\d+:\d+: error:", line)
        if match:
            first.setdefault(match[1], line)
    assert bool(first) == (result.returncode != 0), result.stderr
    return list(first.values())


def test_sources_are_laid_out():
    files = [
        str(path)
        for folder in ("src", "bench", "tests")
        for path in sorted((ROOT / folder).rglob("*"))
        if path.suffix in (".h", ".cpp")
    ]
    assert files
    complaints = badly_laid_out(files)
    assert complaints == [], "run: clang-format -i FILE"


def test_check_finds_a_bad_file(tmp_path):
    bad = tmp_path / "bad file.cpp"
    bad.write_text("int  main( ){return 0 ;}\n")
    assert len(badly_laid_out([str(bad)])) == 1
