"""docs/writing-a-predictor.md: its files are built and its commands run exactly as printed."""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/writing-a-predictor.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(kind):
    """Of each block: the last file named before it, and its text."""
    for match in BLOCK.finditer(PAGE):
        if match[1] == kind:
            before = BLOCK.sub("", PAGE[: match.start()])
            names = re.findall(r"`([\w./-]+\.(?:cpp|txt))`", before)
            yield names[-1] if names else None, match[2]


COMMANDS = [text for _, text in blocks("sh")]
FILES = {name: text for kind in ("cpp", "cmake") for name, text in blocks(kind)}


def run(command, **options):
    result = subprocess.run(command, capture_output=True, text=True, timeout=300, **options)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def counts(path):
    return [line.split(",")[:9] for line in path.read_text().splitlines()]


class Place:
    """Where the page was followed: the folder, and what its commands printed."""

    def __init__(self, build, home):
        self.build = build
        self.folder = home / "new folder"
        self.folder.mkdir()
        clone = home / "clone"
        (clone / "build").mkdir(parents=True)
        (clone / "build/release").symlink_to(build)
        for name, text in FILES.items():
            if "/" not in name:
                (self.folder / name).write_text(text, encoding="utf-8")
        environment = {**os.environ, "HOME": str(home), "HLODBENCH_CACHE": str(home / "cache")}
        install, *others = COMMANDS
        run(["bash", "-euo", "pipefail", "-c", install], cwd=clone, env=environment)
        self.program = home / "hlodbench/bin/hlodbench"
        script = "\n".join(others)
        self.printed = run(["bash", "-euo", "pipefail", "-c", script], cwd=self.folder,
                           env=environment)

    def read(self, out):
        return json.loads((self.folder / out / "run.json").read_text())


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    build = os.environ.get("HLODBENCH_BUILD")
    if not build:
        pytest.skip("HLODBENCH_BUILD does not name a build; run the tests by ctest")
    return Place(pathlib.Path(build), tmp_path_factory.mktemp("home"))


def test_page_has_what_is_followed():
    assert sorted(FILES) == ["CMakeLists.txt", "smooth.cpp", "src/traversals/registry.cpp",
                             "sse_only.cpp"]
    assert len(COMMANDS) == 5
    for text in COMMANDS[0], *FILES.values():
        assert "..." not in text


def test_commands_give_rows_of_the_table(place):
    assert re.search(r"^  smooth-b +Smooth\(B\): ", place.printed, re.MULTILINE)
    assert "--set smooth-b.decay=: " in place.printed
    for label, times in (("Smooth\\(B\\)", 4), ("SSE only", 1), ("Coh\\(B\\)", 4)):
        rows = re.findall(rf"^\| {label} +\| this run +\| .*", place.printed, re.MULTILINE)
        assert len(rows) == times, label  # the first run has a table of pictures, too


def test_run_json_has_the_option(place):
    first, second = place.read("first")["options"], place.read("second")["options"]
    assert first["strategy_options"] == {"smooth-b": {"decay": 0.5}}
    assert second["strategy_options"] == {"smooth-b": {"decay": 0.9}}
    assert counts(place.folder / "first/smooth-b.0.csv") != counts(
        place.folder / "second/smooth-b.0.csv")


def test_what_the_page_says_of_errors(place):
    command = [place.program, "run", "--scene", "yard.hlod", "--session", "walk.session.json",
               "--out", "refused", "--plugin", "build/libsmooth.so", "--strategy", "smooth-b",
               "--set", "smooth-b.decay=2"]
    result = subprocess.run(command, cwd=place.folder, capture_output=True, text=True)
    assert result.returncode == 2
    assert result.stderr == (
        "hlodbench: --set smooth-b.decay: expected a number from 0 to 1, found '2'\n")


def test_same_file_in_the_tree_needs_one_line(place, tmp_path):
    """Links the program anew with the file of the page and the line of the page."""
    if not (place.build / "build.ninja").exists():
        pytest.skip("the build is not one of ninja")
    entry = "      // one line a file: PLUGIN_FILE(name),\n"
    registry = (ROOT / "src/traversals/registry.cpp").read_text()
    assert registry.count(entry) == 1
    line = FILES["src/traversals/registry.cpp"]
    assert line.count("\n") == 1
    (tmp_path / "registry.cpp").write_text(registry.replace(entry, entry + line))
    shutil.copy(place.folder / "smooth.cpp", tmp_path)
    database = json.loads((place.build / "compile_commands.json").read_text())
    (made,) = [e for e in database if e["file"].endswith("src/traversals/registry.cpp")]
    for name in ("registry", "smooth"):
        command = shlex.split(made["command"])
        command[command.index("-o") + 1] = str(tmp_path / f"{name}.o")
        command[command.index("-c") + 1] = str(tmp_path / f"{name}.cpp")
        run(command, cwd=made["directory"])
    link = run(["ninja", "-t", "commands", "bench/hlodbench"], cwd=place.build).splitlines()[-1]
    words = shlex.split(link.removeprefix(": && ").removesuffix(" && :"))
    program = tmp_path / "hlodbench"
    words[words.index("-o") + 1] = str(program)
    # before the libraries, so that the old registry is not asked for
    words[words.index("-o") : words.index("-o")] = [str(tmp_path / n) for n in
                                                    ("registry.o", "smooth.o")]
    run(words, cwd=place.build)
    assert "  smooth-b " in run([program, "list"])
    assert "--set smooth-b.decay=: " in run([program, "run", "--help"])
    out = tmp_path / "out"
    run([program, "run", "--scene", place.folder / "yard.hlod", "--session",
         place.folder / "walk.session.json", "--out", out, "--strategy", "smooth-b",
         "--latency", "draws:20", "--images", "none", "--set", "smooth-b.decay=0.9"])
    assert counts(out / "smooth-b.0.csv") == counts(place.folder / "second/smooth-b.0.csv")
