"""Hashes of what a scene or session file says, wherever the file lies."""

import hashlib
import json
import os
import pathlib
import re

from .errors import SweepError
from .program import hash_file

VARIABLE = re.compile(r"\$\{([^}:]*)(?::-([^}]*))?\}")


class Inputs:
    """Hashes files, each once however many cells read it."""

    def __init__(self):
        self._hashes = {}

    def hash_file(self, path, what):
        """SHA-256 of one file; SweepError if it cannot be read."""
        path = pathlib.Path(path)
        if path not in self._hashes:
            try:
                self._hashes[path] = hash_file(path)
            except OSError as error:
                raise SweepError(f"{path}: expected {what}: {error.strerror}") from None
        return self._hashes[path]

    def hash_scene(self, path):
        """Of a hierarchy or mesh, its bytes; of a scene file, its bytes and those of its meshes."""
        parts = [self.hash_file(path, "a scene")]
        if pathlib.Path(path).suffix == ".json":
            parts += [self.hash_file(mesh, f"a mesh of {path}") for mesh in list_meshes(path)]
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def list_meshes(path):
    """The mesh files that a scene file names, in its order. What is wrong with the file is left to
    the program, which says so better."""
    path = pathlib.Path(path)
    try:
        meshes = json.loads(path.read_text(encoding="utf-8")).get("meshes") or {}
        names = [mesh["file"] for mesh in meshes.values()]
        return [path.parent / VARIABLE.sub(_value_of, name) for name in names]
    except (ValueError, AttributeError, TypeError, KeyError):
        return []


def _value_of(match):
    """${NAME} and ${NAME:-text}, as scene files have them."""
    return os.environ.get(match[1]) or match[2] or ""
