"""The machine that times are of, and how busy others keep it."""
import os
import re
import resource
import time

BUSY = 0.15  # cores in use by others that are worth a remark


class OtherLoad:
    """How much of the machine others use while programs run here."""

    def __init__(self):
        self.start = self._now()

    @staticmethod
    def _now():
        """Wall seconds, busy CPU seconds of the machine, and those of our children; without /proc the last two
        are equal."""
        own = resource.getrusage(resource.RUSAGE_CHILDREN)
        own = own.ru_utime + own.ru_stime
        try:
            with open("/proc/stat", encoding="ascii") as file:
                user, nice, system, _, _, *rest = map(int, file.readline().split()[1:])
            busy = (user + nice + system + sum(rest[:3])) / os.sysconf("SC_CLK_TCK")
        except (OSError, ValueError):
            busy = own
        return time.monotonic(), busy, own

    def cores(self):
        """Mean number of cores in use by others since the start."""
        wall, busy, own = (b - a for a, b in zip(self.start, self._now()))
        return max(busy - own, 0.0) / max(wall, 1e-3)


def description():
    """The processor's name and the number of its threads."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            name = re.search(r"model name\s*:\s*(.*)", file.read())
    except OSError:
        name = None
    return f"{name.group(1).strip() if name else 'unknown processor'}, {os.cpu_count()} hardware threads"


def load_remark(records):
    """A sentence when other programs ran beside the runs of these records, each with "cores_of_others"."""
    others = max(r["cores_of_others"] for r in records)
    if others < BUSY:
        return ""
    return (f" Other programs used up to {others:.1f} cores meanwhile; on shared cores and memory CPU seconds are up to "
            "half as long again.")
