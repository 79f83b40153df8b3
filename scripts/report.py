#!/usr/bin/env python3
"""Makes one HTML file that shows result folders: tables, plots over frames, and their pictures.

The file opens from disk and loads nothing from anywhere: plots, pictures and numbers are inside.
"""

import sys

try:
    import jinja2  # noqa: F401
    import numpy  # noqa: F401
    import PIL  # noqa: F401
except ImportError as error:
    print(f"report.py: needs {error.name} (Debian: python3-jinja2, python3-numpy, python3-pil)",
          file=sys.stderr)
    sys.exit(2)

from report.cli import main

if __name__ == "__main__":
    sys.exit(main())
