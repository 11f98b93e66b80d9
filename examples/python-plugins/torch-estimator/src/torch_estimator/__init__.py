"""The plugin `org.example.torch-estimator`: a small convolutional network of PyTorch, fitted by Adam with a fixed seed."""

from __future__ import annotations

import os
import tempfile
from typing import Annotated

# Torch creates a folder for compiled code, but a plugin cannot create folders: use an existing one.
os.environ.setdefault("TORCHINDUCTOR_CACHE_DIR", tempfile.gettempdir())

import numpy as np
import torch

import taceva.plugin as tp

FILTERS = 8
HIDDEN = 32
# Cells of the pooled grid, per side: positions stay distinguishable.
GRID = 4

# One thread: sums have one order, so the same samples give the same network and the same predictions.
torch.set_num_threads(1)


class Network(tp.Estimator):
    """A convolution and two layers of PyTorch."""

    def __init__(
        self,
        epochs: Annotated[int, tp.Arg(range=(1, 10_000), help="passes over the training samples")] = 200,
        seed: Annotated[int, tp.Arg(range=(0, 1_000_000))] = 0,
    ) -> None:
        self.epochs = epochs
        self.seed = seed
        self.net: torch.nn.Sequential | None = None
        # Mean and standard deviation of the labels, in the order of the channels.
        self.mean = self.spread = np.zeros(0)

    @staticmethod
    def made(depth: int, outputs: int) -> torch.nn.Sequential:
        # A plugin's process computes convolutions without oneDNN, which generates code at run time.
        return torch.nn.Sequential(
            torch.nn.Conv2d(depth, FILTERS, kernel_size=5, stride=2, padding=2),
            torch.nn.Tanh(),
            torch.nn.AdaptiveAvgPool2d(GRID),
            torch.nn.Flatten(),
            torch.nn.Linear(FILTERS * GRID * GRID, HIDDEN),
            torch.nn.Tanh(),
            torch.nn.Linear(HIDDEN, outputs),
        )

    @staticmethod
    def pictures(features) -> torch.Tensor:
        # Torch needs the depth first, and a writable copy.
        return torch.from_numpy(np.asarray(features, np.float32).transpose(0, 3, 1, 2).copy())

    def fit(self, training: tp.Samples, validation: tp.Samples | None, progress: tp.Training) -> None:
        torch.manual_seed(self.seed)
        x = self.pictures(training.features)
        self.mean = training.targets.mean(axis=0)
        self.spread = np.where(training.targets.std(axis=0) > 0, training.targets.std(axis=0), 1.0)
        y = torch.from_numpy(((training.targets - self.mean) / self.spread).astype(np.float32))
        self.net = self.made(x.shape[1], y.shape[1])
        optimizer = torch.optim.Adam(self.net.parameters(), lr=0.01)
        progress.begin("fit", self.epochs)
        for _ in range(self.epochs):
            optimizer.zero_grad()
            torch.nn.functional.mse_loss(self.net(x), y).backward()
            optimizer.step()
            progress.advance()
        progress.end()

    def predict(self, features) -> np.ndarray:
        rows = np.zeros((len(features), len(self.mean)))
        with torch.inference_mode():
            # Sample by sample: the order of sums may depend on the batch size.
            for row, sample in zip(rows, self.pictures(features), strict=True):
                row[:] = self.net(sample[None]).numpy()[0]
        return rows * self.spread + self.mean

    def save(self) -> bytes:
        parts = [self.mean, self.spread, *(weights.detach().numpy() for weights in self.net.parameters())]
        return b"".join(np.ascontiguousarray(part, "<f8").tobytes() for part in parts)

    @classmethod
    def load(cls, data: bytes, channels: list[str], shape: tuple[int, int, int]) -> Network:
        model = cls()
        net = cls.made(shape[2], len(channels))
        sizes = [len(channels), len(channels), *(weights.numel() for weights in net.parameters())]
        if len(data) != 8 * sum(sizes):
            raise ValueError(f"{len(data)} bytes, expected {8 * sum(sizes)} for {shape} and {channels}")
        numbers = np.frombuffer(data, "<f8")
        if not np.isfinite(numbers).all():
            raise ValueError("a weight is not finite")
        model.mean, model.spread, *parts = np.split(numbers, np.cumsum(sizes)[:-1])
        with torch.no_grad():
            for weights, part in zip(net.parameters(), parts, strict=True):
                weights.copy_(torch.from_numpy(part.astype(np.float32)).reshape(weights.shape))
        model.net = net
        return model


plugin = tp.Plugin("org.example.torch-estimator", "1.0.0", {"network": Network})
