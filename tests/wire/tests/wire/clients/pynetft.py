"""Readings of a user of the newer public client. Lines that begin with `= ` are read by the test."""
import json
import socket
import sys
import time

from pynetft import Client, Config

host, records, page, control_port = sys.argv[1], *map(int, sys.argv[2:])
control = socket.create_connection((host, control_port)).makefile("rw")
control.write('{"jog": {"by_mm": [0, 0, 20.5]}}\n')
control.flush()
assert json.loads(control.readline())["ok"]

with Client(Config(sensor_host=host, rdt_port=records, http_port=page)) as box:
    assert box.wait_for_first_sample(10)
    time.sleep(0.5)
    loaded, health = box.latest_sample(), box.health()
    time.sleep(0.1)
    later = box.latest_sample()
    box.bias()
    time.sleep(0.5)
    unloaded = box.latest_sample()
print("=", loaded.force_unit.value, loaded.torque_unit.value)
print("=", abs(loaded.force[2]) > 0.1, any(abs(torque) > 1e-4 for torque in loaded.torque))
sent, measured = (later.rdt_sequence - loaded.rdt_sequence), (later.ft_sequence - loaded.ft_sequence)
print("=", sent > 0, measured == 14 * sent)
print("=", health.lost_count, health.duplicate_count, health.malformed_count, health.device_error_count)
print("=", abs(unloaded.force[2]) < 0.05)
