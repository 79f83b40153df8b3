"""How the tests make a report and read what is in it."""

import base64
import io
import json
import stat
from html.parser import HTMLParser

import numpy as np
from PIL import Image

# A stand-in for hlodbench: prints what files beside it hold, refuses folders named "refused".
PROGRAM = """\
#!/bin/sh
# table --format STYLE -- DIR...
style=$3
shift 4
for folder in "$@"; do
  case $folder in *refused*) echo "error: $folder/run.json: cases: nonsense" >&2; exit 2 ;; esac
done
exec cat "$(dirname "$0")/table.$style"
"""
HEADER = ("folder,scene,session,strategy,label,repetitions,failures,frames,complete,ours_dn,"
          "ours_rarn,ours_d,ours_fps,ours_fps_frame_mean,ours_speedup,ours_speedup_low,"
          "ours_speedup_high,ours_delayed_share,paper_scene,paper_dn,paper_rarn,paper_d,paper_fps,"
          "paper_speedup,paper_delayed_share")
LATEX = "% Needs \\usepackage{booktabs}.\n\\begin{table}\n</script> 2\\,\\% & <b>\n\\end{table}\n"


def add_library(folder):
    """A folder that passes for dygraphs, for tests that run no script."""
    folder.mkdir(exist_ok=True)
    (folder / "dygraph.min.js").write_text(
        "function Dygraph() {}\n//# sourceMappingURL=dygraph.min.js.map\n", encoding="utf-8")
    (folder / "dygraph.min.css").write_text(".dygraph-label {}\n", encoding="utf-8")
    return folder


def add_program(folder, rows, columns=""):
    """A stand-in that prints the CSV rows given, with further columns; returns its path."""
    folder.mkdir(exist_ok=True)
    program = folder / "hlodbench"
    program.write_text(PROGRAM, encoding="utf-8")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    (folder / "table.csv").write_text("\n".join([HEADER + columns, *rows]) + "\n", encoding="utf-8")
    ratios = "Ratios of DN, in brackets the paper's (scene 1): Simp\\*/SW 1.196 (1.103)\n"
    (folder / "table.markdown").write_text("### scene\n" + ratios, encoding="utf-8")
    (folder / "table.latex").write_text(LATEX, encoding="utf-8")
    return program


class Page(HTMLParser):
    """A report: tables by class, JSON by id, text, and every element with its attributes."""

    def __init__(self, path):
        super().__init__()
        self.source = path.read_text(encoding="utf-8")
        self.tables = []  # of {"class", "caption", "rows": list of lists of text}
        self.elements = []  # of (tag, attributes)
        self.scripts = []  # of (attributes, text)
        self.text = ""  # outside of scripts and styles
        self._inside = None
        self.feed(self.source)
        self.json = {a["id"]: json.loads(t) for a, t in self.scripts if "id" in a}

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.elements.append((tag, attributes))
        if tag in ("script", "style"):
            self._inside = tag
            self.scripts.append((attributes, ""))
        elif tag == "table":
            self.tables.append({"class": attributes.get("class", ""), "caption": "", "rows": []})
        elif tag == "tr":
            self.tables[-1]["rows"].append([])
        elif tag in ("td", "th"):
            self.tables[-1]["rows"][-1].append("")
            self._inside = "cell"
        elif tag == "caption":
            self._inside = tag

    def handle_endtag(self, tag):
        if tag in ("script", "style", "td", "th", "caption"):
            self._inside = None

    def handle_data(self, data):
        if self._inside in ("script", "style"):
            attributes, text = self.scripts[-1]
            self.scripts[-1] = (attributes, text + data)
            return
        self.text += data
        if self._inside == "cell":
            self.tables[-1]["rows"][-1][-1] += " ".join(data.split())
        elif self._inside == "caption":
            self.tables[-1]["caption"] += data

    def rows(self, kind, index=0):
        """{first cell: the other cells} of the index-th table of a class."""
        table = [t for t in self.tables if kind in t["class"].split()][index]
        return {row[0]: row[1:] for row in table["rows"]}

    def problems(self):
        """The lines of the box of problems."""
        start = self.source.find('<h2 id="problems">')
        box = self.source[start : self.source.find("</section>", start)] if start >= 0 else ""
        return [line.split("</li>")[0] for line in box.split("<li>")[1:]]


def decode(uri):
    """(h, w, 3) uint8 of a data URI."""
    kind, data = uri.split(",", 1)
    assert kind == "data:image/webp;base64"
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"))
