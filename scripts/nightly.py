#!/usr/bin/env python3
"""What stands behind scripts/nightly.sh, which has the help text."""

import sys

try:
    import numpy  # noqa: F401
    import PIL  # noqa: F401
except ImportError as error:
    print(f"nightly.sh: needs {error.name} (Debian: python3-numpy, python3-pil, for "
          "/usr/bin/python3)", file=sys.stderr)
    sys.exit(2)

from tracking.cli import main

if __name__ == "__main__":
    sys.exit(main())
