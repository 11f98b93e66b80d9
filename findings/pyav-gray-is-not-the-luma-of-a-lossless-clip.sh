#!/usr/bin/env bash
# PyAV 18.1.0: gray frames written without loss do not read back by `to_ndarray(format="gray")`; their luma does.
#
# Gray goes into H.264 with its values as they are, and the stream is marked neither full nor limited. Reading takes it for
# limited range and stretches it: 20 becomes 5, 40 becomes 28, 230 becomes 249. Two clips, or a clip and a reference picture,
# that are read by different calls differ by more than a light press changes a pixel.
# Seen: `written 20 40 120 230 luma 20 40 120 230 gray 5 28 121 249`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv environment
environment/bin/pip install --quiet av==18.1.0 numpy==2.4.6

environment/bin/python - <<'PYTHON'
import av
import numpy as np

written = [20, 40, 120, 230]
with av.open("gray.mp4", "w") as clip:
    stream = clip.add_stream("libx264", rate=30)
    stream.width, stream.height, stream.pix_fmt = 64, 48, "gray"
    stream.options = {"crf": "0"}
    for level in written:
        frame = av.VideoFrame.from_ndarray(np.full((48, 64), level, np.uint8), format="gray")
        clip.mux(stream.encode(frame))
    clip.mux(stream.encode(None))

with av.open("gray.mp4") as clip:
    frames = list(clip.decode(video=0))
luma = [int(np.frombuffer(frame.planes[0], np.uint8)[0]) for frame in frames]
gray = [int(frame.to_ndarray(format="gray")[0, 0]) for frame in frames]
print("written", *written, "luma", *luma, "gray", *gray)
assert luma == written and gray == [5, 28, 121, 249]
PYTHON
