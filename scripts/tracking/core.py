"""Which core of the processor timed replays run on.

A GPU leaves the processor to one thread. Where the system moves that thread among cores, which are
not equally fast, two programs of a pair differ by more than what is looked for; where both have the
same core, they do not (docs/nightly.md has the numbers). A software rasteriser needs all cores.
"""

import contextlib
import os

from .errors import TrackingError

AUTO, ANY = "auto", "any"


def choose_core(wanted, is_gpu):
    """The number of a core, or None for any. wanted: AUTO, ANY or a number. Raises TrackingError if
    it is a number that this process may not use."""
    cores = list_cores()
    if isinstance(wanted, int):
        if wanted not in cores:
            raise TrackingError(f"--core: expected one of {', '.join(map(str, cores)) or 'none'}, "
                                f"found {wanted}")
        return wanted
    # the first ones are where systems do their own work
    return cores[-1] if wanted == AUTO and is_gpu and cores else None


def list_cores():
    """Those that this process may use; none where the system does not tell (it is not Linux)."""
    return sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []


@contextlib.contextmanager
def on_core(core):
    """Processes that this thread starts meanwhile stay on a core; None: on those that it may use."""
    if core is None:
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {core})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)
