"""What a night leaves in its folder of results, beside the history."""

import json
import sys

from atomic_file import write_text_atomically
from run_cells import ROOT

from .build import last_line, run
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


def write_report(folder, program, results):
    """report.html of the exact tier's result folders. Why there is none, in one line, or None: it
    needs libraries that a night does not."""
    log = folder / "report.log"
    code = run([sys.executable, ROOT / "scripts" / "report.py", *results, "--out",
                folder / "report.html", "--hlodbench", program], None, log)
    return None if code == 0 else last_line(log)
