"""Motions that a user of the public client asks for by its script on the controller. Lines that begin with `= ` are read by the test."""
import json
import math
import socket
import sys
import time

from dashboard_client import DashboardClient
from rtde_control import Path, PathEntry, RTDEControlInterface
from rtde_receive import RTDEReceiveInterface

host, control_port = sys.argv[1], int(sys.argv[2])
control = socket.create_connection((host, control_port)).makefile("rw")

# The upper half of the registers leaves the lower one to other clients.
flags = RTDEControlInterface.FLAGS_DEFAULT
flags |= RTDEControlInterface.FLAG_UPPER_RANGE_REGISTERS if "upper" in sys.argv else 0
arm = RTDEControlInterface(host, -1.0, flags)
seen = RTDEReceiveInterface(host, 125.0)
print("\n=", arm.isConnected(), arm.isProgramRunning(), arm.getRobotStatus(), flush=True)


def place():
    """The pose when reports of the last motion have arrived; the first angle without its sign, because a half turn has two."""
    time.sleep(0.2)
    x, y, z, rx, ry, rz = seen.getActualTCPPose()
    return [round(number, 4) + 0.0 for number in (x, y, z, abs(rx), ry, rz)]


def moves():
    return arm.getAsyncOperationProgressEx().isAsyncOperationRunning()


down = [math.pi, 0, 0]
print("=", arm.moveL([0.3, 0.002, 0.268, *down], 0.05, 0.5), *place(), flush=True)
# Angles of a UR5 whose tip is at (302, -4, 268) mm and points down.
angles = [0.356516, -1.117325, -2.337605, -1.25746, 1.570796, -1.21428]
print("=", arm.moveJ(angles, 0.2, 1.0), *place(), flush=True)
print("=", arm.moveJ_IK([0.3, 0.002, 0.268, *down], 0.2, 1.0), *place(), flush=True)
print("=", arm.moveL_FK(angles, 0.05, 0.5), *place(), flush=True)
print("=", *arm.getTCPOffset(), flush=True)

# A motion of some 12 s that nobody waits for, and its stop.
print("=", arm.moveL([0.302, -0.004, 0.262, *down], 0.0005, 0.5, True), moves(), arm.isSteady(), flush=True)
time.sleep(0.3)
arm.stopL(3.0)
stopped = place()
print("=", moves(), arm.isSteady(), 0.262 < stopped[2] < 0.268, flush=True)

print("=", arm.speedL([0, 0, -0.002, 0, 0, 0], 0.25, 0.1), flush=True)
time.sleep(0.5)
print("=", arm.isSteady(), arm.speedStop(2.0), arm.isSteady(), flush=True)
lowered = place()
print("=", stopped[2] - lowered[2] > 0.0008, lowered == place(), flush=True)

# Targets that the arm follows: each replaces the one before.
for _ in range(60):
    arm.servoL([0.301, 0.0, 0.267, *down], 0.0, 0.0, 0.008, 0.1, 300.0)
    time.sleep(0.008)
time.sleep(0.3)
print("=", arm.servoStop(10.0), *place(), flush=True)


def path(speed):
    """Two motions, of which the second ends at the place before the first."""
    path = Path()
    path.addEntry(PathEntry(PathEntry.MoveL, PathEntry.PositionTcpPose, [0.301, 0.0, 0.266, *down, speed, 0.5, 0.0]))
    path.addEntry(PathEntry(PathEntry.MoveP, PathEntry.PositionTcpPose, [0.3, 0.002, 0.268, *down, speed, 0.5, 0.0]))
    return path


# A path that the client waits for, and one that nobody waits for and that is stopped.
print("=", arm.movePath(path(0.05), False), *place(), flush=True)
print("=", arm.movePath(path(0.0005), True), moves(), flush=True)
time.sleep(0.3)
arm.stopL(3.0)
print("=", moves(), 0.266 < place()[2] < 0.268, flush=True)

# A collision ends the script. A person unlocks the arm, and the client sends the script again.
print("=", arm.moveL([0.3, 0.0, 0.2713, *down], 0.0005, 0.5, True), flush=True)
control.write('{"inject": {"fault": "collision"}}\n')
control.flush()
assert json.loads(control.readline())["ok"]
stood = place()
print("=", arm.isProgramRunning(), arm.moveL([0.3, 0.0, 0.2713, *down], 0.05, 0.5), stood == place(), flush=True)
dashboard = DashboardClient(host)
dashboard.connect()
dashboard.unlockProtectiveStop()
dashboard.disconnect()
print("=", arm.reuploadScript(), flush=True)
deadline = time.monotonic() + 10.0
while not arm.isProgramRunning() and time.monotonic() < deadline:
    time.sleep(0.01)
print("=", arm.moveL([0.3, 0.0, 0.2713, *down], 0.05, 0.5), *place(), flush=True)

arm.stopScript()
time.sleep(0.2)
print("=", arm.isProgramRunning(), seen.getRuntimeState(), flush=True)
seen.disconnect()
arm.disconnect()
