"""What PyTorch makes of the same weights and pictures: the golden numbers of taceva-network's tests.

usage: python3 benches/peers/torch_golden.py > crates/network/tests/golden/torch.json

Weights and pictures are draws of a counter (SplitMix64), so that both sides make them anew and the file stays small. Losses are
those of double precision, beside how far PyTorch's own single precision strays from them.
"""
import json
import math
import sys

from common import need

need("torch", "numpy")

import numpy as np  # noqa: E402
import torch  # noqa: E402
from torch import nn  # noqa: E402
from torch_resnet import resnet10, resnet18, resnet34  # noqa: E402

STEP = np.uint64(0x9E3779B97F4A7C15)


def units(seed, count):
    """`count` even draws in 0..1: number n is SplitMix64's at step n + 1."""
    with np.errstate(over="ignore"):
        state = np.uint64(seed) + (np.arange(count, dtype=np.uint64) + np.uint64(1)) * STEP
        state = (state ^ (state >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        state = (state ^ (state >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        state ^= state >> np.uint64(31)
    return (state >> np.uint64(11)).astype(np.float64) * 2.0**-53


def single(values):
    """Rounded to single precision, as both sides begin."""
    return values.astype(np.float32).astype(np.float64)


def fill(model, seed):
    """Sets every tensor, by sorted name, from draws of its own."""
    names = sorted(name for name in model.state_dict() if not name.endswith("num_batches_tracked"))
    tensors = model.state_dict()
    for position, name in enumerate(names):
        tensor = tensors[name]
        u = units(seed + position, tensor.numel())
        if tensor.dim() == 4:
            fan = tensor.shape[0] * tensor.shape[2] * tensor.shape[3]
            values = (2 * u - 1) * math.sqrt(6 / fan)
        elif tensor.dim() == 2:
            values = (2 * u - 1) / math.sqrt(tensor.shape[1])
        elif name.endswith(("running_var",)) or (name.endswith("weight")):
            values = 0.75 + 0.5 * u
        else:
            values = 0.2 * (u - 0.5)
        tensor.copy_(torch.from_numpy(single(values)).reshape(tensor.shape))
    return model


def pictures(seed, count, height, width, channels):
    """`[count, height, width, channels]` on both sides; PyTorch has the channels before the rows."""
    values = single(units(seed, count * height * width * channels)).reshape(count, height, width, channels)
    return torch.from_numpy(values).permute(0, 3, 1, 2).contiguous()


def labels(seed, count, outputs):
    return torch.from_numpy(units(seed, count * outputs).reshape(count, outputs))


class Flat(nn.Module):
    """The five-layer network; features are flattened as [rows, columns, channels]."""

    def __init__(self, outputs, height, width, channels):
        super().__init__()
        layers, inputs = [], channels
        for width_, kernel in [(16, 5), (32, 3), (48, 3), (64, 3), (96, 3)]:
            convolution = nn.Conv2d(inputs, width_, kernel, 2, kernel // 2, bias=False)
            layers.append(nn.Sequential(convolution, nn.BatchNorm2d(width_), nn.ReLU()))
            inputs, height, width = width_, (height - 1) // 2 + 1, (width - 1) // 2 + 1
        self.features = nn.Sequential(*layers)
        self.fc = nn.Linear(inputs * height * width, outputs)

    def forward(self, x):
        return self.fc(self.features(x).permute(0, 2, 3, 1).flatten(1))


def outputs_of(make, seed):
    """What a network in evaluation gives for two pictures."""
    model = fill(make(), seed).double().eval()
    with torch.no_grad():
        return model(pictures(seed + 1000, 2, 45, 38, 3)).flatten().tolist()


def gradients_of(make, loss, seed, classes=None):
    """The loss of a batch in training, and each gradient's norm and its product with draws."""
    model = fill(make(), seed).double().train()
    truth = labels(seed + 2000, 4, 6) if classes is None else torch.tensor(classes)
    value = loss(model(pictures(seed + 1000, 4, 45, 38, 3)), truth)
    value.backward()
    digests = {}
    for position, (name, parameter) in enumerate(sorted(model.named_parameters())):
        gradient = parameter.grad.flatten()
        draws = torch.from_numpy(units(seed + 3000 + position, gradient.numel())) - 0.5
        digests[name] = [gradient.norm().item(), (gradient @ draws).item()]
    return {"loss": value.item(), "gradients": digests}


def losses_of(make, loss, optimizer, seed, steps, side, kind):
    """The losses of `steps` steps on one batch of eight: whichever order its samples have, they are the same."""
    model = fill(make(), seed).to(kind).train()
    optimizer = optimizer(model.parameters())
    seen, truth = pictures(seed + 1000, 8, side, side, 3).to(kind), labels(seed + 2000, 8, 6).to(kind)
    losses = []
    for _ in range(steps):
        optimizer.zero_grad()
        value = loss(model(seen), truth)
        value.backward()
        optimizer.step()
        losses.append(value.item())
    return losses


def training(make, loss, optimizer, seed, steps, side):
    exact = losses_of(make, loss, optimizer, seed, steps, side, torch.float64)
    rounded = losses_of(make, loss, optimizer, seed, steps, side, torch.float32)
    strays = [abs(a - b) / exact[0] for a, b in zip(rounded, exact)]
    print(f"single precision strays by {max(strays):.1e}, at the end {strays[-1]:.1e}; losses {exact[0]:.4f} to {exact[-1]:.6f}", file=sys.stderr)
    return {"losses": exact, "stray": max(strays)}


def main():
    torch.set_num_threads(1)
    squared, huber = nn.MSELoss(), nn.HuberLoss()
    flat = lambda: Flat(6, 45, 38, 3)  # noqa: E731
    golden = {
        "outputs": {
            "resnet10": outputs_of(lambda: resnet10(6), 1),
            "resnet18": outputs_of(lambda: resnet18(6), 2),
            "resnet34": outputs_of(lambda: resnet34(6), 3),
            "plain": outputs_of(flat, 4),
        },
        "gradients": {
            "resnet18": gradients_of(lambda: resnet18(6), squared, 10_000),
            "resnet34": gradients_of(lambda: resnet34(6), huber, 20_000),
            "resnet10": gradients_of(lambda: resnet10(6), nn.CrossEntropyLoss(), 30_000, [0, 5, 3, 3]),
            "plain": gradients_of(flat, squared, 40_000),
        },
        "training": {
            "resnet18": training(
                lambda: resnet18(6), squared, lambda p: torch.optim.SGD(p, 3e-4, 0.9, weight_decay=1e-4), 50_000, 200, 48
            ),
            "plain": training(
                lambda: Flat(6, 48, 48, 3), huber, lambda p: torch.optim.AdamW(p, 3e-4, weight_decay=1e-2), 60_000, 200, 48
            ),
        },
    }
    json.dump(golden, sys.stdout, indent=1)
    print()


main()
