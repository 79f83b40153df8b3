"""What happens to a hierarchy while the program works on it: another one builds it too, or somebody
cuts it off. A right result or one line of error, and no temporary file left."""

import json
import struct
import subprocess

import pytest
from refusal import BAD_INPUT, complain, hlod, place  # noqa: F401 (fixtures)
from small_scene import past_the_walls, write_session, write_walls
from test_run_results import start

SMALL_NODES = ["--max-triangles", "100"]


def succeed_together(*commands):
    """Runs the commands at the same time; all of them succeed."""
    processes = [start(command) for command in commands]
    for process in processes:
        _, errors = process.communicate(timeout=120)
        assert process.returncode == 0, errors


def build_alone(place):
    """A scene, and the bytes that its hierarchy has."""
    scene = write_walls(place.folder)
    alone = place.folder / "alone.hlod"
    result = place.hlodbench("build", scene, "-o", alone, *SMALL_NODES)
    assert result.returncode == 0, result.stderr
    return scene, alone.read_bytes()


def expect_only(place, file, content):
    """Nothing else is in the file's folder, and it is whole."""
    assert list(file.parent.iterdir()) == [file]
    assert file.read_bytes() == content
    assert place.hlodbench("info", file, "--check").returncode == 0


# Two at once

@pytest.mark.parametrize("memory", [[], ["--memory", "256M"]], ids=["free", "limited"])
def test_two_builds_of_one_file(place, memory):
    scene, content = build_alone(place)
    for i in range(4):
        file = place.folder / f"made {i}" / "walls.hlod"
        command = ["build", scene, "-o", file, *SMALL_NODES, *memory]
        succeed_together(command, command)
        expect_only(place, file, content)


def test_a_build_with_and_one_without_a_limit(place):
    scene, content = build_alone(place)
    file = place.folder / "made" / "walls.hlod"
    command = ["build", scene, "-o", file, *SMALL_NODES]
    succeed_together(command, [*command, "--memory", "256M"])
    expect_only(place, file, content)


def test_two_runs_that_build_one_cache(place):
    scene, content = build_alone(place)
    outs = [place.folder / "one", place.folder / "other"]
    options = ["--strategy", "coh-b", *SMALL_NODES]
    succeed_together(*(place.run(*options, scene=scene, out=out) for out in outs))
    (file,) = (place.folder / "cache").iterdir()
    expect_only(place, file, content)
    runs = [json.loads((out / "run.json").read_text(encoding="utf-8")) for out in outs]
    assert runs[0]["complete"] and runs[1]["complete"]
    assert runs[0]["scene"] == runs[1]["scene"]


# A file that is cut off while a run takes nodes from it

def run_on_demand(place, out):
    """A run that takes nodes from the file until its end, where pictures take all that are seen."""
    session = write_session(place.folder / "long.json", past_the_walls(200))
    options = ["--gpu-memory", "64K", "--images", "2", "--strategy", "coh-b"]
    return place.run(*options, "--trace", f"{out}.jsonl", session=session, out=out)


def run_and_cut(place, size):
    """Cuts the hierarchy off, to this size, when the run has taken the first node from it."""
    arguments = run_on_demand(place, place.out)
    process = start(arguments)
    said = ""
    while "checked and uploaded" not in said:
        line = process.stderr.readline()
        assert line, said
        said += line
    with place.hlod.open("r+b") as file:
        file.truncate(size)
    _, errors = process.communicate(timeout=120)
    return subprocess.CompletedProcess(arguments, process.returncode, "", errors.replace("\r", "\n"))


@pytest.mark.parametrize("share", [0, 0.05, 0.5, 0.8])
def test_a_file_without_nodes_that_are_wanted(place, share):
    size = int(share * place.hlod.stat().st_size)
    result = run_and_cut(place, size)
    # what is gone of the last page that is left reads as zeros, which a checksum finds
    word = "damaged" if "damaged" in result.stderr else "cut off while it was in use"
    complain(result, BAD_INPUT, place.hlod, word)
    assert not list(place.folder.glob("*.jsonl*")) and not list(place.out.rglob("*.tmp"))


def test_a_file_without_what_was_read_when_it_was_opened(place):
    right = place.folder / "right"
    result = place.hlodbench(*run_on_demand(place, right), timeout=120)
    assert result.returncode == 0, result.stderr
    start_of_geometry, bytes_of_it = struct.unpack_from("<2Q", place.hlod.read_bytes(), 104)
    result = run_and_cut(place, start_of_geometry + bytes_of_it)
    assert result.returncode == 0, result.stderr
    pictures = sorted((right / "images").glob("full.*.png"))
    assert len(pictures) == 2
    for picture in pictures:
        assert (place.out / "images" / picture.name).read_bytes() == picture.read_bytes()
