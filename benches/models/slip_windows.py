"""Training of the slip model here and in PyTorch: `cnn` on windows of five frames, two classes, one thread, both in turn.

usage: python3 benches/models/slip_windows.py [ROUNDS [STEPS]] [--anyway]

The network is that of `taceva fit --task slip --model cnn --window 5`: pictures of 96 x 128 with nine channels (five grey frames and the four
changes between them), five convolutions of stride 2 with batch normalisation, one linear layer, cross entropy, AdamW, batches of 32. Both sides
state their number of parameters, which must agree. PyTorch runs with and without channels_last, and the faster one counts. Each of ROUNDS (5)
takes the best of STEPS (20) training steps of each side, pinned to the same processor. Without `--anyway` a busy machine prints no ratio.

It needs PyTorch (`pip install torch`) and cargo.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benches" / "peers"))
os.environ["OMP_NUM_THREADS"] = "1"

from machine import Machine  # noqa: E402

try:
    import torch
    from torch import nn
except ImportError:
    sys.exit("skipped: python3 has no torch (pip install torch)")

BATCH, PLANES, ROWS, COLUMNS, CLASSES = 32, 9, 96, 128, 2
LAYERS = [(16, 5), (32, 3), (48, 3), (64, 3), (96, 3)]
LEAST = 1.5


def ours():
    """The program that measures training steps here."""
    if shutil.which("cargo") is None:
        sys.exit("skipped: no cargo, which builds the training steps of taceva-network")
    command = ["cargo", "bench", "-p", "taceva-network", "--bench", "network", "--no-run", "--message-format=json"]
    built = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    for message in map(json.loads, built.splitlines()):
        if message.get("executable") and message["target"]["name"] == "network":
            return message["executable"]
    sys.exit("cargo names no program for the bench `network`")


def measured_here(program, steps):
    """Number of parameters, and images per second of the processor and of the clock."""
    printed = subprocess.run([program, "slip", str(steps)], check=True, stdout=subprocess.PIPE, text=True).stdout
    found = re.search(r"slip windows (\d+) parameters +([\d.]+) images per processor second +([\d.]+) images/s", printed)
    if not found:
        sys.exit(f"{program} slip printed no training steps: {printed}")
    return int(found[1]), float(found[2]), float(found[3])


def network():
    layers, inputs = [], PLANES
    for outputs, kernel in LAYERS:
        layers += [nn.Conv2d(inputs, outputs, kernel, 2, kernel // 2, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True)]
        inputs = outputs
    pixels = (ROWS >> len(LAYERS)) * (COLUMNS >> len(LAYERS))
    return nn.Sequential(*layers, nn.Flatten(), nn.Linear(inputs * pixels, CLASSES))


class Training:
    """Training of the network in PyTorch, with pictures in one order of memory."""

    def __init__(self, order):
        torch.manual_seed(1)
        self.model = network().to(memory_format=order)
        self.pictures = torch.rand(BATCH, PLANES, ROWS, COLUMNS).to(memory_format=order)
        self.labels = torch.arange(BATCH) % CLASSES
        self.optimizer = torch.optim.AdamW(self.model.parameters(), lr=1e-3, weight_decay=0.1)

    def step(self):
        self.optimizer.zero_grad(set_to_none=True)
        nn.functional.cross_entropy(self.model(self.pictures), self.labels).backward()
        self.optimizer.step()

    def measured(self, steps):
        """Images per second of the processor and of the clock, best of `steps`, after one more step."""
        self.step()
        busy, wall = [], []
        for _ in range(steps):
            start_busy, start = time.process_time(), time.perf_counter()
            self.step()
            busy.append(time.process_time() - start_busy)
            wall.append(time.perf_counter() - start)
        return BATCH / min(busy), BATCH / min(wall)


def main():
    rounds, steps = (int(word) for word in (sys.argv[1:] + ["5", "20"][len(sys.argv) - 1:]))
    program = ours()
    torch.set_num_threads(1)
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    sides = [Training(torch.contiguous_format), Training(torch.channels_last)]
    machine, rows = Machine(), []
    for _ in range(rounds):
        there = [side.measured(steps) for side in sides]
        parameters, *here = measured_here(program, steps)
        theirs = sum(weights.numel() for weights in sides[0].model.parameters())
        if parameters != theirs:
            sys.exit(f"the networks differ: {parameters} parameters here, {theirs} in PyTorch")
        rows.append([here, [max(both) for both in zip(*there)]])
    print(f"slip model, windows of 5 frames, {ROWS} x {COLUMNS}, {parameters} parameters, batches of {BATCH}, one thread, PyTorch {torch.__version__}")
    for at, unit in enumerate(["images per processor second", "images/s"]):
        here, there = (sorted(row[side][at] for row in rows) for side in (0, 1))
        shares = sorted((row[0][at] / row[1][at] for row in rows))
        middle = rounds // 2
        print(f"{unit:<28} here {here[middle]:8.1f}   PyTorch {there[middle]:8.1f}   here : PyTorch {machine.ratio(shares[middle], 1)} "
              f"({machine.ratio(shares[0], 1)} to {machine.ratio(shares[-1], 1)}), expected at least {LEAST}")
    print(machine.said())


main()
