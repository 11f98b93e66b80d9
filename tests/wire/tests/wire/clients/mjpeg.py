"""A camera by a public server of streams, whose pictures change. Its port stands behind `= `."""
import socket
import sys
import threading
import time

import numpy
from mjpeg_streamer import MjpegServer, Stream

with socket.create_server(("127.0.0.1", 0)) as free:
    port = free.getsockname()[1]
picture = numpy.zeros((48, 64, 3), numpy.uint8)
stream = Stream("camera", size=(64, 48), quality=90, fps=30)
stream.set_frame(picture)
server = MjpegServer("127.0.0.1", port)
server.add_stream(stream)
server.start()


def change():
    level = 0
    while True:
        level = (level + 20) % 240
        stream.set_frame(numpy.full_like(picture, level))
        time.sleep(0.03)


threading.Thread(target=change, daemon=True).start()
for _ in range(200):
    try:
        socket.create_connection(("127.0.0.1", port)).close()
        break
    except OSError:
        time.sleep(0.05)
print("\n= " + str(port), flush=True)
# It ends with its input.
sys.stdin.read()
