"""Values that a user of the public client reads from an arm. Lines that begin with `= ` are read by the test."""
import sys

from rtde_receive import RTDEReceiveInterface

arm = RTDEReceiveInterface(sys.argv[1], 125.0)
pose = arm.getActualTCPPose()
print("\n=", *(round(number, 4) for number in pose))
print("=", arm.getRobotMode(), arm.getRuntimeState(), flush=True)
arm.disconnect()
