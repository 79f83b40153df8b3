"""Building under a memory limit: the same hierarchy, and no temporary file left behind."""

import os
import signal
import subprocess
import time

import pytest
from refusal import BAD_INPUT, complain, hlod, place  # noqa: F401 (fixtures)
from small_scene import write_courtyard, write_walls
from test_bad_output import limit_files, tiny_disk


def test_a_limit_changes_no_byte(place):
    scene = write_walls(place.folder)
    files = []
    for name, more in (("free", []), ("limited", ["--memory", "256M"]), ("one", ["--threads", 1])):
        path = place.folder / f"{name}.hlod"
        result = place.hlodbench("build", scene, "-o", path, "--max-triangles", 100, *more)
        assert result.returncode == 0, result.stderr
        files.append(path.read_bytes())
    assert files[0] == files[1] == files[2]


def test_a_hierarchy_built_without_a_limit_is_up_to_date(place):
    scene = write_walls(place.folder)
    assert place.hlodbench(*place.build(scene)).returncode == 0
    result = place.hlodbench(*place.build(scene), "--memory", "1G")
    assert result.returncode == 0 and "up to date" in result.stderr


def test_nothing_is_left_after_success(place):
    scene = write_walls(place.folder)
    before = set(place.content())
    assert place.hlodbench(*place.build(scene), "--memory", "256M").returncode == 0
    assert set(place.content()) - before == {place.folder / "new.hlod"}


@pytest.mark.parametrize("size", ["", "0", "-1", "2T", "2GB", "1.5G", "much", "99999999999G"])
def test_sizes_that_are_none(place, size):
    scene = write_walls(place.folder)
    place.refuse([*place.build(scene), f"--memory={size}"], BAD_INPUT, "--memory")


def test_too_small_a_limit_says_the_least_that_works(place):
    scene = write_walls(place.folder)
    arguments = [*place.build(scene), "--threads", 2, "--memory"]
    error = place.refuse([*arguments, "1M"], BAD_INPUT, "--memory", "at least", "found 1M")
    least = int(error.split("at least ")[1].split("M")[0])
    place.refuse([*arguments, f"{least - 1}M"], BAD_INPUT, "--memory")
    assert place.hlodbench(*arguments, f"{least}M").returncode == 0


@pytest.mark.parametrize("count", [0, 1000, 100000])
def test_temporary_file_on_a_full_disk(place, count):
    scene = write_walls(place.folder)
    arguments = [*place.build(scene), "--memory", "256M"]
    place.refuse(arguments, BAD_INPUT, place.folder, "cannot be written", **limit_files(count))


def test_temporary_file_on_a_disk_that_is_really_full(place, tmp_path):
    with tiny_disk(tmp_path / "disk") as disk:
        scene = write_walls(place.folder)
        arguments = ["build", scene, "-o", disk / "w.hlod", "--memory", "256M"]
        place.refuse(arguments, BAD_INPUT, disk, "No space")
        assert list(disk.iterdir()) == []


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_an_interrupted_build_leaves_nothing(place, number):
    scene = write_courtyard(place.folder / "yard.scene.json", triangles=1000000)
    before = place.content()
    arguments = [*place.build(scene), "--memory", "256M"]
    process = subprocess.Popen(
        [os.environ["HLODBENCH_EXE"], *map(str, arguments)], stderr=subprocess.PIPE, text=True
    )
    time.sleep(1.5)
    process.send_signal(number)
    error = process.communicate(timeout=60)[1].replace("\r", "\n")
    if number == signal.SIGKILL:
        assert process.returncode == -signal.SIGKILL
    else:
        result = subprocess.CompletedProcess(arguments, process.returncode, "", error)
        complain(result, BAD_INPUT, place.folder / "new.hlod", "interrupted")
    assert place.content() == before
