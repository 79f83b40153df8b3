"""Which machine a night was measured on: only nights of the same key are compared.

The key is made from what a result folder says of its machine, so that it names what has measured
and not what was asked for. Whatever of it changes, another driver or compiler, starts a new history.
"""

import hashlib
import json
import re

SOFTWARE = ("llvmpipe", "softpipe", "swrast", "swr", "swiftshader", "lavapipe", "software",
            "microsoft basic render", "gdi generic")
SLUG_LENGTH = 24
HASH_LENGTH = 8


def describe_machine(context, name=None):
    """The member "machine" of a night, from the `context` of a run.json. name: tells machines apart
    that look alike; None if that is not needed."""
    gl = context.get("gl") or {}
    machine = {
        "name": name,
        "cpu_model": context.get("cpu_model") or "unknown",
        "cpu_cores": context.get("cpu_cores") or 0,
        "gl_class": "software" if is_software(gl.get("renderer", "")) else "gpu",
        "gl_vendor": gl.get("vendor", ""),
        "gl_renderer": gl.get("renderer", ""),
        "gl_version": gl.get("version", ""),
        "compiler": context.get("compiler", ""),
        "build_type": context.get("build_type", ""),
    }
    return {"key": make_key(machine), **machine}


def make_key(machine):
    """A folder name: what a reader wants to know, and a hash of all members but the key."""
    rest = {key: value for key, value in machine.items() if key != "key"}
    digest = hashlib.sha256(json.dumps(rest, sort_keys=True).encode()).hexdigest()[:HASH_LENGTH]
    parts = [machine["name"] or machine["cpu_model"], f"{machine['cpu_cores']}c",
             machine["gl_class"], re.sub(r"\(.*", "", machine["gl_renderer"])]
    return "-".join([*filter(None, map(_slug, parts)), digest])


def is_software(renderer):
    """Whether an OpenGL renderer draws on the processor."""
    return any(word in renderer.lower() for word in SOFTWARE)


def _slug(text):
    return re.sub(r"[^a-z0-9]+", "-", text.lower())[:SLUG_LENGTH].strip("-")
