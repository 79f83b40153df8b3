"""What other programs do meanwhile."""

import os
import resource


def _read_busy():
    """Seconds of all processors, busy and in all, since the start; (0, 0) if unknown."""
    try:
        with open("/proc/stat", encoding="ascii") as file:
            fields = [int(word) for word in file.readline().split()[1:9]]
    except (OSError, ValueError):
        return 0.0, 0.0
    user, nice, system, idle, iowait, irq, softirq, steal = fields + [0] * (8 - len(fields))
    busy = user + nice + system + irq + softirq + steal
    ticks = os.sysconf("SC_CLK_TCK")
    return busy / ticks, (busy + idle + iowait) / ticks


def _read_own():
    """Seconds of this process and of its children that have ended."""
    return sum(usage.ru_utime + usage.ru_stime for usage in
               map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


class OthersWatch:
    """The share of the processors' time that others used since it was made: other programs, and,
    in a virtual machine, the host (steal). Unlike the load average it does not count ourselves."""

    def __init__(self):
        self._busy, self._all = _read_busy()
        self._own = _read_own()

    def share(self):
        """0 to 1; None where the system does not tell."""
        busy, whole = _read_busy()
        if whole <= self._all:
            return None
        others = busy - self._busy - (_read_own() - self._own)
        return min(1.0, max(0.0, others / (whole - self._all)))
