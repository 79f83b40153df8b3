"""How the tests of bad input see that the program refuses something and harms nothing."""

import re

import pytest
from small_scene import past_the_walls, write_relief, write_session, write_walls

BAD_INPUT, NO_GL = 2, 3
# What may stand before the error: progress, the context, what was built.
PROGRESS = re.compile(r"(building|replaying|pictures|context|window|showing|warning:|built|wrote)[ :]|  ")


class Place:
    """A folder of good input, and whether a command leaves it alone."""

    def __init__(self, hlodbench, folder, hlod):
        self.hlodbench = hlodbench
        self.folder = folder
        self.hlod = folder / "walls.hlod"
        self.hlod.write_bytes(hlod)
        self.mesh = write_relief(folder / "relief.ply", side=4)
        self.session = write_session(folder / "path.json", past_the_walls(4))
        self.out = folder / "out"

    def content(self):
        return {
            path: path.read_bytes() if path.is_file() else None
            for path in self.folder.rglob("*")
        }

    def refuse(self, arguments, code, *words, **options):
        before = self.content()
        result = self.hlodbench(*arguments, timeout=60, **options)
        complain(result, code, *words)
        assert self.content() == before
        return result.stderr

    def run(self, *arguments, scene=None, session=None, out=None):
        scene, session = scene or self.hlod, session or self.session
        fixed = ["--scene", scene, "--session", session, "--out", out or self.out]
        return ["run", *fixed, "--warm-up", "0", "--cache", self.folder / "cache", *arguments]

    def build(self, scene):
        return ["build", scene, "-o", self.folder / "new.hlod"]


def complain(result, code, *words):
    """The program ended with this code and one line of error, which has these words in it."""
    *others, error = result.stderr.splitlines() or [""]
    assert result.returncode == code, result.stderr
    assert error.startswith("hlodbench: "), result.stderr
    assert all(PROGRESS.match(line) for line in others), result.stderr
    assert result.stderr.endswith("\n") and result.stdout == ""
    assert error.isprintable()
    for word in words:
        assert str(word) in error


@pytest.fixture(scope="session")
def hlod(hlodbench, tmp_path_factory):
    """Bytes of a hierarchy."""
    folder = tmp_path_factory.mktemp("hlod")
    result = hlodbench("build", write_walls(folder), "-o", folder / "w", "--max-triangles", "200")
    assert result.returncode == 0, result.stderr
    return (folder / "w").read_bytes()


@pytest.fixture
def place(hlodbench, hlod, tmp_path):
    folder = tmp_path / "a place"
    folder.mkdir()
    return Place(hlodbench, folder, hlod)
