#!/usr/bin/env python3
"""Time of an import by one program, in multiples of the time of another, in turn.

    python3 benches/imports.py PROGRAM OTHER_PROGRAM FOLDER MAP [ROUNDS]

Each round imports the folder by both programs into a new folder, the first of them in turn. Nothing but the standard library is needed. The exit
code is 1 if their datasets have different digests.
"""

import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time


def processor_s():
    """Processor time of all finished children, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def imported(program, folder, map_file):
    """Wall time, processor time and digest of one import."""
    with tempfile.TemporaryDirectory() as target:
        command = [program, "import", folder, "--map", map_file, "--out", f"{target}/dataset"]
        wall, processor = time.monotonic(), processor_s()
        ran = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        took = time.monotonic() - wall, processor_s() - processor
    digest = re.search(r"sha256:[0-9a-f]{64}", ran.stdout)
    if digest is None:
        sys.exit(f"{program} import printed no digest:\n{ran.stdout}")
    return took, digest[0]


def main():
    programs, (folder, map_file) = sys.argv[1:3], sys.argv[3:5]
    rounds = int(sys.argv[5]) if len(sys.argv) > 5 else 3
    ratios, digests = {"wall": [], "processor": []}, set()
    for number in range(rounds):
        order = [0, 1] if number % 2 == 0 else [1, 0]
        took = {}
        for which in order:
            took[which], digest = imported(programs[which], folder, map_file)
            digests.add(digest)
        for name, one, other in zip(ratios, took[0], took[1]):
            ratios[name].append(one / other)
    cells = [f"{name} {statistics.median(of):.2f} ({min(of):.2f} to {max(of):.2f})" for name, of in ratios.items()]
    print(f"load {os.getloadavg()[0]:.1f}, {rounds} rounds: median (range) of the ratio: {', '.join(cells)}")
    print("the digests are equal" if len(digests) == 1 else f"the digests differ: {sorted(digests)}")
    return int(len(digests) != 1)


if __name__ == "__main__":
    sys.exit(main())
