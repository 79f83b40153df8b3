"""Where and how each folder was measured, for the table on top of the report."""

import shlex

from .values import DASH, get_path

# What, and where in run.json's context.
LINES = (
    ("OpenGL renderer", ("gl", "renderer")),
    ("OpenGL version", ("gl", "version")),
    ("Processor", ("cpu_model",)),
    ("Cores", ("cpu_cores",)),
    ("System", ("distribution",)),
    ("Kernel", ("kernel",)),
    ("Program", ("program",)),
    ("Revision", ("git_revision",)),
    ("Build type", ("build_type",)),
    ("Compiler", ("compiler",)),
    ("Date (UTC)", ("time_utc",)),
)


def make_environment(runs):
    """Lines of the table: (name, one text for each run)."""
    lines = [("Folder", [str(run.folder) for run in runs])]
    for name, keys in LINES:
        lines.append((name, [format_value(get_path(run.data["context"], *keys)) for run in runs]))
    lines.append(("Load before (1, 5, 15 min)",
                  [format_value(get_path(run.data["context"], "load_average")) for run in runs]))
    lines.append(("Arguments", [format_arguments(run) for run in runs]))
    return lines


def format_value(value):
    """One value as text."""
    if value is None or value == "":
        return DASH
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)


def format_arguments(run):
    """The command line as a shell takes it."""
    arguments = get_path(run.data["context"], "arguments")
    if not isinstance(arguments, list) or not arguments:
        return DASH
    return " ".join(shlex.quote(str(argument)) for argument in arguments)


def collect_warnings(runs):
    """(warning, folders it holds for), each warning once, in the order met."""
    found = {}
    for run in runs:
        warnings = get_path(run.data["context"], "warnings")
        for warning in warnings if isinstance(warnings, list) else []:
            found.setdefault(str(warning), []).append(str(run.folder))
        if run.data.get("complete") is False:
            text = "the run was interrupted: its averages are of what was finished"
            found.setdefault(text, []).append(str(run.folder))
    return list(found.items())
