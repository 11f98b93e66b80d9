#!/usr/bin/env bash
# paxini-sdk 0.1.0: the resultant normal force is one byte of 0.1 N, so 25.6 N is read as 0 N.
#
# A resultant has six bytes, two for each axis, but the decoder takes the low byte of each: 27.5 N is read as 1.9 N, and a shear
# of +12.8 N as -12.8 N. The fall from 25.5 N to 0 within a press looks like a slip or a set zero; no flag says otherwise.
# Seen: `Fz of 25.5, 25.6, 27.5 N is read as [25.5, 0.0, 1.9] N; Fx of 12.7, 12.8 N as [12.7, -12.8] N`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv environment
environment/bin/pip install --quiet paxini-sdk==0.1.0

environment/bin/python - <<'PYTHON'
import struct

from paxini_sdk.boards.high_speed import AutoPushConfig, AutoPushFrame

configuration = AutoPushConfig([6], True, True, {6: 31})


def read(fx, fz):
    counts = struct.pack("<hhH", round(fx * 10), 0, round(fz * 10))
    frame = AutoPushFrame(configuration, 0, counts + bytes(3 * 31), b"")
    ((x, _, z),) = frame.resultant_forces_newtons.values()
    return x, z


normal = [read(0, force)[1] for force in (25.5, 25.6, 27.5)]
shear = [read(force, 0)[0] for force in (12.7, 12.8)]
print(f"Fz of 25.5, 25.6, 27.5 N is read as {normal} N; Fx of 12.7, 12.8 N as {shear} N")
assert normal == [25.5, 0.0, 1.9] and shear == [12.7, -12.8]
PYTHON
