"""Who may include whom. The walk follows our own headers, so a detour is found too."""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)

# Where the headers of plug-ins are, which both trees include as <hlodbench/...>.
PUBLIC = "src/traversals/plugin"

GL = ("glad/", "gl/", "gles", "egl/", "khr/", "glx", "x11/", "glfw/", "epoxy/", "osmesa")

# Folder under src, or bench/... -> what nothing in it may reach, compared in lower case with the start of an
# include and with the path of our own header under src/ or bench/.
RULES = {
    "traversals": (*GL, "hlod/render/"),
    "hlod/render": ("traversals/",),
    "hlod/core": (*GL, "hlod/render/", "traversals/"),
    "hlod/scene": (*GL, "hlod/render/", "traversals/"),
    "hlod/tree": (*GL, "hlod/render/", "traversals/"),
    "hlod/view": (*GL, "hlod/render/", "traversals/"),
    "hlod/build": (*GL, "hlod/render/", "traversals/"),
    "bench/view": (*GL, "hlod/render/", "gui/", "imgui", "backends/imgui"),
}


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in (".h", ".hpp", ".cpp", ".c", ".inl"))


def includes(path):
    return INCLUDE.findall(COMMENT.sub("", path.read_text(encoding="utf-8")))


def resolve(root, includer, name):
    """The header of ours that an include means, or None for one of the system."""
    for folder in (includer.parent, root / "src", root / "bench", root / PUBLIC):
        candidate = (folder / name).resolve()
        if candidate.is_file():
            return candidate
    return None


def logical_name(root, path):
    """How a header of ours is to be included: its path under src/ or bench/."""
    for folder in (root / PUBLIC, root / "src", root / "bench"):
        if path.is_relative_to(folder):
            return path.relative_to(folder).as_posix()
    return path.as_posix()


def violations(root, start, forbidden):
    """Chains of includes, as "a.cpp -> b.h -> glad/gl.h", from start to what is forbidden."""
    found = []
    seen = {start}
    pending = [(start, (logical_name(root, start),))]
    while pending:
        path, chain = pending.pop()
        for name in includes(path):
            header = resolve(root, path, name)
            names = {name.lower()}
            if header:
                names.add(logical_name(root, header).lower())
            if any(n.startswith(forbidden) for n in names):
                found.append(" -> ".join((*chain, name)))
            elif header and header not in seen:
                seen.add(header)
                pending.append((header, (*chain, logical_name(root, header))))
    return found


def place(root, folder):
    return root / folder if folder.startswith("bench/") else root / "src" / folder


def check(root, folder):
    root = root.resolve()
    return [
        chain
        for path in sources(place(root, folder))
        for chain in violations(root, path, RULES[folder])
    ]


@pytest.mark.parametrize("folder", RULES)
def test_folder_keeps_to_its_layer(folder):
    assert sources(place(ROOT, folder)), "nothing there: did the folder move? Move the rule too"
    assert check(ROOT, folder) == []


# Public headers: nothing but themselves and the standard library, whose headers have no folder and
# no ending.


def public_violations(root):
    found = []
    headers = {p.name for p in (root / PUBLIC / "hlodbench").glob("*")}
    for path in sources(root / PUBLIC):
        for name in includes(path):
            if name not in headers and not re.fullmatch(r"[a-z_]+", name):
                found.append(f"{path.name} -> {name}")
    return found


def test_public_headers_need_nothing_but_the_standard_library():
    names = {p.name for p in (ROOT / PUBLIC / "hlodbench").iterdir()}
    assert "plugin.h" in names
    assert public_violations(ROOT) == []


@pytest.mark.parametrize(
    "name", ["glm/glm.hpp", "hlod/tree/hierarchy.h", "traversals/bias.h", "fmt/format.h",
             "../../bias.h", "dlfcn.h", "nlohmann/json.hpp"])
def test_check_of_public_headers_finds(tmp_path, name):
    write(tmp_path, {f"{PUBLIC}/hlodbench/a.h": f"#include <vector>\n#include <{name}>\n",
                     f"{PUBLIC}/hlodbench/b.h": '#include "a.h"\n'})
    assert public_violations(tmp_path) == [f"a.h -> {name}"]


def write(root, files):
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


BAD = {
    "a strategy includes glad": ("traversals", {"src/traversals/a.cpp": "#include <glad/gl.h>\n"}),
    "in another spelling": ("traversals", {"src/traversals/a.h": '  #  include "GL/gl.h"\n'}),
    "through two headers of ours": (
        "traversals",
        {
            "src/traversals/a.cpp": '#include "traversals/a.h"\n',
            "src/traversals/a.h": '#include "hlod/view/b.h"\n',
            "src/hlod/view/b.h": "#include <EGL/egl.h>\n",
        },
    ),
    "through a header of the program": (
        "traversals",
        {"src/traversals/a.cpp": '#include "loop.h"\n', "bench/loop.h": "#include <GL/osmesa.h>\n"},
    ),
    "a renderer header without GL in it": (
        "traversals",
        {"src/traversals/a.cpp": '#include "hlod/render/r.h"\n', "src/hlod/render/r.h": "\n"},
    ),
    "by a relative path": (
        "traversals",
        {"src/traversals/a.cpp": '#include "../hlod/render/r.h"\n', "src/hlod/render/r.h": "\n"},
    ),
    "the renderer includes a strategy": (
        "hlod/render",
        {"src/hlod/render/r.cpp": '#include "traversals/a.h"\n', "src/traversals/a.h": "\n"},
    ),
    "through a public header": (
        "traversals",
        {
            "src/traversals/a.cpp": "#include <hlodbench/p.h>\n",
            f"{PUBLIC}/hlodbench/p.h": "#include <GL/gl.h>\n",
        },
    ),
    "recording includes the window": (
        "bench/view",
        {"bench/view/a.cpp": '#include "gui/window.h"\n', "bench/gui/window.h": "\n"},
    ),
    "the tree includes glad": ("hlod/tree", {"src/hlod/tree/t.cpp": '#include "glad/gl.h"\n'}),
}


@pytest.mark.parametrize("case", BAD)
def test_check_finds(case, tmp_path):
    folder, files = BAD[case]
    write(tmp_path, files)
    assert check(tmp_path, folder) != []


def test_check_names_the_whole_chain(tmp_path):
    write(tmp_path, BAD["through two headers of ours"][1])
    assert check(tmp_path, "traversals") == [
        "traversals/a.cpp -> traversals/a.h -> hlod/view/b.h -> EGL/egl.h",
        "traversals/a.h -> hlod/view/b.h -> EGL/egl.h",
    ]


def test_check_accepts_comments_cycles_and_like_names(tmp_path):
    write(
        tmp_path,
        {
            "src/traversals/a.cpp": (
                '// #include <glad/gl.h>\n/*\n#include "GL/gl.h"\n*/\n'
                '#include <glm/glm.hpp>\n#include "traversals/a.h"\n#include "gladly.h"\n'
            ),
            "src/traversals/a.h": '#include "traversals/b.h"\n',
            "src/traversals/b.h": '#include "traversals/a.h"\n',
        },
    )
    assert check(tmp_path, "traversals") == []
