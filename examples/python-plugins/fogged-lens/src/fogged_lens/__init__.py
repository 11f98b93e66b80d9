"""The plugin `org.example.fogged-lens-python`: a fault of pictures, which lose contrast. A fault is an estimator that is loaded, never fitted."""

from __future__ import annotations

import numpy as np

import taceva.plugin as tp

# First line of the bytes of a fault.
HEAD = "taceva.fault/1"
# Contrast that each severity takes.
LOST = 0.15


class Fog(tp.Estimator, title="fault: a fogged lens"):
    """A fogged lens of one severity, from 1 to 5."""

    def __init__(self) -> None:
        self.severity = 0
        self.data = b""

    def fit(self, training: tp.Samples, validation: tp.Samples | None, progress: tp.Training) -> None:
        raise ValueError("a fault is not fitted; name it by [[fault]] in a scene, or by --faults of `taceva stress`")

    def predict(self, features) -> np.ndarray:
        # A sample is a pixel, row by row from the top; a call has all pixels of one picture.
        numbers = np.asarray(features, np.float64).reshape(len(features), -1)
        mean = numbers.mean() if numbers.size else 0.0
        return mean + (1.0 - LOST * self.severity) * (numbers - mean)

    def save(self) -> bytes:
        return self.data

    @classmethod
    def load(cls, data: bytes, channels: list[str], shape: tuple[int, int, int]) -> Fog:
        head, *lines = data.decode().splitlines() or [""]
        # The other lines have seed, sample, width, height, full_scale and numbers.
        stated = dict(line.split("=", 1) for line in lines if "=" in line)
        if head != HEAD or stated.get("severity") not in {"1", "2", "3", "4", "5"}:
            raise ValueError("expected the lines of a fault with `severity` from 1 to 5")
        fog = cls()
        fog.severity = int(stated["severity"])
        fog.data = data
        return fog


plugin = tp.Plugin("org.example.fogged-lens-python", "1.0.0", {"fog": Fog})
