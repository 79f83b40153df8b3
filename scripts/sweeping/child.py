"""Child processes that do not outlive the one that started them."""

import ctypes
import os
import signal
import subprocess

PR_SET_PDEATHSIG = 1
LIBC = ctypes.CDLL(None, use_errno=True)


def start(command, death_signal=signal.SIGTERM, **options):
    """subprocess.Popen of a child that gets `death_signal` when this process dies, however it dies
    (on Linux; elsewhere it gets nothing)."""
    parent = os.getpid()

    def tie():
        if hasattr(LIBC, "prctl"):
            LIBC.prctl(PR_SET_PDEATHSIG, int(death_signal))
            if os.getppid() != parent:  # it died in between
                os.kill(os.getpid(), death_signal)
    return subprocess.Popen(command, preexec_fn=tie, **options)


def die_with_parent(death_signal=signal.SIGTERM):
    """The same for this process, which something else has started."""
    if hasattr(LIBC, "prctl"):
        LIBC.prctl(PR_SET_PDEATHSIG, int(death_signal))
