"""Calls of a user of the vendor's client to an arm. Lines that begin with `= ` are read by the test."""
import sys
import threading
import time

from xarm.wrapper import XArmAPI

host, report = sys.argv[1:]


def say(*words):
    # The client prints too, without line ends.
    sys.stdout.write("\n= " + " ".join(str(word) for word in words) + "\n")
    sys.stdout.flush()


arm = XArmAPI(host, is_radian=False, report_type=report)
say("serial", arm.sn)
say("enabled", arm.motion_enable(True), arm.set_mode(0), arm.set_state(0))
time.sleep(0.3)
code, pose = arm.get_position()
say("at", code, *(round(number, 3) for number in pose))
say("moved", arm.set_position(300, 0, 260, 180, 0, 0, speed=50, mvacc=2000, wait=True))
say("relative", arm.set_position(z=-2, relative=True, speed=20, wait=True))
code, pose = arm.get_position()
say("at", code, *(round(number, 3) for number in pose))
say("well", arm.get_state(), arm.get_err_warn_code())


def stop():
    time.sleep(0.3)
    arm.emergency_stop()


threading.Thread(target=stop).start()
began = time.monotonic()
code = arm.set_position(z=270, speed=5, wait=True)
say("stopped", code != 0, time.monotonic() - began < 1.5)
say("refused", arm.set_position(z=270, speed=50, wait=True) != 0)
say("state", arm.get_state()[1])
arm.disconnect()
