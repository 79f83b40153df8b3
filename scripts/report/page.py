"""Puts everything into one HTML file."""

import base64
import hashlib
import json
import pathlib
import re
from dataclasses import dataclass

import jinja2
from markupsafe import Markup

PAGE_FOLDER = pathlib.Path(__file__).resolve().parent / "page"
STYLES = ("base.css", "tables.css", "scene.css", "sweep.css", "print.css")
# In the order in which they build on one another.
SCRIPTS = ("dom.js", "data.js", "theme.js", "copy.js", "plot.js", "swatch.js", "compare.js",
           "viewer.js", "scene.js", "sweep.js", "print.js", "main.js")


class MissingLibrary(Exception):
    """dygraphs is not there; the message is one line."""


def read_library(folder):
    """(script, style sheet) of dygraphs in the folder."""
    parts = []
    for kind in ("js", "css"):
        names = [f"dygraph.min.{kind}", f"dygraph.{kind}", f"dygraph-combined.{kind}"]
        path = next((folder / n for n in names if (folder / n).is_file()), None)
        if path is None:
            raise MissingLibrary(
                f"{folder / names[0]}: expected dygraphs (Debian: libjs-dygraphs; elsewhere give "
                "its folder with --plot-library), found none")
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise MissingLibrary(f"{path}: expected dygraphs: {error}") from None
        # A map of the source would be looked for beside the report.
        parts.append("\n".join(line for line in text.splitlines()
                               if "sourceMappingURL=" not in line))
    return tuple(parts)


def dump_json(value):
    """JSON that may stand inside <script>: no character of it can end the element."""
    text = json.dumps(value, ensure_ascii=True, separators=(",", ":"), allow_nan=False)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)


def clean(value):
    """The value without NaN and infinities, which JSON does not have: None in their place."""
    if isinstance(value, dict):
        return {str(key): clean(v) for key, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [clean(v) for v in value]
    if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
        return None
    return value


def compute_hash(script):
    """The source expression by which a Content-Security-Policy allows this very script."""
    digest = hashlib.sha256(script.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"


def guard(code):
    """Code that may stand inside <script>: what would end the element is always inside a string or
    a regular expression, where a backslash changes nothing."""
    return re.sub(r"<(?=/script|!--)", r"<\\", code, flags=re.IGNORECASE)


@dataclass(frozen=True)
class Parts:
    """The files that a page is made of, found in the first of the folders that has them."""

    folders: tuple = (PAGE_FOLDER,)
    template: str = "page.html"
    styles: tuple = STYLES
    scripts: tuple = SCRIPTS

    def read(self, name):
        """The text of one."""
        path = next(folder / name for folder in self.folders if (folder / name).is_file())
        return path.read_text(encoding="utf-8")


def render_page(library, content, parts=Parts()):
    """The page as text. library: of read_library(); content: the variables of the template."""
    loader = jinja2.FileSystemLoader(parts.folders)
    environment = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["dump_json"] = lambda value: dump_json(clean(value))
    own = "\n".join(parts.read(name) for name in parts.scripts)
    scripts = [guard(library[0]), '(function () {\n"use strict";\n' + own + "\n})();"]
    styles = [library[1]] + [parts.read(name) for name in parts.styles]
    return environment.get_template(parts.template).render(
        **content,
        # Browsers hash what stands between the tags, with line ends as \n.
        scripts=[Markup(script) for script in scripts],
        script_hashes=" ".join(compute_hash(script) for script in scripts),
        style=Markup("\n".join(styles)),
    )
