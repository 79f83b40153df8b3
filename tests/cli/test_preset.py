"""--preset: what it sets, and that options given besides win."""

import json
import re

from small_scene import past_the_walls, write_ply, write_relief, write_session, write_walls


def options_of(hlodbench, hlod):
    info = hlodbench("info", hlod)
    assert info.returncode == 0, info.stderr
    made = re.search(r"made with (.*)$", info.stdout, re.MULTILINE)[1]
    return dict(part.split("=") for part in made.split())


def test_presets_of_build(hlodbench, tmp_path):
    scene = write_walls(tmp_path)
    hlod = tmp_path / "w.hlod"
    assert hlodbench("build", scene, "-o", hlod).returncode == 0
    paper = options_of(hlodbench, hlod)
    assert (paper["max_triangles"], paper["error"], paper["normals"]) == ("2000", "max", "original")
    assert hlodbench("build", scene, "-o", hlod, "--preset", "paper").returncode == 0
    assert options_of(hlodbench, hlod) == paper
    assert hlodbench("build", scene, "-o", hlod, "--preset", "best").returncode == 0
    best = options_of(hlodbench, hlod)
    assert (best["max_triangles"], best["error"], best["normals"]) == ("16000", "rms", "smoothed")
    again = hlodbench("build", scene, "-o", hlod, "--max-triangles", "400", "--preset", "best",
                      "--normals", "original")
    assert again.returncode == 0
    mixed = options_of(hlodbench, hlod)
    assert (mixed["max_triangles"], mixed["error"], mixed["normals"]) == ("400", "rms", "original")


def test_best_looks_at_the_size_of_parts(hlodbench, tmp_path):
    vertices, triangles = [], []
    for i in range(3000):  # leaflets of two triangles
        x, y, z = i % 60, i // 60, i % 7
        triangles += [tuple(len(vertices) + k for k in three) for three in ((0, 1, 2), (0, 2, 3))]
        vertices += [(x, y, z), (x + 0.5, y, z), (x + 0.5, y + 0.5, z + 0.1), (x, y + 0.5, z)]
    leaves = write_ply(tmp_path / "leaves.ply", vertices, triangles, binary=True)
    hlod = tmp_path / "a.hlod"

    def build(mesh, *more):
        hlod.unlink(missing_ok=True)
        result = hlodbench("build", mesh, "-o", hlod, "--preset", "best", *more)
        assert result.returncode == 0, result.stderr
        nodes = int(re.search(r"built (\d+) nodes", result.stderr)[1])
        return "of small parts, 2 triangles on the average" in result.stderr, nodes

    said, nodes = build(leaves)
    assert said and nodes > 1
    content = hlod.read_bytes()
    assert build(leaves, "--memory", "1G")[0] and hlod.read_bytes() == content
    assert build(leaves, "--max-triangles", "16000") == (False, 1)
    assert build(write_relief(tmp_path / "relief.ply", 60)) == (False, 1)


def test_preset_of_run_sets_tau_and_faces(hlodbench, tmp_path):
    scene = write_walls(tmp_path)
    session = write_session(tmp_path / "path.json", past_the_walls(8))
    run = ["run", "--scene", scene, "--session", session, "--cache", tmp_path / "cache",
           "--strategy", "bool", "--images", "none"]

    def options(name, *more):
        result = hlodbench(*run, "--out", tmp_path / name, *more)
        assert result.returncode == 0, result.stderr
        stored = json.loads((tmp_path / name / "run.json").read_text(encoding="utf-8"))["options"]
        return stored["tau"], stored["faces"]

    assert options("1") == (1.0, "both")
    assert options("2", "--preset", "best") == (0.25, "front")
    assert options("3", "--preset", "best", "--tau", "2", "--faces", "both") == (2.0, "both")
    assert len(list((tmp_path / "cache").iterdir())) == 2, "each set of options keeps its own"


def test_unknown_names_are_refused(hlodbench, tmp_path):
    scene = write_walls(tmp_path)
    for option in ("--preset", "--error", "--normals"):
        result = hlodbench("build", scene, "-o", tmp_path / "w.hlod", option, "x")
        assert result.returncode == 2
        assert f"{option}: expected one of " in result.stderr and "found 'x'" in result.stderr
        assert not (tmp_path / "w.hlod").exists()
