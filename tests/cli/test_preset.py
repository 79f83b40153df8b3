"""--preset: what it sets, and that options given besides win."""

import json
import re

from small_scene import past_the_walls, write_session, write_walls


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
