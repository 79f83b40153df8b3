"""What there is to run: cells with their identities, and the hierarchies that they need.

A cell's identity is a hash of everything that its result follows from: its parameters, the bytes of
the program, and the contents of its scene and session. Change one of them and it is another cell;
change the order of the file, or add a value to an axis, and the others stay what they were.
"""

import hashlib
import json
import pathlib
from dataclasses import asdict, dataclass, field

from atomic_file import write_text_atomically

PLAN = "plan.json"
CELLS = "cells"  # result folders, by identity
LOGS = "logs"
READY = "ready"  # an empty file for each hierarchy that this sweep has built or found built
DONE = "done"  # an empty file for each cell that this attempt has run
VERSION = 1
ID_LENGTH = 16  # hex digits: no two of 100,000 cells alike, but for one chance in 10^9


@dataclass
class PlannedCell:
    """One run."""

    parameters: dict  # key -> text, as in the file; options as "option.NAME"
    timing: bool
    threads: int  # cores that it takes
    session: str  # path
    session_hash: str
    hierarchy: str  # key of Plan.hierarchies, or the path of a .hlod file
    arguments: list  # for `hlodbench run`, besides scene, session and out


@dataclass
class Hierarchy:
    """One that is built before the cells that need it."""

    scene: str  # path
    file: str  # path of the .hlod
    arguments: list  # for `hlodbench build`


@dataclass
class Plan:
    """Everything that jobs need to know; OUT/plan.json."""

    name: str
    program: str
    program_hash: str
    cells: dict = field(default_factory=dict)  # identity -> PlannedCell, in the file's order
    hierarchies: dict = field(default_factory=dict)  # key -> Hierarchy
    pending: list = field(default_factory=list)  # identities of cells to run
    build_threads: int = 1

    def write(self, folder):
        """Writes OUT/plan.json."""
        text = json.dumps({"version": VERSION, **asdict(self)}, indent=1)
        write_text_atomically(str(pathlib.Path(folder) / PLAN), text + "\n")


def read_plan(folder):
    """OUT/plan.json as a Plan. Raises OSError, ValueError, KeyError or TypeError."""
    data = json.loads((pathlib.Path(folder) / PLAN).read_text(encoding="utf-8"))
    if data.pop("version") != VERSION:
        raise ValueError(f"version: expected {VERSION}")
    data["cells"] = {key: PlannedCell(**cell) for key, cell in data["cells"].items()}
    data["hierarchies"] = {key: Hierarchy(**h) for key, h in data["hierarchies"].items()}
    return Plan(**data)


def make_plan(description, program, inputs, cache, cores):
    """The plan of a description. cache: folder of hierarchies. cores: what a cell whose times are
    wanted takes, so that nothing runs beside it; None where another machine is its own.

    Raises SweepError for files that are not there.
    """
    plan = Plan(description.name, program.path, program.hash, build_threads=cores or 1)
    for cell in description.cells:
        _add_cell(plan, cell, description.path.parent, program, inputs, cache, cores)
    return plan


def _add_cell(plan, cell, folder, program, inputs, cache, cores):
    parameters = dict(cell.parameters)
    scene, session = folder / parameters["scene"], folder / parameters["session"]
    scene_hash = inputs.hash_scene(scene)
    session_hash = inputs.hash_file(session, "a session")
    files = _find_files(parameters, folder)
    run, build = _split_arguments(cell, program, scene, files)
    # Names of files do not count, but those that tables show; what is in them does.
    others = {key: value for key, value in parameters.items() if key not in ("scene", "session")}
    hashes = {key: inputs.hash_file(path, "a file") for key, path in files.items()}
    identity = _hash({
        "version": VERSION, "program": plan.program_hash, "timing": cell.timing,
        "parameters": others, "files": hashes, "strategies": cell.strategies,
        "scene": [name_of(scene), scene_hash], "session": [name_of(session), session_hash]})
    if identity in plan.cells:
        return
    key = str(scene.resolve())
    if scene.suffix != ".hlod":
        key = f"{name_of(scene)}.{_hash([scene_hash, build])}"
        plan.hierarchies[key] = Hierarchy(str(scene.resolve()), str(cache / f"{key}.hlod"), build)
    threads = min(cell.threads, cores) if cores else cell.threads
    plan.cells[identity] = PlannedCell(
        parameters, cell.timing, (cores or 1) if cell.timing else threads,
        str(session.resolve()), session_hash, key, run)


def _find_files(parameters, folder):
    """Options whose value, with a / in it, names a file, such as a library: {key: path}."""
    paths = {key: (folder / value).resolve() for key, value in parameters.items()
             if key.startswith("option.") and "/" in value}
    return {key: path for key, path in paths.items() if path.is_file()}


def _split_arguments(cell, program, scene, files):
    """What `hlodbench run` gets, and what `hlodbench build` does."""
    run, build = [], []
    if cell.strategies:
        run += ["--strategy", ",".join(cell.strategies)]
    parameters = dict(cell.parameters)
    if "images" not in parameters:
        run += ["--images", "none"]
    for key, value in parameters.items():
        if key in ("scene", "session"):
            continue
        name = key.removeprefix("option.")
        if name in program.flags:
            arguments = [f"--{name}"] if value == "true" else []
        else:
            arguments = [f"--{name}", str(files.get(key, value))]
        is_option = key.startswith("option.")
        builds = is_option and name in program.build_options and scene.suffix != ".hlod"
        if builds:
            build += arguments
        if not builds or name == "preset":  # which also says how to draw
            run += arguments
    return run, build


def name_of(path):
    """What tables call a scene or session: the file's name up to its first point, as the program
    names them."""
    name = pathlib.Path(path).name
    return name[:1] + name[1:].split(".")[0]


def _hash(content):
    text = json.dumps(content, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:ID_LENGTH]
