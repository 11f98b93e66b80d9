#!/usr/bin/env bash
# xarm-python-sdk 1.18.4: a relative motion of one joint sends infinite differences for the other joints, from firmware 2.4.101 on.
#
# `set_servo_angle(servo_id=1, angle=5, relative=True)` asks a controller to turn one joint by five degrees. The client writes the
# other joints as +infinity, which means "unchanged" and is no number to add. Firmware up to 2.4.100 gets zeros. Software that
# stands in for the controller, or records what a client asks, makes infinite or undefined angles of it.
# Seen: `v2.4.100: 0.0873 0.0 0.0 0.0 0.0 0.0` and `v2.4.101: 0.0873 inf inf inf inf inf` (rad).
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv environment
environment/bin/pip install --quiet xarm-python-sdk==1.18.4

cat > client.py <<'PYTHON'
import socket
import struct
import sys
import threading
import time

version = sys.argv[1]
differences = []
MOVE_RELATIVE = 83


def requests(stream):
    """Requests of the client, each answered with success."""
    stream.settimeout(None)
    read = b""
    while more := stream.recv(4096):
        read += more
        while len(read) >= 6 and len(read) >= 6 + int.from_bytes(read[4:6], "big"):
            number, protocol, size = struct.unpack(">HHH", read[:6])
            code, data = read[6], read[7 : 6 + size]
            read = read[6 + size :]
            if code == MOVE_RELATIVE:
                differences.extend(struct.unpack("<6f", data[:24]))
            answer = version.encode().ljust(40, b"\0") if code == 1 else bytes(60)
            answer = bytes([code, 0]) + answer
            stream.sendall(struct.pack(">HHH", number, protocol, len(answer)) + answer)


def reports(stream):
    """Reports of an arm at rest without a fault."""
    while True:
        stream.sendall(struct.pack(">I", 87) + bytes(83))
        time.sleep(0.1)


def listen(port, serve):
    door = socket.create_server(("127.0.0.1", port))

    def accept():
        while True:
            stream, _ = door.accept()
            threading.Thread(target=serve, args=(stream,), daemon=True).start()

    threading.Thread(target=accept, daemon=True).start()


# The client knows no other ports: commands and reports.
listen(502, requests)
listen(30003, reports)

from xarm.wrapper import XArmAPI

arm = XArmAPI("127.0.0.1", report_type="real", check_joint_limit=False)
arm.motion_enable(True)
arm.set_mode(0)
arm.set_state(0)
assert arm.set_servo_angle(servo_id=1, angle=5, relative=True, speed=20) == 0
time.sleep(0.3)
print(f"= {version}:", *(round(by, 4) for by in differences), flush=True)
PYTHON

run() { timeout 60 environment/bin/python client.py "$1" | grep '^= ' | cut -c 3-; }
before=$(run v2.4.100)
since=$(run v2.4.101)
printf '%s\n%s\n' "$before" "$since"
[ "$before" = "v2.4.100: 0.0873 0.0 0.0 0.0 0.0 0.0" ]
[ "$since" = "v2.4.101: 0.0873 inf inf inf inf inf" ]
