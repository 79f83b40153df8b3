"""Building under a memory limit: the same hierarchy, and no temporary file left behind."""

import os
import signal
import subprocess
import time

import pytest
from refusal import BAD_INPUT, complain, hlod, place  # noqa: F401 (fixtures)
from small_scene import write_courtyard, write_ply, write_relief, write_walls
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


def test_a_ply_that_stays_in_its_file_changes_no_byte(place):
    mesh = write_relief(place.folder / "b.ply", side=60, binary=True)
    (place.folder / "links").mkdir()
    link = place.folder / "links" / "b.ply"
    link.symlink_to(mesh)
    files = []
    for name, more in ((mesh, []), (mesh, ["--memory", "256M"]), (link, ["--memory", "256M"])):
        path = place.folder / "b.hlod"
        path.unlink(missing_ok=True)
        result = place.hlodbench("build", name, "-o", path, "--max-triangles", 100, *more)
        assert result.returncode == 0, result.stderr
        files.append(path.read_bytes())
    assert files[0] == files[1] == files[2]


def test_a_ply_larger_than_memory(place):
    """Most of it are vertices that nobody uses, a hole in the file."""
    unused, corners = 1 << 25, [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    path = write_ply(place.folder / "b.ply", corners, [(0, 1, 2)], binary=True)
    head, body = path.read_bytes().split(b"vertex 3\n")
    head, face = head + f"vertex {3 + unused}\n".encode() + body[:-13], body[-13:]
    with open(path, "wb") as file:
        file.write(head)
        file.seek(12 * unused, os.SEEK_CUR)
        file.write(face)
    arguments = ["build", path, "-o", place.folder / "b.hlod", "--memory", "300M"]
    process = subprocess.Popen([os.environ["HLODBENCH_EXE"], *map(str, arguments)])
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    assert path.stat().st_size > 384 << 20
    assert usage.ru_maxrss < 300 << 10  # KiB


def test_faults_of_a_ply_that_stays_in_its_file(place):
    vertices, triangles = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, "nan", 1)], [(0, 1, 2), (1, 2, 3)]
    path = write_ply(place.folder / "bad.ply", vertices, triangles, binary=True)
    arguments = [*place.build(path), "--memory", "256M"]
    place.refuse(arguments, BAD_INPUT, path, "vertex 3 (from 0): expected finite", "nan")
    path.write_bytes(path.read_bytes()[:-1])
    place.refuse(arguments, BAD_INPUT, path, "the file ends in face 1 (from 0) of 2")


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
