"""Calls of a user of the public client to a box. Lines that begin with `= ` are read by the test."""
import json
import socket
import sys

from NetFT import Sensor

host, control_port = sys.argv[1], int(sys.argv[2])
control = socket.create_connection((host, control_port)).makefile("rw")

box = Sensor(host)
first = box.getMeasurement()
print("=", len(first), all(abs(count) < 20_000 for count in first))
box.tare(10)
after = box.getMeasurement()
print("=", all(abs(count) < 2_000 for count in after))
# Into the gel. A box that sent more records than were asked for would answer with those from before.
control.write('{"jog": {"by_mm": [0, 0, 20.5]}}\n')
control.flush()
assert json.loads(control.readline())["ok"]
loaded = box.getMeasurement()
print("=", abs(loaded[2]) > 1_000_000, any(abs(count) > 1_000 for count in loaded[3:]))
