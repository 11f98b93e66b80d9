"""Calls of a user of the public client to a box. Lines that begin with `= ` are read by the test."""
import sys

from NetFT import Sensor

box = Sensor(sys.argv[1])
first = box.getMeasurement()
print("=", len(first), all(abs(count) < 20_000 for count in first))
box.tare(10)
after = box.getMeasurement()
print("=", all(abs(count) < 2_000 for count in after))
