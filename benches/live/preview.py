#!/usr/bin/env python3
"""What a live preview with a model keeps up with.

Fits the preset `default` on pictures of an emulated camera of 640x480 at 30 Hz, lets `taceva preview --model` show the same camera to a browser
that only reads, and prints what both sides counted, with the load of the machine. Nothing but the standard library is needed.

    cargo build --release -p taceva-cli
    cargo build --release -p taceva-wire --example camera
    python3 benches/live/preview.py target/release/taceva target/release/examples/camera [SECONDS] [MODEL]
"""

import http.client
import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import time

RATE_HZ, WIDTH, HEIGHT = 30, 640, 480
# Pictures that the model is fitted on: four rounds of those that the camera shows in turn.
PICTURES = 240


def parts(stream):
    """The heads and bodies of a multipart stream."""
    while True:
        head = b""
        while not head.endswith(b"\r\n\r\n") or len(head.strip()) == 0:
            line = stream.readline()
            if not line:
                return
            head = (head + line).lstrip(b"\r\n")
        length = int(re.search(rb"content-length: (\d+)", head, re.I)[1])
        yield head.decode("latin-1"), stream.read(length)


def recording(folder, address):
    """A folder of pictures of the camera, each with the place of the dark disc, which moves evenly."""
    connection = http.client.HTTPConnection(address, timeout=20)
    connection.request("GET", "/")
    stream = connection.getresponse()
    os.mkdir(f"{folder}/lab")
    rows = []
    for number, (_, body) in enumerate(parts(stream)):
        if number == PICTURES:
            break
        with open(f"{folder}/lab/{number:04}.jpg", "wb") as file:
            file.write(body)
        rows.append(f"{number:04}.jpg,{number % 60 / 10:.2f},{number % 7 / 2:.2f},{number % 60}")
    connection.close()
    with open(f"{folder}/lab/labels.csv", "w", encoding="utf-8") as file:
        file.write("\n".join(["picture,Px,Fz,point_id", *rows]) + "\n")
    with open(f"{folder}/map.toml", "w", encoding="utf-8") as file:
        file.write(
            'map_version = 2\ntable = "labels.csv"\n[frame]\ncolumn = "picture"\nchannel_order = "rgb"\nreference = "0000.jpg"\n'
            '[columns]\nPx = { from = "Px", unit = "mm" }\nFz = { from = "Fz", unit = "N" }\n[ids]\npoint_id = "point_id"\n'
            '[time]\nclock = "unknown"\n[sensor]\nmodel = "emulated"\nserial = "unknown"\ngel = "unknown"\nopaque = "unknown"\n'
        )


class Browser(threading.Thread):
    """Reads pictures as a page does, and notes when each came."""

    def __init__(self, address, token):
        super().__init__(daemon=True)
        self.connection = http.client.HTTPConnection(address, timeout=20)
        self.connection.request("GET", "/frames", headers={"X-Taceva-Token": token})
        self.came = []

    def run(self):
        for head, _ in parts(self.connection.getresponse()):
            said = re.search(r"x-taceva-prediction: (.*)", head, re.I)
            if said:
                # Frames are stamped by the same clock.
                self.came.append(1000 * (time.clock_gettime(time.CLOCK_MONOTONIC) - json.loads(said[1])["t_s"]))


def main():
    taceva, camera = (os.path.abspath(path) for path in sys.argv[1:3])
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 30
    model = sys.argv[4] if len(sys.argv) > 4 else "default"
    with tempfile.TemporaryDirectory() as folder:
        server = subprocess.Popen(
            [camera, str(RATE_HZ), str(WIDTH), str(HEIGHT)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        try:
            selector = server.stdout.readline().split()[0]
            recording(folder, re.search(r"//([^/]+)/", selector)[1])
            run = lambda *words: subprocess.run([taceva, *words], cwd=folder, check=True)
            run("import", "lab", "--map", "map.toml", "--out", "data", "-q")
            epochs = ["--set", "epochs=1"] if model in ("fast", "default", "best") else []
            run("fit", "data", "--model", model, *epochs, "--split", "all", "--no-cache", "--out", "m.taceva", "-q")
            shown = subprocess.Popen(
                [taceva, "preview", "--sensor", selector, "--model", "m.taceva"],
                cwd=folder, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
            )
            url = re.search(r"http://(\S+)/#(\S+)", shown.stderr.readline())
            browser = Browser(url[1], url[2])
            browser.start()
            began = time.monotonic()
            time.sleep(seconds)
            load = os.getloadavg()[0]
            stop = http.client.HTTPConnection(url[1], timeout=20)
            stop.request("POST", "/stop", headers={"X-Taceva-Token": url[2], "Content-Length": "0"})
            stop.getresponse()
            lasted = time.monotonic() - began
            print(shown.communicate()[1], end="")
        finally:
            server.stdin.close()
            server.wait()
        came = sorted(browser.came)
        if not came:
            sys.exit("no picture came to the browser")
        soon = sum(late <= 100 for late in came) / len(came)
        print(
            f"{model}: {len(came) / lasted:.1f} pictures a second came to the browser, {100 * soon:.1f} % within 100 ms of their stamps, "
            f"95 % within {came[int(0.95 * (len(came) - 1))]:.0f} ms, half within {came[len(came) // 2]:.0f} ms; "
            f"{os.cpu_count()} cores, load {load:.1f}"
        )


if __name__ == "__main__":
    main()
