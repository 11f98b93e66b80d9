"""Motions of every kind by the vendor's client, and a collision. Lines that begin with `= ` are read by the test."""
import socket
import sys
import threading
import time

from xarm.wrapper import XArmAPI

host, control_port = sys.argv[1], int(sys.argv[2])


def say(*words):
    # The client prints too, without line ends.
    sys.stdout.write("\n= " + " ".join(str(word) for word in words) + "\n")
    sys.stdout.flush()


def at():
    code, pose = arm.get_position()
    # A half turn is 180 or -180 degrees.
    pose[3] = abs(pose[3])
    return [code] + [round(number, 2) + 0.0 for number in pose]


control = socket.create_connection((host, control_port)).makefile("rw")


def inject(text):
    control.write('{"inject": ' + text + "}\n")
    control.flush()
    assert '"ok":true' in control.readline().replace(" ", "")


arm = XArmAPI(host, is_radian=False)
say("serial", *arm.get_robot_sn())
arm.motion_enable(True)
arm.set_mode(0)
arm.set_state(0)
time.sleep(0.3)
say("checked", arm.set_position(z=265, speed=50, only_check_type=1), arm.only_check_result)
say("checked", arm.set_position(z=900, speed=50, only_check_type=1), arm.only_check_result)
say("stays", *at())
say("tool", arm.set_tool_position(z=1.3, speed=20, wait=True), *at())
say("turned", arm.set_tool_position(yaw=10, speed=20, wait=True), *at())
arm.set_tool_position(yaw=-10, speed=20, wait=True)
say("rotation", arm.set_position_aa([300, 0, 265, 180, 0, 0], speed=20, wait=True), *at())
say("by", arm.set_position_aa([0, 2, -1, 0, 0, 0], speed=20, relative=True, wait=True), *at())
code, pose = arm.get_position_aa()
say("vector", code, *(round(abs(number), 2) for number in pose))
code, home = arm.get_servo_angle()
say("joint", arm.set_servo_angle(servo_id=1, angle=5, relative=True, speed=20, wait=True))
radius = 300**2 + 2**2
x, y = arm.get_position()[1][:2]
say("swung", abs(x * x + y * y - radius) < 1, round(arm.get_servo_angle(servo_id=1)[1] - home[0], 3))
say("back", arm.set_servo_angle(angle=home[:6], speed=20, wait=True), *at())
began = time.monotonic()
say("slow", arm.set_position(z=-0.03, relative=True, speed=0.01, wait=True), time.monotonic() - began < 2)

# Reports stand still, so that the client learns of the collision by its questions.
inject('{"device": "robot", "fault": "frozen", "seconds": 3}')


def collide():
    time.sleep(0.3)
    inject('{"fault": "collision"}')


threading.Thread(target=collide).start()
say("collided", arm.set_position(z=300, speed=5, wait=True), arm.error_code)
say("refused", arm.set_position(z=290, speed=5, wait=True))
say("reads", arm.get_position()[0], arm.get_err_warn_code())
arm.disconnect()
