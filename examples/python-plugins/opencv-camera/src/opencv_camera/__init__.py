"""Cameras of OpenCV: a video file that is played over and over, and a camera on the network that sends one JPEG after the other.

With an index instead of a file, `cv2.VideoCapture` is a camera of this machine.
"""

from __future__ import annotations

import socket
from pathlib import Path
from typing import Annotated

import cv2
import numpy as np

import taceva.plugin as tp

WIDTH, HEIGHT, RATE_HZ = 320, 240, 30.0
# With what a JPEG begins and ends; nothing within it looks so.
BEGIN, END = b"\xff\xd8", b"\xff\xd9"
JPEG_MAX = 8_000_000


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


class Stream(tp.Sensor, source="real", frame=(WIDTH, HEIGHT, "rgb8"), rate_hz=RATE_HZ):
    """A camera on the network that sends JPEG, brought to 320×240 pixels."""

    def __init__(
        self,
        host: Annotated[str, tp.Arg(help="its address")],
        port: Annotated[int, tp.Arg(range=(1, 65_535))] = 8080,
        path: Annotated[str, tp.Arg(help="of the stream on it")] = "/stream.mjpeg",
    ) -> None:
        self.connection = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        self.connection.settimeout(5.0)
        self.connection.connect((host, port))
        self.connection.sendall(f"GET {path} HTTP/1.0\r\nHost: {host}\r\n\r\n".encode())
        self.connection.setblocking(False)
        self.received = bytearray()

    def receive(self) -> bool:
        """Take what has come; whether anything had."""
        try:
            received = self.connection.recv(1 << 16)
        except BlockingIOError:
            return False
        if not received:
            raise ConnectionError("the camera has closed its stream")
        self.received += received
        return True

    def newest(self) -> bytes | None:
        """The last whole picture of what was received, which is forgotten with all before it."""
        end = self.received.rfind(END)
        begin = self.received.rfind(BEGIN, 0, max(end, 0))
        if begin < 0:
            if len(self.received) > JPEG_MAX:
                raise tp.Failure("protocol", f"{JPEG_MAX} bytes without a whole JPEG, expected a stream of them")
            return None
        picture = bytes(self.received[begin : end + len(END)])
        del self.received[: end + len(END)]
        return picture

    def capture(self, into, deadline: tp.Deadline) -> float:
        # What waited while nobody asked is old.
        while self.receive():
            self.newest()
        while (jpeg := self.newest()) is None:
            if not self.receive():
                deadline.rest(0.001)
        taken = tp.now()
        picture = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
        if picture is None:
            raise tp.Failure("protocol", "a picture that OpenCV does not read")
        # OpenCV has blue first.
        into[:] = cv2.resize(picture, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)[:, :, ::-1]
        return taken

    def close(self) -> None:
        self.connection.close()


plugin = tp.Plugin(
    "org.example.opencv-camera",
    "1.0.0",
    {"video": Video, "stream": Stream},
    needs=["read:{file}", "tcp:{host}:{port}"],
)
