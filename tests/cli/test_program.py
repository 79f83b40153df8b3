"""Every command of the program does what --help says, from a scene file to the table."""

import csv
import io
import json
import re

import pytest
from small_scene import past_the_walls, write_relief, write_session, write_walls

STRATEGIES = ("bool", "sw-b", "simp-b", "coh-b")
COMMANDS = ("list", "build", "info", "run", "table", "compare", "bias")
FRAMES = 12


def succeed(result):
    assert result.returncode == 0, result.stderr
    return result


class World:
    """A scene, its session, its hierarchy and a run."""

    def __init__(self, hlodbench, folder):
        self.folder = folder
        self.scene = write_walls(folder)
        self.mesh = folder / "relief.ply"
        self.session = write_session(folder / "path.json", past_the_walls(FRAMES))
        self.hlod = folder / "walls.hlod"
        self.out = folder / "out"
        self.build = hlodbench("build", self.scene, "-o", self.hlod, "--max-triangles", "200")
        self.run = hlodbench(
            "run", "--scene", self.hlod, "--session", self.session, "--out", self.out
        )


@pytest.fixture(scope="module")
def world(hlodbench, tmp_path_factory):
    return World(hlodbench, tmp_path_factory.mktemp("a world"))


def test_version(hlodbench):
    assert re.fullmatch(r"hlodbench \d+\.\d+\.\d+\n", succeed(hlodbench("--version")).stdout)


def test_list_names_strategies_contexts_and_counters(hlodbench):
    text = succeed(hlodbench("list")).stdout
    for name in (*STRATEGIES, "auto", "egl", "dn", "rarn", "delays", "frame_ms"):
        assert re.search(rf"^  {name} +\S", text, re.MULTILINE), name


# What the help of each option says: its unit or range, and in brackets its default.
HELP = {
    "build": {
        "scene": [".json", ".ply"],
        "--output": [".hlod"],
        "--max-triangles": ["triangles", "[2000]"],
        "--simplifier": ["openmesh"],
        "--error-samples": ["points", "[16384]"],
        "--threads": ["threads", "[0]"],
    },
    "info": {
        "--json": ["world units"],
        "--check": ["exit code 1"],
        "--depth-complexity": ["session"],
        "--every": ["[10]"],
        "--context": ["[auto]"],
    },
    "run": {
        "--scene": [".hlod"],
        "--session": [".json"],
        "--out": ["empty"],
        "--strategy": ["[bool,sw-b,simp-b,coh-b]"],
        "--context": ["egl", "[auto]"],
        "--size": ["pixels", "session"],
        "--repetitions": ["[1]"],
        "--warm-up": ["frames", "[5]"],
        "--frames-in-flight": ["frames", "[1]"],
        "--latency": ["frames:N", "draws:N", "[gl]"],
        "--seed": ["[1]"],
        "--tau": ["pixels", "[1]"],
        "--s": ["0", "1", "[1]"],
        "--t": ["0", "1", "[0.25]"],
        "--exponent": ["1 to 100", "[2]"],
        "--stale-children": ["[skip]"],
        "--zero-pixels": ["[zero]"],
        "--simp": ["[last]"],
        "--pull-up": ["refine, delay", "[refine]"],
        "--render-guard": ["on, off", "[on]"],
        "--near-plane": ["visible, query", "[visible]"],
        "--query-faces": ["front, both", "[front]"],
        "--mu-area": ["clipped, unclipped", "[clipped]"],
        "--trace": ["JSON Lines"],
        "--images": ["Bool", "frames", "[20]"],
        "--explain": ["SW(B)", "[none]"],
        "--image-format": ["png, exr", "[png]"],
        "--overlay": ["bias, level, node, rarn"],
        "--cache": ["folder"],
        "--max-triangles": ["triangles", "[2000]"],
        "--plugin": ["shared library", "repeated"],
        "--set": ["STRATEGY.OPTION=VALUE"],
        "--frame-timeout": ["seconds", "[30]"],
    },
    "table": {"dir": ["folders"], "--format": ["markdown", "latex", "csv", "[markdown]"]},
    "compare": {
        "a": ["FOLDER:STRATEGY"],
        "--format": ["markdown, csv, json", "[markdown]"],
        "--allow": ["scene, session, size, tau, machine"],
        "--alpha": ["[0.05]"],
        "--effect": ["A12", "[0.71]"],
        "--min-change": ["per cent", "[1]"],
    },
    "bias": {"--s": ["0 to 1"], "--t": ["0 to 1"], "--exponent": ["1 to 100"], "--samples": ["[101]"]},
    "list": {"--plugin": ["shared library"]},
}


def describe_options(text):
    """Help text by option; continuation lines are joined."""
    options, name = {}, None
    for line in text.splitlines():
        match = re.match(r"  (?:-\w,)?(-?-?[a-z][a-z-]*)", line)
        if match:
            name = match[1]
            options[name] = ""
        if name:
            options[name] += " " + line.strip()
    return options


def test_help_names_the_commands_and_exit_codes(hlodbench):
    text = succeed(hlodbench("--help")).stdout
    for word in (*COMMANDS, "Exit codes: 0 ok, 1", "2 wrong usage", "3 no usable GL"):
        assert word in text


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_a_command_has_units_and_defaults(hlodbench, command):
    options = describe_options(succeed(hlodbench(command, "--help")).stdout)
    for name, words in HELP[command].items():
        assert name in options, f"{name} is not in the help"
        for word in words:
            # a default stands behind "=" or in brackets, as the version of CLI11 has it
            found = f"={word[1:-1]} " in options[name] if word.startswith("[") else False
            assert found or word in options[name], f"{name}: {options[name]}"


def test_build_reports_on_stderr_only(world):
    assert world.build.returncode == 0, world.build.stderr
    assert world.build.stdout == ""
    assert "built " in world.build.stderr and "nodes" in world.build.stderr
    assert f"wrote {world.hlod}" in world.build.stderr


def test_build_is_up_to_date_until_options_or_the_scene_change(hlodbench, tmp_path):
    scene, file = write_walls(tmp_path, walls=1), tmp_path / "made" / "walls.hlod"

    def build(*options):
        result = succeed(hlodbench("build", scene, "-o", file, *options))
        assert result.stdout == ""
        return "up to date" not in result.stderr

    assert build()
    before = file.read_bytes(), file.stat().st_mtime_ns
    assert not build()
    assert (file.read_bytes(), file.stat().st_mtime_ns) == before
    assert build("--max-triangles", "300")
    assert file.read_bytes() != before[0]
    assert not build("--max-triangles", "300")
    write_relief(tmp_path / "relief.ply", side=30)
    assert build("--max-triangles", "300")
    assert [path.name for path in file.parent.iterdir()] == ["walls.hlod"]


def test_build_gives_the_same_bytes_with_any_number_of_threads(hlodbench, world, tmp_path):
    for threads in (1, 3):
        file = tmp_path / f"{threads}.hlod"
        options = ["--max-triangles", "200", "--threads", threads]
        succeed(hlodbench("build", world.scene, "-o", file, *options))
        assert file.read_bytes() == world.hlod.read_bytes()


def test_info_as_text(hlodbench, world):
    text = succeed(hlodbench("info", world.hlod)).stdout
    assert re.match(r"hierarchy +[0-9a-f]{16}, made with .*max_triangles=200", text)
    assert "9600 triangles in 3 objects" in text
    assert re.search(r"^level +nodes +leaves", text, re.MULTILINE)


def test_info_as_json_is_a_tree_with_all_triangles_in_its_leaves(hlodbench, world):
    text = succeed(hlodbench("info", "--json", world.hlod)).stdout
    nodes = json.loads(text)["nodes"]
    assert [n["id"] for n in nodes] == list(range(len(nodes)))
    assert nodes[0]["parent"] is None
    assert all(isinstance(n["parent"], int) for n in nodes[1:])
    for node in nodes:
        assert set(node) == {"id", "parent", "children", "min", "max", "error", "triangles"}
        for child in (nodes[c] for c in node["children"]):
            assert child["parent"] == node["id"]
            assert child["error"] <= node["error"]
            assert all(a <= b for a, b in zip(node["min"], child["min"]))
            assert all(a >= b for a, b in zip(node["max"], child["max"]))
    leaves = [n for n in nodes if not n["children"]]
    assert sum(n["triangles"] for n in leaves) == 9600
    assert all(n["error"] == 0 for n in leaves)
    numbers = re.findall(r"\d\.(\d+)", text)
    assert max(map(len, numbers)) >= 8, "nine digits, so that 32-bit numbers come back exactly"


def test_info_checks(hlodbench, world):
    result = succeed(hlodbench("info", "--check", world.hlod))
    assert result.stderr == f"{world.hlod}: every check holds\n"


def test_info_measures_depth_complexity(hlodbench, world):
    options = ["--depth-complexity", world.session, "--every", "4"]
    text = succeed(hlodbench("info", world.hlod, *options)).stdout
    layers = re.search(r"depth complexity: ([\d.]+) layers .* mean of 3 frames", text)
    assert 1 <= float(layers[1]) <= 10


def test_run_with_all_strategies(world):
    assert world.run.returncode == 0, world.run.stderr
    assert world.run.stdout == ""
    assert "context " in world.run.stderr
    names = {path.name for path in world.out.iterdir()}
    assert names == {"run.json", "images", *(f"{s}.0.csv" for s in STRATEGIES)}


def test_run_draws_as_the_paper_expects(world):
    """SW(B), whose front is the ideal one, refines least; Bool, without the bias, most."""
    run = json.loads((world.out / "run.json").read_text(encoding="utf-8"))
    fronts = {
        c["strategy"]: c["summary"]["counters"]["dn"]["mean"]
        - c["summary"]["counters"]["rarn"]["mean"]
        for c in run["cases"]
    }
    assert min(fronts.values()) > 5
    assert fronts["sw-b"] <= min(fronts["coh-b"], fronts["simp-b"])
    assert fronts["sw-b"] <= fronts["bool"]


@pytest.mark.parametrize("form", ["markdown", "latex", "csv"])
def test_table_in_every_format(hlodbench, world, form):
    text = succeed(hlodbench("table", world.out, "--format", form)).stdout
    assert text.endswith("\n")
    assert "217" in text or form == "csv", "the paper's values stand beside ours"
    if form == "markdown":
        rows = [line for line in text.splitlines() if "| this run" in line]
        assert [row.split("|")[1].strip() for row in rows] == 2 * [
            "Bool", "SW(B)", "Simp*(B)", "Coh(B)",
        ]  # fmt: skip
    elif form == "latex":
        assert text.count(r"\begin{tabular}") == text.count(r"\end{tabular}") >= 1
    else:
        rows = list(csv.reader(io.StringIO(text)))
        assert len(rows) == 1 + len(STRATEGIES) and len({len(row) for row in rows}) == 1
        assert [row[rows[0].index("strategy")] for row in rows[1:]] == list(STRATEGIES)


def test_run_from_a_scene_file_uses_the_cache(hlodbench, world, tmp_path):
    cache = tmp_path / "a cache"
    arguments = ["run", "--scene", world.scene, "--session", world.session]
    arguments += ["--strategy", "bool", "--max-triangles", "200", "--cache", cache]
    succeed(hlodbench(*arguments, "--out", tmp_path / "1"))
    built = [(p.name, p.stat().st_mtime_ns) for p in cache.iterdir()]
    assert [name.split(".")[::2] for name, _ in built] == [["walls", "hlod"]], "a name of its own"
    assert (cache / built[0][0]).read_bytes() == world.hlod.read_bytes()
    succeed(hlodbench(*arguments, "--out", tmp_path / "2"))
    assert [(p.name, p.stat().st_mtime_ns) for p in cache.iterdir()] == built


def test_run_takes_the_cache_of_the_environment(hlodbench, world, tmp_path):
    arguments = ["run", "--scene", world.mesh, "--session", world.session, "--strategy", "coh-b"]
    arguments += ["--out", tmp_path / "out"]
    succeed(hlodbench(*arguments, env={"HLODBENCH_CACHE": str(tmp_path / "there")}))
    assert (tmp_path / "there" / "relief.hlod").is_file()
    run = json.loads((tmp_path / "out" / "run.json").read_text(encoding="utf-8"))
    assert run["scene"]["name"] == "relief" and run["scene"]["triangles"] == 3200


def test_a_smaller_viewport_needs_fewer_nodes(hlodbench, world, tmp_path):
    drawn = {}
    for size in ("40x30", "320x240"):
        out = tmp_path / size
        arguments = ["--scene", world.hlod, "--session", world.session, "--out", out]
        succeed(hlodbench("run", *arguments, "--strategy", "bool", "--size", size))
        run = json.loads((out / "run.json").read_text(encoding="utf-8"))
        assert run["options"]["viewport"] == [int(n) for n in size.split("x")]
        drawn[size] = run["cases"][0]["summary"]["counters"]["dn"]["mean"]
    assert drawn["40x30"] < drawn["320x240"]
