#!/usr/bin/env bash
# tlabel 0.23.3: its CSV says 0.0 newtons where no force was measured; its JSON of the same recording says null.
#
# A frame in contact without a force becomes a row of zero force: a model learns that a touched picture means 0 N. Temperatures
# and torques that were never measured are 0.0 too. Rows cannot be told from measured zeros, except by `contact`.
# Seen: `CSV: contact 1.0, force 0.0 0.0 0.0, temperature 0.0; JSON: force None, temperature None`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv environment
environment/bin/pip install --quiet tlabel==0.23.3 numpy==2.4.6

environment/bin/python -W ignore - <<'PYTHON'
import csv
import json

from tlabel.core.schema import TLabelSchemaV2
from tlabel.core.types import TLabelData, TLabelFrame
from tlabel.export.writer import export_data

measured = TLabelSchemaV2(contact=True, force_vector=[1.0, 2.0, -2.0], force_magnitude=3.0, temperature=25.0)
missing = TLabelSchemaV2(contact=True, force_vector=None, force_magnitude=None, temperature=None)
recording = TLabelData(
    frames=[TLabelFrame(0, 0.0, measured), TLabelFrame(1, 0.1, missing)],
    sensor_info={"sensor_type": "gelsight", "sensor_name": "mini"},
    episode_info={"episode_id": "e0"},
    capabilities={"contact": True},
)
export_data(recording, "run.csv")
export_data(recording, "run.json")

row = list(csv.DictReader(open("run.csv")))[1]
force = [row[f"force_{axis}"] for axis in "xyz"]
with open("run.json") as file:
    kept = json.load(file)["frames"][1]["schema_v2"]
print(f"CSV: contact {row['contact']}, force {' '.join(force)}, temperature {row['temperature']}; "
      f"JSON: force {kept['force_vector']}, temperature {kept['temperature']}")
assert row["contact"] == "1.0" and force == ["0.0"] * 3 and row["temperature"] == "0.0"
assert kept["force_vector"] is None and kept["temperature"] is None
PYTHON
