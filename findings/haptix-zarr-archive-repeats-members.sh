#!/usr/bin/env bash
# haptix 0.2.0 (zarr 3.1.5): a recording saved as `.hapt.zarr` is a ZIP in which names of members repeat.
#
# `.zattrs` of the root stands in it four times: first as `{}`, then with ever more of the manifest. The last one holds, so a
# reader that takes the first member of a name finds a recording without manifest, labels or times, and sees no error.
# Seen: `.zattrs: 4 members, the first has 0 keys, the last has labels, manifest, provenance`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv environment
environment/bin/pip install --quiet haptix==0.2.0 zarr==3.1.5 numpy==2.4.6

environment/bin/python -W ignore - <<'PYTHON'
import json
import zipfile

import numpy as np
from haptix import io
from haptix.core import HaptData, InteractionMeta, Labels, RawData, SensorMeta

taxels = np.zeros((100, 2, 3), np.int16)
taxels[:, 0, 2] = np.arange(100) * 25
recording = HaptData(
    raw=RawData(taxels, RawData.compute_checksum(taxels), str(taxels.dtype), taxels.shape),
    sensor=SensorMeta(type="taxel-pair", serial="s1", calibration_params={"unit": "mN"}),
    modality="force",
    sampling_rate_hz=200.0,
    interaction=InteractionMeta(type="pressing", normal_force_N=2.0),
    labels=Labels(object_name="cube"),
    timestamps_s=[k / 200 for k in range(100)],
)
io.save(recording, "grip.hapt.zarr")

archive = zipfile.ZipFile("grip.hapt.zarr")
members = [json.loads(archive.open(member).read()) for member in archive.infolist() if member.filename == ".zattrs"]
first, last = members[0], members[-1]
print(f".zattrs: {len(members)} members, the first has {len(first)} keys, the last has {', '.join(sorted(last))}")
assert len(members) == 4 and first == {} and sorted(last) == ["labels", "manifest", "provenance"]
PYTHON
