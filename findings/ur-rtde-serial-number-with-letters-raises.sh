#!/usr/bin/env bash
# ur-rtde 1.6.5: the dashboard client raises an exception for a serial number with letters, on a connection that answered as it should.
#
# `getSerialNumber()` accepts digits alone. A dashboard answers `get serial number` with a text, and simulators or other controllers that
# offer a dashboard may have letters in it. The client then raises instead of returning the text. `RTDEControlInterface` asks for the number
# too, so it cannot be made.
# Seen: `20235500007: 20235500007` and `URSIM-0007: RuntimeError: getSerialNumber() function did not return a number. …`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv environment
environment/bin/pip install --quiet ur-rtde==1.6.5

cat > client.py <<'PYTHON'
import socket
import sys
import threading

serial = sys.argv[1]


def serve():
    stream, _ = door.accept()
    stream.sendall(b"Connected: Universal Robots Dashboard Server\n")
    for line in stream.makefile():
        answers = {"PolyscopeVersion": "URSoftware 5.11.0.108249 (Jul 05 2021)", "get serial number": serial}
        stream.sendall(answers.get(line.strip(), f"could not understand: '{line.strip()}'").encode() + b"\n")


door = socket.create_server(("127.0.0.1", 29999))
threading.Thread(target=serve, daemon=True).start()

from dashboard_client import DashboardClient

dashboard = DashboardClient("127.0.0.1")
dashboard.connect()
try:
    print(f"= {serial}: {dashboard.getSerialNumber()}", flush=True)
except Exception as error:
    print(f"= {serial}: {type(error).__name__}: {error}".splitlines()[0], flush=True)
PYTHON

run() { timeout 60 environment/bin/python client.py "$1" | grep '^= ' | cut -c 3-; }
digits=$(run 20235500007)
letters=$(run URSIM-0007)
printf '%s\n%s\n' "$digits" "$letters"
[ "$digits" = "20235500007: 20235500007" ]
[[ "$letters" == "URSIM-0007: "*"getSerialNumber() function did not return a number."* ]]
