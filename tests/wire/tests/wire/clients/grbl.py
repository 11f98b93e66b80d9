"""Calls of a user of the public client to a machine. Lines that begin with `= ` are read by the test."""
import os
import sys
import threading

from grbl_streamer import GrblStreamer

seen, errors, arrived = [], [], threading.Event()


def heard(event, *said):
    if event == "on_read":
        seen.append(said[0])
    elif event == "on_error":
        errors.append(said)
    elif event == "on_stateupdate" and said[0] == "Idle" and abs(said[1][2] - 270) < 1e-6:
        arrived.set()


def has(text, seconds=10):
    for _ in range(seconds * 20):
        if any(line.startswith(text) for line in list(seen)):
            return True
        threading.Event().wait(0.05)
    return False


machine = GrblStreamer(heard)
machine.setup_logging()
machine.poll_interval = 0.05
machine.cnect(sys.argv[1], 115200)
print("\n=", has("Grbl 1.1"), has("$132="))
machine.poll_start()
print("=", has("[G54:"), has("[PRB:"), has("[GC:"))
machine.send_immediately("G53 G1 X300 Y1 Z270 F600")
print("=", arrived.wait(10), machine.cmpos, errors, flush=True)
# Its threads wait for the machine.
os._exit(0)
