"""A session that was recorded in another scene is replayed, with a warning."""

import json

from small_scene import past_the_walls, write_session


def run(hlodbench, walls_hlod, out, **keys):
    """What run.json and the error stream say of a session with these keys."""
    session = write_session(out.with_suffix(".json"), past_the_walls(3), **keys)
    options = ["--strategy", "bool", "--warm-up", "0", "--repetitions", "1"]
    result = hlodbench("run", "--scene", walls_hlod, "--session", session, "--out", out, *options)
    assert result.returncode == 0, result.stderr
    content = json.loads((out / "run.json").read_text(encoding="utf-8"))
    return content["scene"]["build"]["scene_hash"], content["context"]["warnings"], result.stderr


def test_only_another_scene_is_warned_of(hlodbench, walls_hlod, tmp_path):
    own, warnings, _ = run(hlodbench, walls_hlod, tmp_path / "none")
    assert not any("recorded" in w for w in warnings)

    scene = {"name": "walls", "hash": own}
    _, warnings, errors = run(hlodbench, walls_hlod, tmp_path / "same", scene=scene)
    assert not any("recorded" in w for w in warnings) and "recorded" not in errors

    other = {"name": "two\nbunnies", "hash": "0123456789abcdef"}
    _, warnings, errors = run(hlodbench, walls_hlod, tmp_path / "other", scene=other)
    line = (
        "the session 'path' was recorded in scene 'two bunnies' (0123456789abcdef), "
        f"this is 'walls' ({own})"
    )
    assert warnings.count(line) == 1
    assert errors.splitlines().count(f"warning: {line}") == 1
