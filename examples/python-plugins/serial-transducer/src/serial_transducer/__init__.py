"""A force transducer on a serial port: it sends its load in N, a line a reading."""

from __future__ import annotations

import math
from typing import Annotated

import serial

import taceva.plugin as tp

BAUD = 115_200
LINE_MAX = 64
DAMAGED_MAX = 10


class Transducer(tp.Force, source="real", axes=["Fz"], rate_hz=100, noise_N=0.01, resolution_N=0.001, tare=True):
    """A load cell that sends lines."""

    def __init__(self, port: Annotated[str, tp.Arg(help="such as /dev/ttyUSB0")]) -> None:
        # Exclusive: another program would take some of the lines.
        self.port = serial.Serial(port, BAUD, timeout=0)
        self.line = b""
        self.zero_load = 0.0

    def start(self, deadline: tp.Deadline) -> None:
        # What waited in the port is old.
        self.port.reset_input_buffer()
        self.line = b""

    def measured(self, deadline: tp.Deadline) -> float:
        """The newest load of a whole line, N."""
        damaged = 0
        while True:
            self.line += self.port.read(4096)
            *whole, rest = self.line.rsplit(b"\n", 1)
            if not whole:
                if len(rest) > LINE_MAX:
                    raise tp.Failure("protocol", f"{LINE_MAX} bytes without an end of line, expected a number and a line feed")
                deadline.rest(0.002)
                continue
            self.line = rest
            text = whole[0].rsplit(b"\n", 1)[-1].strip()
            try:
                load = float(text)
            except ValueError:
                load = math.nan
            if math.isfinite(load):
                return load
            # A line that was cut while nobody read.
            damaged += 1
            if damaged == DAMAGED_MAX:
                raise tp.Failure("protocol", f"{text!r}, expected a load in N; {DAMAGED_MAX} lines were damaged")

    def read(self, deadline: tp.Deadline) -> tp.Reading:
        load = self.measured(deadline)
        return tp.Reading(load - self.zero_load, tp.now())

    def zero(self, deadline: tp.Deadline) -> None:
        self.zero_load = self.measured(deadline)

    def close(self) -> None:
        self.port.close()


plugin = tp.Plugin("org.example.serial-transducer", "1.0.0", {"line": Transducer}, needs=["serial:{port}"])
