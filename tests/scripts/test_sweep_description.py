"""The YAML file of scripts/sweep: which cells it gives, and what is said of a bad one."""

import pathlib

import pytest

pytest.importorskip("yaml", reason="needs python3-yaml")

from sweeping.description import read_description  # noqa: E402
from sweeping.errors import SweepError  # noqa: E402

OPTIONS = {"simp", "exponent", "max-triangles", "scene", "latency", "threads", "gl-debug"}
BASE = "scene: a.json\nsession: b.json\n"


@pytest.fixture
def read(tmp_path):
    def run(text):
        path = tmp_path / "x.sweep.yaml"
        path.write_text(text, encoding="utf-8")
        return read_description(path, OPTIONS)
    return run


def test_matrix_is_the_product_of_its_axes(read):
    cells = read(BASE + "s: [0, 0.5]\nlatency: [gl, 'frames:1']\noptions: {simp: [last, mean]}\n"
                 "strategy: [coh-b, bool]\n").cells
    assert len(cells) == len({cell.parameters for cell in cells}) == 8
    assert dict(cells[0].parameters) == {"scene": "a.json", "session": "b.json", "s": "0",
                                         "latency": "gl", "option.simp": "last"}
    assert {cell.strategies for cell in cells} == {("coh-b", "bool")}
    assert {cell.timing for cell in cells} == {True}


def test_blocks_override_and_add_up(read):
    description = read(BASE + """
tau: 2
options: {simp: last, exponent: 3}
blocks:
  - {scene: c.json, session: d.json, tau: [1, 4]}
  - {timing: false, threads: 2, latency: 'draws:5', options: {exponent: 2.5, gl-debug: true}}
""")
    found = [dict(cell.parameters) for cell in description.cells]
    assert [(c["scene"], c["session"], c["tau"], c["option.exponent"]) for c in found] == [
        ("c.json", "d.json", "1", "3"), ("c.json", "d.json", "4", "3"),
        ("a.json", "b.json", "2", "2.5")]
    assert found[2]["option.simp"] == "last" and found[2]["option.gl-debug"] == "true"
    assert (description.cells[2].timing, description.cells[2].threads) == (False, 2)
    assert description.name == "x" and description.warnings == []


@pytest.mark.parametrize("latency", ["", "latency: gl\n", "latency: [gl, 'draws:1']\n"])
def test_counts_with_the_driver_s_latency_are_warned_about(read, latency):
    (warning,) = read(BASE + "timing: false\n" + latency).warnings
    assert "do not repeat exactly" in warning


BAD = {
    "[]": "the whole: expected a mapping with some of the keys name,",
    "scene: a\nsession: b\ns: [0, 1": ":3: expected YAML: ",
    "? [1, 2]\n: 3\n": ":1: expected YAML: found unhashable key",
    "\t": ":1: expected YAML: ",
    "session: b.json\n": "scene: expected the name of a file, found none",
    BASE + "scenes: a\n": "scenes: expected one of the keys name,",
    BASE + "s: 2\n": "s: expected a number from 0 to 1, found '2'",
    BASE + "s: [0, x]\n": "s[1]: expected a number from 0 to 1, found 'x'",
    BASE + "s: .nan\n": "s: expected a number from 0 to 1, found 'nan'",
    BASE + "s: true\n": "s: expected a number from 0 to 1, found 'true'",
    BASE + "s: []\n": "s: expected a number from 0 to 1, or a list of such, found '[]'",
    BASE + "s: [1, 1.0]\n": "s[1]: expected each value once, found '1'",
    BASE + "s: 1\ns: 0\n": ":4: expected YAML: expected the key 's' once, found it twice",
    BASE + "tau: 0\n": "tau: expected a number above 0 up to 1e+06, found '0'",
    BASE + "size: 640\n": "size: expected a text like 640x480, found '640'",
    BASE + "latency: draws\n": "latency: expected gl, draws:N or frames:N, found 'draws'",
    BASE + "seed: 1.5\n": "seed: expected a whole number from 0 to 9007199254740991, found '1.5'",
    BASE + "repetitions: 0\n": "repetitions: expected a whole number from 1 to 10000, found '0'",
    BASE + "timing: 1\n": "timing: expected true or false, found '1'",
    BASE + "threads: 0\n": "threads: expected a whole number from 1 to 1024, found '0'",
    BASE + "strategy: 'a b'\n": "strategy: expected the id of a strategy, found 'a b'",
    BASE + "options: [simp]\n": "options: expected a mapping of options of `hlodbench run`",
    BASE + "options: {simpp: last}\n": "options.simpp: expected an option of `hlodbench run`",
    BASE + "options: {latency: gl}\n": "options.latency: expected an option that has no key of",
    BASE + "options: {threads: 1}\n": "options.threads: expected an option that has no key of",
    BASE + "options: {simp: }\n": "options.simp: expected a text, number, true or false, found",
    BASE + "blocks: {}\n": "blocks: expected a list of mappings, found '{}'",
    BASE + "blocks: [{name: x}]\n": "blocks[0].name: expected one of the keys scene,",
    BASE + "blocks: [{}, {s: -1}]\n": "blocks[1].s: expected a number from 0 to 1, found '-1'",
    BASE + "name: 3\n": "name: expected a text, found '3'",
    BASE + f"seed: {list(range(400))}\ntau: {list(range(1, 400))}\n":
        "the whole: expected at most 100000 cells, found '159600'",
}


@pytest.mark.parametrize("text", BAD)
def test_bad_file_is_named_with_key_and_what_was_found(read, tmp_path, text):
    with pytest.raises(SweepError) as error:
        read(text)
    message = str(error.value)
    assert message.startswith(f"{tmp_path / 'x.sweep.yaml'}:") and "\n" not in message
    assert BAD[text] in message


def test_file_that_is_not_there(tmp_path):
    with pytest.raises(SweepError, match="none.yaml: expected the description of a sweep: No such"):
        read_description(tmp_path / "none.yaml", OPTIONS)


def test_shipped_descriptions_are_good(root):
    options = {"max-triangles", "preset"}
    found = sorted(pathlib.Path(root / "sessions").glob("*.sweep.yaml"))
    assert len(found) >= 1
    for path in found:
        description = read_description(path, options)
        assert description.cells and not description.warnings
        for cell in description.cells:
            parameters = dict(cell.parameters)
            assert (path.parent / parameters["scene"]).is_file()
            assert (path.parent / parameters["session"]).is_file()
