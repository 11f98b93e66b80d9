"""Sensors, robots, force transducers, lightings, changers and estimators written in Python, as plugins of TacEva.

A plugin is a package whose module has a ``plugin``:

>>> import taceva.plugin as tp
>>> class Scale(tp.Force, source="real", axes=["Fz"], rate_hz=10):
...     "A scale that weighs nothing."
...     def read(self, deadline):
...         return tp.Reading(0.0, tp.now())
>>> plugin = tp.Plugin("org.example.scale", "1.0.0", {"scale": Scale})
>>> print(plugin.tables()[0][0], end="")
kind = "force"
key = "scale"
title = "A scale that weighs nothing."
source = "real"
axes = ["Fz"]
rate_hz = 10

``python -m taceva.plugin manifest MODULE --write`` writes the manifest of the plugin beside ``__init__.py``. A plugin runs in its own process,
with access only to those needs of the manifest that the user allows.
"""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, NamedTuple

from taceva._taceva import Deadline, Interrupted, Training, plugin_log
from taceva.plugin_classes import Arg, Changer, Device, Estimator, Force, Lighting, Robot, Samples, Sensor
from taceva.plugin_table import table

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = [
    "Arg",
    "Changer",
    "Deadline",
    "Device",
    "Estimator",
    "Failure",
    "Force",
    "Interrupted",
    "Lighting",
    "Plugin",
    "Pose",
    "Reading",
    "Robot",
    "Samples",
    "Sensor",
    "Training",
    "load",
    "log",
    "now",
]


_FAULTS = ("emergency stop", "collision", "boundary", "servo fault")


class Failure(Exception):
    """Failure of a device, for error kinds without a Python exception.

    Parameters
    ----------
    kind : str
        Error kind, such as ``"not found"``, ``"busy"``, ``"disconnected"``, ``"out of range"`` or ``"device fault"``.
    message : str
        Failure and remedy.
    fault : str, optional
        Reason why a robot stopped itself; nothing moves until an operator has checked it: ``"emergency stop"``, ``"collision"``, ``"boundary"`` or
        ``"servo fault"``.
    """

    def __init__(self, kind: str, message: str, fault: str | None = None) -> None:
        super().__init__(message)
        if fault is not None and fault not in _FAULTS:
            raise ValueError(f"fault {fault!r}: expected one of {', '.join(map(repr, _FAULTS))}")
        self.kind = kind
        self.fault = fault


class Pose(NamedTuple):
    """Position of the tip in the frame of the sensor, in mm, z into the gel, and its rotation about x, then y, then z, in degrees."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    rx: float = 0.0
    ry: float = 0.0
    rz: float = 0.0


class Reading(NamedTuple):
    """Reading of a force transducer.

    ``force`` is Fz, or ``[Fx, Fy, Fz]``, or ``[Fx, Fy, Fz, Tx, Ty, Tz]``, in N and N·mm. ``time`` is the time of the reading on the clock of `now`.
    ``number`` is the sequence number of the reading, if the device numbers its readings. ``lost`` is the number of readings that were lost between
    the device and the plugin since it was opened, if the device shows them.
    """

    force: float | Sequence[float]
    time: float | tuple[float, float]
    number: int | None = None
    lost: int | None = None


def now() -> float:
    """Return the time for stamps of devices, in seconds of the monotonic clock of the machine."""
    return time.monotonic()


def log(message: str, level: str = "info") -> None:
    """Write a line to the log of the program; ``level`` is ``"error"``, ``"warn"``, ``"info"`` or ``"debug"``."""
    plugin_log(level, message)


class Plugin:
    """A plugin: its id, its version, and its devices and estimators by key.

    Parameters
    ----------
    id : str
        Id in reverse DNS notation, such as ``"org.example.eye"``.
    version : str
        Version of the plugin.
    provides : mapping of str to class
        Subclasses of `Sensor`, `Robot`, `Force`, `Lighting`, `Changer` and `Estimator`.
    needs : sequence of str
        Access outside its process, such as ``"camera"`` or ``"serial:{port}"``.
    """

    def __init__(
        self,
        id: str,
        version: str,
        provides: Mapping[str, type[Device | Estimator]],
        *,
        needs: Sequence[str] = (),
    ) -> None:
        for key, given in provides.items():
            if not (isinstance(given, type) and issubclass(given, (Device, Estimator))):
                raise TypeError(
                    f"{key!r}: expected a subclass of taceva.plugin.Sensor, Robot, Force, Lighting, Changer or Estimator, got {given!r}"
                )
            if issubclass(given, Robot) and given.halt is Robot.halt:
                raise TypeError(f"{key!r}: {given.__name__} has no halt(), expected a method that stops the motion from any thread")
        if isinstance(needs, str):
            raise TypeError(f"needs: expected a list of strings, got {needs!r}")
        self.id = id
        self.version = version
        self.provides = dict(provides)
        self.needs = list(needs)

    def tables(self) -> list[tuple[str, type[Device | Estimator]]]:
        """Return the manifest table of each class, and the class."""
        return [(table(key, given), given) for key, given in self.provides.items()]

    def __repr__(self) -> str:
        return f"<Plugin {self.id} {self.version}: {', '.join(self.provides)}>"


def load(name: str, folder: str | None = None) -> Plugin:
    """Import the package ``name``, from ``folder`` if given, and return its plugin."""
    import importlib
    import importlib.util
    import os

    if folder is None:
        module = importlib.import_module(name)
    else:
        path = os.path.join(folder, "__init__.py")
        spec = importlib.util.spec_from_file_location(name, path, submodule_search_locations=[folder])
        if spec is None or spec.loader is None:
            raise ImportError(f"{path} cannot be imported")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    plugin = getattr(module, "plugin", None)
    if not isinstance(plugin, Plugin):
        raise TypeError(
            f"the module {name} has no plugin, expected plugin = taceva.plugin.Plugin(id, version, {{key: class}})"
        )
    return plugin


if __name__ == "__main__":
    from taceva.plugin_command import main

    sys.exit(main())
