"""Failed calls of the system and failed allocations: whatever fails, a program ends with exit code 0
and the bytes that it would write without the fault, or with exit code 6, one `error:` line, nothing
torn or lost, and an output from which the next run goes on.

Every call of each kind fails once, in one of the ways that are possible, and some allocations; --sample
takes some of all these.

usage: test_faults.py --sample | --all
"""
import collections
import errno
import os
import pathlib
import random
import sys
import tempfile

from fault_case import Broken, make_cases

# What may happen to each call of the system; a number is an error.
FAULTS = {
    "write": [errno.EIO, errno.ENOSPC, errno.EINTR, "short", "torn"],
    "pwrite": [errno.EIO, errno.ENOSPC, errno.EINTR, "short", "torn"],
    "fsync": [errno.EIO, errno.EINTR], "ftruncate": [errno.EIO, errno.EINTR],
    "rename": [errno.EIO], "renameat2": [errno.EIO, errno.EINVAL], "link": [errno.EIO],
    "close": [errno.EIO, errno.EINTR], "fallocate": [errno.ENOSPC, errno.EOPNOTSUPP, errno.EINTR],
    "open": [errno.EMFILE, errno.EACCES]}
HARMLESS = (errno.EINTR, errno.EOPNOTSUPP, errno.EINVAL, "short")
FOR_GOOD = ("write", "pwrite", "fsync", "ftruncate", "rename")  # calls that may also fail from there on
SAMPLE_OF_CALLS, SAMPLE_OF_ALLOCATIONS = 60, 40
ALL_ALLOCATIONS = 60  # by case and size


class Faults:
    def __init__(self, root, everything):
        self.count_file = root / "count"
        self.everything = everything
        self.random = random.Random(1)
        self.cases = make_cases(root)
        self.codes = collections.Counter()
        self.broken = []

    def run(self, case, text, kind, **environment):
        try:
            self.codes[kind, case.run_with(**environment)] += 1
        except Broken as error:
            self.codes[kind, "BROKEN"] += 1
            self.broken.append(f"{case.work.name}: {text}: {error}")
            print("FAILED", self.broken[-1], flush=True)
        if sum(self.codes.values()) % 100 == 0:
            print(f"{sum(self.codes.values())} runs", flush=True)

    def sample(self, places, size):
        return self.random.sample(places, len(places) if self.everything else min(size, len(places)))

    def calls(self):
        places = []
        preload = os.environ["FAILING_CALLS"]
        for case in self.cases:
            case.prepare()
            environment = {"LD_PRELOAD": preload, "FAULT_FOLDER": str(case.work)}
            case.run(check=True, FAULT_COUNT=str(self.count_file), **environment)
            counts = dict(line.split() for line in self.count_file.read_text().splitlines())
            print(f"{case.work.name}: " + ", ".join(f"{n} {name}" for name, n in counts.items() if n != "0"))
            for name, kinds in FAULTS.items():
                choices = [("", kind) for kind in kinds] + [("+", errno.ENOSPC)] * (name in FOR_GOOD)
                for k in range(1, int(counts[name]) + 1):
                    places.append((case, name, k, *self.random.choice(choices), environment))
        for case, name, k, more, kind, environment in self.sample(places, SAMPLE_OF_CALLS):
            fault = f"{name}:{k}{more}:{kind}"
            self.run(case, fault, name, must_succeed=kind in HARMLESS, FAULT=fault, **environment)

    def allocations(self):
        places = []
        for case in self.cases:
            for size in ("0", "2000"):
                environment = {"LD_PRELOAD": os.environ["FAILING_ALLOCATIONS"], "FAULT_SIZE": size}
                first = self.count(case, environment, [case.command[0], "--version"])  # those of the loader
                last = self.count(case, environment)
                for k in self.random.sample(range(first + 1, last + 1), min(last - first, ALL_ALLOCATIONS)):
                    places.append((case, f"{k}{self.random.choice(['', '+'])}", environment))
        for case, fault, environment in self.sample(places, SAMPLE_OF_ALLOCATIONS):
            text = f"allocation {fault} of at least {environment['FAULT_SIZE']} bytes"
            self.run(case, text, "allocation", FAULT=fault, **environment)

    def count(self, case, environment, command=None):
        case.prepare()
        case.run(check=True, command=command, FAULT_COUNT=str(self.count_file), **environment)
        return int(self.count_file.read_text())

    def report(self):
        print(f"{sum(self.codes.values())} runs with a fault")
        for kind in sorted({kind for kind, _ in self.codes}):
            print(f"{kind}: " + ", ".join(f"{n} times {'exit code ' if code != 'BROKEN' else ''}{code}"
                                          for (of, code), n in sorted(self.codes.items(), key=str) if of == kind))
        return 1 if self.broken or not self.codes else 0


def main():
    if sys.argv[1:] not in (["--sample"], ["--all"]):
        sys.exit(__doc__)
    memory = "/dev/shm"  # where nobody waits for a disk
    with tempfile.TemporaryDirectory(prefix="bem_faults_", dir=memory if os.access(memory, os.W_OK) else None) as folder:
        faults = Faults(pathlib.Path(folder), sys.argv[1] == "--all")
        faults.calls()
        faults.allocations()
        return faults.report()


if __name__ == "__main__":
    sys.exit(main())
