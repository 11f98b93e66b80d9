"""Values that a user of the public client reads from an arm, and its dashboard. Lines that begin with `= ` are read by the test."""
import json
import socket
import sys

from dashboard_client import DashboardClient
from rtde_receive import RTDEReceiveInterface

host, control_port = sys.argv[1], int(sys.argv[2])
control = socket.create_connection((host, control_port)).makefile("rw")

arm = RTDEReceiveInterface(host, 125.0)
pose = arm.getActualTCPPose()
print("\n=", *(round(number, 4) for number in pose))
print("=", arm.getRobotMode(), arm.getRuntimeState(), round(arm.getSpeedScaling(), 3), flush=True)
arm.disconnect()

dashboard = DashboardClient(host)
dashboard.connect()
print("=", dashboard.polyscopeVersion(), dashboard.robotmode(), dashboard.running(), flush=True)
print("=", dashboard.safetystatus(), flush=True)
control.write('{"inject": {"fault": "collision"}}\n')
control.flush()
assert json.loads(control.readline())["ok"]
print("=", dashboard.safetystatus(), flush=True)
dashboard.unlockProtectiveStop()
print("=", dashboard.safetystatus(), flush=True)
dashboard.disconnect()
