"""Training steps and inference of ResNet-18 in PyTorch (and inference in ONNX Runtime, where it is installed), for comparison
with `cargo bench -p taceva-network`.

usage: python3 benches/peers/torch_network.py [SIDE [THREADS [REPEATS]]] [--device DEVICE]

Batch 32, six outputs, mean squared error, SGD with momentum, channels_last, single precision. Printed are images per second of
processor time (of all threads) and of the wall clock, best of REPEATS, and how much memory training takes at most beyond what
the process has once PyTorch is loaded. On a machine with other work pin both sides to the same
processors (`taskset -c 0`) and run them in turn.

With `--device cuda` the same on a GPU, by the wall clock, and without ONNX Runtime, for comparison with the example `speed` of
taceva-network: pictures and labels go to the device in each step, as they do there, and the device has finished when time is taken.
"""
import sys
import time

from common import need

need("torch")

import torch  # noqa: E402

from torch_resnet import resnet18  # noqa: E402

BATCH = 32
WORDS = sys.argv[1:]
DEVICE = torch.device("cpu")
if "--device" in WORDS:
    place = WORDS.index("--device")
    DEVICE = torch.device(WORDS[place + 1])
    del WORDS[place:place + 2]


def best(repeats, work):
    """The least processor and wall seconds of `work`, after one warm-up."""
    if DEVICE.type == "cuda":
        on_host, wait = work, torch.cuda.synchronize

        def work():
            on_host()
            wait()

    work()
    busy, wall = [], []
    for _ in range(repeats):
        start_busy, start = time.process_time(), time.perf_counter()
        work()
        busy.append(time.process_time() - start_busy)
        wall.append(time.perf_counter() - start)
    return min(busy), min(wall)


def tell(name, side, seconds, images=BATCH):
    busy, wall = seconds
    print(f"{name:<36} {side}²  {images / busy:8.1f} images per processor second  {images / wall:8.1f} images/s")


def resident(key):
    """The number of `key` in the state of this process, in MiB."""
    with open("/proc/self/status") as state:
        return next(int(line.split()[1]) for line in state if line.startswith(key)) / 1024


def main():
    before = resident("VmRSS:")
    side, threads, repeats = (int(word) for word in (WORDS + ["64", "1", "10"][len(WORDS):]))
    torch.set_num_threads(threads)
    torch.manual_seed(1)
    model = resnet18(6).to(DEVICE, memory_format=torch.channels_last)
    pictures = torch.rand(BATCH, 3, side, side).to(memory_format=torch.channels_last)
    labels = torch.rand(BATCH, 6)
    optimizer = torch.optim.SGD(model.parameters(), lr=1e-3, momentum=0.9, weight_decay=1e-4)

    def step():
        optimizer.zero_grad(set_to_none=True)
        torch.nn.functional.mse_loss(model(pictures.to(DEVICE)), labels.to(DEVICE)).backward()
        optimizer.step()

    if DEVICE.type != "cpu":
        print(f"on {torch.cuda.get_device_name(DEVICE) if DEVICE.type == 'cuda' else DEVICE}")
    tell("PyTorch channels_last, training", side, best(repeats, step))
    print(f"memory of training at most beyond PyTorch {side}² {resident('VmHWM:') - before:9.1f} MiB")
    model.eval()
    with torch.no_grad():
        tell("PyTorch channels_last, inference", side, best(repeats, lambda: model(pictures.to(DEVICE)).cpu()))
        if DEVICE.type != "cpu":
            return
        frozen = torch.jit.optimize_for_inference(torch.jit.trace(model, pictures))
        frozen(pictures)
        tell("PyTorch frozen, inference", side, best(repeats, lambda: frozen(pictures)))
    onnx(model, pictures, side, threads, repeats)


def onnx(model, pictures, side, threads, repeats):
    """Inference in ONNX Runtime."""
    try:
        import io

        import onnxruntime

        file = io.BytesIO()
        torch.onnx.export(model, pictures.contiguous(), file, dynamo=False)
    except Exception as error:  # noqa: BLE001 - whichever part is missing, the others' numbers stand
        print(f"skipped ONNX Runtime: {error}")
        return
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    session = onnxruntime.InferenceSession(file.getvalue(), options, providers=["CPUExecutionProvider"])
    name = session.get_inputs()[0].name
    values = pictures.contiguous().numpy()
    tell("ONNX Runtime, inference", side, best(repeats, lambda: session.run(None, {name: values})))
    one = values[:1]
    file = io.BytesIO()
    torch.onnx.export(model, pictures[:1].contiguous(), file, dynamo=False)
    session = onnxruntime.InferenceSession(file.getvalue(), options, providers=["CPUExecutionProvider"])
    tell("ONNX Runtime, one picture", side, best(repeats, lambda: session.run(None, {name: one})), 1)


main()
