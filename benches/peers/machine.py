"""How busy the machine is while both sides of a comparison are measured: a ratio of times of a busy machine says nothing.

Load counts what waits for a processor or holds one, over the last minute; what other programs used is told by the processor time of the
machine less that of this script and its children. No ratio is printed where the load was above 1.5 at the beginning, or other programs
used more than half a processor since then, unless the script is called with `--anyway`.
"""
import os
import re
import resource
import subprocess
import sys

MOST_LOAD = 1.5
MOST_OTHERS = 0.5
ANYWAY = "--anyway" in sys.argv
if ANYWAY:
    sys.argv.remove("--anyway")


def processor_seconds():
    """Of this process and of its children that have ended, user and system."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def _machine():
    """Processor seconds of the machine since it began, those at work and all of them."""
    with open("/proc/stat") as file:
        ticks = [int(word) for word in file.readline().split()[1:9]]
    idle = ticks[3] + ticks[4]
    return [count / os.sysconf("SC_CLK_TCK") for count in (sum(ticks) - idle, sum(ticks))]


class Machine:
    """What this machine does from now on."""

    def __init__(self):
        self.load = os.getloadavg()[0]
        self.begun, self.ours = _machine(), processor_seconds()

    def others(self):
        """How many processors other programs used in the mean."""
        busy, total = (now - begun for now, begun in zip(_machine(), self.begun))
        seconds = max(total / os.cpu_count(), 1e-9)
        return max(busy - (processor_seconds() - self.ours), 0.0) / seconds

    def is_quiet(self):
        return self.load <= MOST_LOAD and self.others() <= MOST_OTHERS

    def ratio(self, one, other, digits=2):
        """One time over another, or a dash where the machine is too busy to say."""
        return f"{one / other:.{digits}f}" if ANYWAY or self.is_quiet() else "–"

    def said(self):
        """A line about it, for the beginning and the end of what is printed."""
        line = f"load {self.load:.1f} at the beginning, {os.getloadavg()[0]:.1f} now; other programs use {self.others():.1f} of {os.cpu_count()} processors"
        if not self.is_quiet():
            line += "; too busy for ratios" + (", which are printed anyway" if ANYWAY else ": wait, or ask for them with --anyway")
        return line


def measured(command):
    """Processor time of a command in seconds, its peak in MiB as it says itself, and what it printed."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    printed = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{command}: failed")
    peak = re.search(r"(\d+) ki?B", printed, re.I)
    return usage.ru_utime + usage.ru_stime, int(peak[1]) / 1024, printed


def in_turn(ours, theirs, rounds=5):
    """Median processor seconds of both commands, run in turn, each with its peak in MiB: of ours all of it, of theirs what it prints first."""
    both = [[], []]
    for _ in range(rounds):
        seconds, peak, _ = measured(ours)
        both[0].append((seconds, peak))
        _, peak, printed = measured(theirs)
        both[1].append((float(printed.split()[0]), peak))
    return [sorted(side)[rounds // 2] for side in both]
