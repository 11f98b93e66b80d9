"""A job of the public client for a printer, one line of which is damaged on its way. Lines that begin with `= ` are read by the test."""
import os
import sys
import time

from printrun import gcoder
from printrun.printcore import printcore

said = []
printer = printcore()
printer.recvcb = said.append
printer.connect(sys.argv[1], 115200)
for _ in range(200):
    if printer.online:
        break
    time.sleep(0.05)
print("\n=", bool(printer.online))
write, damaged = printer.printer.write, []


def worse(line):
    if line.startswith(b"N2 ") and not damaged:
        damaged.append(line)
        line = line.replace(b"Z270", b"Z240")
    return write(line)


printer.printer.write = worse
printer.startprint(gcoder.LightGCode(["G21", "G90", "G1 X300 Y1 Z270 F600", "G1 Z271", "M400"]))
for _ in range(400):
    if not printer.printing:
        break
    time.sleep(0.05)
print("=", bool(printer.printing), len(damaged))
print("=", any(line.startswith("Resend: 2") for line in said), any("Unknown" in line for line in said), flush=True)
# Its threads wait for the printer.
os._exit(0)
