# OctoPrint's virtual printer with Marlin's dialect, behind a pseudo-terminal whose path is printed.
import os
import pty
import tempfile
import threading
import tty

from octoprint.plugin import plugin_manager
from octoprint.plugins import virtual_printer
from octoprint.plugins.virtual_printer.virtual import VirtualPrinter


class Settings:
    """The plugin's own defaults."""

    def __init__(self):
        self.defaults = virtual_printer.VirtualPrinterPlugin().get_settings_defaults()

    def get(self, path, **_):
        found = self.defaults
        for key in path:
            found = found[key]
        return found

    def get_int(self, path):
        return int(self.get(path))

    def get_float(self, path):
        return float(self.get(path))

    def get_boolean(self, path):
        return bool(self.get(path))

    def global_get_basefolder(self, _):
        return tempfile.gettempdir()


end, host = pty.openpty()
tty.setraw(host)
plugin_manager(init=True, plugin_folders=[], plugin_entry_points=[])
printer = VirtualPrinter(Settings(), None, tempfile.mkdtemp(), read_timeout=0.1)


def say():
    while True:
        said = printer.readline()
        if said:
            os.write(end, said.rstrip(b"\n") + b"\n")


threading.Thread(target=say, daemon=True).start()
print("= " + os.ttyname(host), flush=True)
heard = b""
while True:
    try:
        more = os.read(end, 1024)
    except OSError:
        break
    if not more:
        break
    heard += more
    # One line at a time: of two lines received at once, the printer executes the first and holds the second until more data arrives.
    while b"\n" in heard:
        line, heard = heard.split(b"\n", 1)
        line += b"\n"
        while line:
            line = line[printer.write(line) :]
