"""Where output cannot go, or not wholly: one line that says where, exit code 2, nothing
half-written, and nothing of the user's touched."""

import contextlib
import json
import os
import resource
import signal
import subprocess

import pytest
from refusal import BAD_INPUT, complain, hlod, place  # noqa: F401 (fixtures)
from small_scene import write_walls


# Where output goes

def test_output_folder_with_other_content(place):
    place.out.mkdir()
    (place.out / "thesis.txt").write_text("mine")
    place.refuse(place.run(), BAD_INPUT, f"--out {place.out}")


def test_an_empty_output_folder_is_left_as_it_was(place):
    place.out.mkdir()
    place.refuse(place.run("--strategy", "magic"), BAD_INPUT)
    place.refuse(place.run(scene=place.folder / "missing.ply"), BAD_INPUT)


def test_output_that_is_a_file_or_cannot_be_made(place):
    place.refuse(place.run(out=place.mesh), BAD_INPUT, f"--out {place.mesh}")
    for path in (place.mesh / "out", "/proc/nowhere/out"):
        place.refuse(place.run(out=path), BAD_INPUT, f"--out {path}")


def test_build_into_what_is_not_a_hierarchy(place):
    for path in (place.session, place.folder):
        place.refuse(["build", place.mesh, "-o", path], BAD_INPUT, path)
    place.refuse(["build", place.mesh, "-o", place.mesh], BAD_INPUT, place.mesh)
    for folder in (place.session, "/proc/nowhere"):
        place.refuse(["build", place.mesh, "-o", f"{folder}/x.hlod"], BAD_INPUT, folder)


def test_trace_that_exists_or_has_no_folder(place):
    for path in (place.session, place.folder):
        arguments = place.run("--strategy", "bool", "--trace", path)
        place.refuse(arguments, BAD_INPUT, f"--trace {path}")
    path = place.folder / "t.jsonl"
    existing = place.folder / "t.sw-b.jsonl"
    existing.write_text("mine")
    place.refuse(place.run("--trace", path), BAD_INPUT, f"--trace {existing}")
    nowhere = place.folder / "nowhere" / "t.jsonl"
    place.refuse(place.run("--trace", nowhere), BAD_INPUT, f"--trace {nowhere}")


# A disk that is full: files may have so many bytes, as on a disk that has no more

def limit_files(count):
    def prepare():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # so that writing fails, as on a disk
        resource.setrlimit(resource.RLIMIT_FSIZE, (count, count))

    # the driver's cache of compiled shaders has no part in this
    environment = {"MESA_SHADER_CACHE_DISABLE": "true"}
    return {"preexec_fn": prepare, "restore_signals": False, "env": environment}


@pytest.mark.parametrize("count", [0, 50, 1000])
def test_build_on_a_full_disk(place, count):
    scene = write_walls(place.folder)
    arguments = place.build(scene)
    place.refuse(arguments, BAD_INPUT, place.folder, **limit_files(count))


def test_rebuild_on_a_full_disk_keeps_the_old_hierarchy(place):
    scene = write_walls(place.folder)
    arguments = ["build", scene, "-o", place.hlod, "--max-triangles", "100"]
    place.refuse(arguments, BAD_INPUT, place.folder, **limit_files(1000))


@pytest.mark.parametrize("count", [0, 100, 2000])
def test_run_on_a_full_disk(place, count):
    """What is complete stays; what is not has no file."""
    arguments = place.run("--strategy", "bool,coh-b")
    result = place.hlodbench(*arguments, timeout=60, **limit_files(count))
    complain(result, BAD_INPUT, place.out, "cannot be written")
    for path in place.out.iterdir():
        assert path.suffix == ".csv"
        assert len(path.read_text().splitlines()) == 1 + 4


def test_trace_on_a_full_disk(place):
    trace = place.folder / "t.jsonl"
    arguments = place.run("--strategy", "coh-b", "--trace", trace)
    result = place.hlodbench(*arguments, timeout=60, **limit_files(3000))
    complain(result, BAD_INPUT, trace, "cannot be written")
    assert not list(place.folder.glob("t.jsonl*"))


def test_pictures_on_a_full_disk(place):
    arguments = place.run("--strategy", "bool", "--images", "1,", "--size", "640x480")
    result = place.hlodbench(*arguments, timeout=60, **limit_files(30000))
    complain(result, BAD_INPUT, place.out / "images", "cannot be written")
    assert not list((place.out / "images").iterdir())
    assert json.loads((place.out / "run.json").read_text())["complete"]


@contextlib.contextmanager
def tiny_disk(folder):
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(folder)]
    try:
        mounted = os.geteuid() == 0 and subprocess.run(mount, capture_output=True).returncode == 0
    except FileNotFoundError:
        mounted = False
    if not mounted:
        pytest.skip("no small disk can be mounted here; the tests with a limit on files remain")
    try:
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_a_disk_that_is_really_full(place, tmp_path):
    with tiny_disk(tmp_path / "disk") as disk:
        scene = write_walls(place.folder)
        hlod = disk / "w.hlod"
        place.refuse(["build", scene, "-o", hlod], BAD_INPUT, disk, "No space")
        assert list(disk.iterdir()) == []
        trace = disk / "t.jsonl"
        result = place.hlodbench(*place.run("--strategy", "bool", "--trace", trace))
        complain(result, BAD_INPUT, trace, "No space")
        assert list(disk.iterdir()) == []
        out = disk / "out"
        result = place.hlodbench(*place.run("--repetitions", "9", out=out))
        complain(result, BAD_INPUT, out, "cannot be written")
        for path in out.iterdir():
            assert path.name == "run.json" or len(path.read_text().splitlines()) == 1 + 4
