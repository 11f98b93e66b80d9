"""Processor time of reading the luma of every frame: taceva-video against PyAV (libavcodec, libdav1d), each a process of its own.

    cargo build --release -p taceva-video --features av1 --examples
    python benches/peers/video.py target/release/examples [--runs 5]

Needs av, numpy and Pillow. The clips are drawn: a bump that moves over a pattern of markers, 320×240.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import av
import numpy as np

from machine import Machine

FRAMES = 600
PEER = """
import sys, av
with av.open(sys.argv[1]) as clip:
    stream = clip.streams.video[0]
    stream.thread_type = "NONE"
    stream.thread_count = 1
    count = sum(len(bytes(frame.planes[0])) > 0 for frame in clip.decode(stream))
assert count == int(sys.argv[2]), count
"""
PACKETS = """
import sys, av
with av.open(sys.argv[1]) as clip:
    count = sum(len(bytes(packet)) > 0 for packet in clip.demux(video=0) if packet.size)
assert count == int(sys.argv[2]), count
"""


def draw(place, noise):
    y, x = np.mgrid[0:240, 0:320].astype(np.float32)
    bump = 60 * np.exp(-((x - 160 - 60 * np.cos(place / 20)) ** 2 + (y - 120 - 40 * np.sin(place / 15)) ** 2) / 1200)
    markers = 40 * ((x + bump / 8) % 16 < 3) * ((y + bump / 8) % 16 < 3)
    luma = 90 + bump - markers + noise.normal(0, 2, bump.shape)
    return np.clip(np.stack([luma, luma * 0.9, luma * 0.8], axis=-1), 0, 255).astype(np.uint8)


def encode(path, codec, pixel_format, options, rounds):
    """Writes a clip whose frames come `rounds` times; codecs that build on earlier frames have one round."""
    noise = np.random.default_rng(7)
    with av.open(str(path), "w") as clip:
        stream = clip.add_stream(codec, rate=30, options=options)
        stream.width, stream.height, stream.pix_fmt = 320, 240, pixel_format
        packets = []
        for place in range(FRAMES):
            frame = av.VideoFrame.from_ndarray(draw(place, noise), format="rgb24")
            packets += stream.encode(frame.reformat(format=pixel_format))
        packets += stream.encode()
        for lap in range(rounds):
            for packet in packets:
                again = av.Packet(bytes(packet))
                again.stream, again.time_base, again.is_keyframe = stream, packet.time_base, packet.is_keyframe
                again.pts, again.dts = packet.pts + lap * FRAMES, packet.dts + lap * FRAMES
                clip.mux(again)


def used(command):
    """Seconds of the processor that a program and its children took."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, command
    return usage.ru_utime + usage.ru_stime


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("examples", type=Path)
    arguments.add_argument("--runs", type=int, default=5)
    arguments = arguments.parse_args()
    frames, child = str(arguments.examples / "frames"), str(arguments.examples / "av1_child")
    machine = Machine()
    print(f"PyAV {av.__version__}, frames of 320×240, least of {arguments.runs} runs; {machine.said()}")
    with tempfile.TemporaryDirectory() as folder:
        for name, codec, pixel_format, options, rounds, peer in [
            ("mjpeg.avi", "mjpeg", "yuvj420p", {"qscale": "3"}, 40, PACKETS),
            ("h264.mp4", "libx264", "yuv420p", {"crf": "20"}, 1, PEER),
            ("av1.mp4", "libsvtav1", "yuv420p", {"crf": "30", "preset": "8"}, 1, PEER),
        ]:
            path = Path(folder) / name
            encode(path, codec, pixel_format, options, rounds)
            count = FRAMES * rounds
            ours, theirs, starts = [], [], []
            for _ in range(arguments.runs):
                ours.append(used([frames, str(path), "--child", child]))
                theirs.append(used([sys.executable, "-c", peer, str(path), str(count)]))
                starts.append(used([sys.executable, "-c", "import sys, av"]))
            ours_s, theirs_s = min(ours), max(min(theirs) - min(starts), 1e-3)
            print(f"{name}, {count} frames, {path.stat().st_size / 1e6:.1f} MB: {ours_s:.3f} s, "
                  f"PyAV {theirs_s:.3f} s without starting Python: {machine.ratio(ours_s, theirs_s)} ×")
    print(machine.said())


if __name__ == "__main__":
    main()
