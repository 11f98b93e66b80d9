"""Inputs and outputs that a user of the public client sets at an arm. Lines that begin with `= ` are read by the test."""
import sys
import time

from rtde_io import RTDEIOInterface
from rtde_receive import RTDEReceiveInterface

host = sys.argv[1]
io = RTDEIOInterface(host)
print("\n=", io.setSpeedSlider(0.25), io.setStandardDigitalOut(1, True), io.setAnalogOutputVoltage(0, 0.5), flush=True)
# A message has no answer.
time.sleep(0.3)
arm = RTDEReceiveInterface(host, 125.0)
print("=", round(arm.getSpeedScaling(), 3), flush=True)
print("=", io.setSpeedSlider(1.0), flush=True)
time.sleep(0.3)
print("=", round(arm.getSpeedScaling(), 3), flush=True)
arm.disconnect()
io.disconnect()
