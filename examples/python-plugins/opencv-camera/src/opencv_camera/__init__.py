"""A camera of OpenCV: it plays a video file, over and over. With an index instead of a file it is a real camera."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import cv2

import taceva.plugin as tp

WIDTH, HEIGHT, RATE_HZ = 320, 240, 30.0


class Video(tp.Sensor, source="recorded", frame=(WIDTH, HEIGHT, "rgb8"), rate_hz=RATE_HZ):
    """A video file of 320×240 pixels."""

    def __init__(self, file: Annotated[Path, tp.Arg(help="a video of 320×240 pixels")]) -> None:
        self.file = str(file)
        # What cannot be opened is refused now, and not when the run has begun.
        self.video = self.opened()
        self.due = 0.0

    def opened(self) -> cv2.VideoCapture:
        video = cv2.VideoCapture(self.file)
        if not video.isOpened():
            raise tp.Failure("not found", f"{self.file}: no video that OpenCV reads")
        width, height = (int(video.get(side)) for side in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT))
        if (width, height) != (WIDTH, HEIGHT):
            raise ValueError(f"{self.file}: pictures of {width}×{height}, expected {WIDTH}×{HEIGHT}")
        return video

    def start(self, deadline: tp.Deadline) -> None:
        self.due = tp.now()

    def capture(self, into, deadline: tp.Deadline) -> float:
        deadline.rest(max(0.0, self.due - tp.now()))
        self.due = max(self.due + 1.0 / RATE_HZ, tp.now())
        is_there, picture = self.video.read()
        if not is_there:
            # The end: from the beginning again.
            self.video.release()
            self.video = self.opened()
            is_there, picture = self.video.read()
        if not is_there:
            raise EOFError(f"{self.file}: no picture in it")
        # OpenCV has blue first.
        into[:] = picture[:, :, ::-1]
        return tp.now()

    def close(self) -> None:
        self.video.release()


plugin = tp.Plugin("org.example.opencv-camera", "1.0.0", {"video": Video}, needs=["read:{file}"])
