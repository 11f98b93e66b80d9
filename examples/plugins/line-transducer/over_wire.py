"""The line transducer over the simulated gel of `taceva-wire --force netft`: asks its Net F/T for readings, and writes each as a line to
whoever connects. Arguments: the ports `port` and `page_port` of the rig file that `taceva-wire` wrote, and the port to listen on."""

import re
import socket
import struct
import sys
import threading
import urllib.request

udp_port, page_port, port = (int(word) for word in sys.argv[1:4])
page = urllib.request.urlopen(f"http://127.0.0.1:{page_port}/netftapi2.xml").read().decode()
per_newton = float(re.search(r"<cfgcpf>([^<]+)", page).group(1))
per_newton_metre = float(re.search(r"<cfgcpt>([^<]+)", page).group(1))
source = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
source.connect(("127.0.0.1", udp_port))
source.send(struct.pack(">HHI", 0x1234, 2, 0))  # readings without end
clients, lock = [], threading.Lock()


def accept():
    server = socket.create_server(("127.0.0.1", port))
    while True:
        client, _ = server.accept()
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        with lock:
            clients.append(client)


threading.Thread(target=accept, daemon=True).start()
while True:
    reading = struct.unpack(">III6i", source.recv(64))
    wrench = [count / per_newton for count in reading[3:6]] + [count / per_newton_metre for count in reading[6:]]
    line = ";".join([str(reading[0])] + [f"{value:.6f}" for value in wrench]) + "\n"
    with lock:
        for client in list(clients):
            try:
                client.send(line.encode(), socket.MSG_DONTWAIT)
            except OSError:
                clients.remove(client)
