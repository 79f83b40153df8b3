"""What a night leaves in its folder of results, beside the history."""

import json

from atomic_file import write_text_atomically

from .exporters import EXPORTERS
from .migrate import VERSION
from .summary import make_summary


def write_night(folder, night, history):
    """night.json, summary.md, and export-*.json for other tools."""
    write_text_atomically(folder / "night.json",
                          json.dumps({"schema": VERSION, **night}, indent=1) + "\n")
    write_text_atomically(folder / "summary.md", make_summary(night, history))
    for name, export in EXPORTERS.items():
        write_text_atomically(folder / f"export-{name}.json",
                              json.dumps(export(night), indent=1) + "\n")
