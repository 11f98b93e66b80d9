"""Metrics, recordings and results in other processes: sent, forked, and merged to the same bytes on a cluster."""

from __future__ import annotations

import importlib.util
import multiprocessing
import os
import pickle
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taceva

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
ROWS = 4_000


def shard(seed: int) -> taceva.TactileMetrics:
    """Sums of one part of the samples of `whole`."""
    generator = np.random.default_rng(seed)
    truth = generator.normal(size=(ROWS, 6))
    metrics = taceva.TactileMetrics()
    metrics.update(truth, truth + 0.1 * generator.normal(size=truth.shape), generator.integers(0, 40, ROWS))
    return metrics


def whole(shards: int) -> str:
    metrics = taceva.TactileMetrics()
    for seed in range(shards):
        metrics.merge(shard(seed))
    return metrics.compute().text


def evaluated(path: str) -> str:
    """Result of a model that needs threads for its frames and its fit."""
    return taceva.evaluate(path, "ridge", split="random 60/0/40", settings={"size": "8x6"}, jobs=2).text


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> str:
    generator = np.random.default_rng(6)
    labels = generator.uniform(size=(60, 2))
    frames = (generator.integers(0, 40, size=(60, 12, 16)) + 200 * labels[:, 1, None, None]).astype(np.uint8)
    path = tmp_path_factory.mktemp("drawn") / "recording"
    taceva.from_arrays(path, labels, frames, sensor="drawn gel", source="synthetic", channels=["Pz", "Fz"])
    return os.fspath(path)


@pytest.mark.parametrize("way", ["fork", "spawn", "forkserver"])
def test_sums_of_other_processes_merge_to_the_same_bytes(way: str) -> None:
    expected = whole(3)
    with multiprocessing.get_context(way).Pool(2) as pool:
        parts = pool.map_async(shard, range(3)).get(timeout=240)
    merged = taceva.TactileMetrics()
    for part in reversed(parts):
        merged.merge(part)
    assert merged.compute().text == expected


def test_a_process_forked_after_threads_were_at_work_reads_and_fits_as_its_parent(drawn: str) -> None:
    # Threads of the parent do not exist in the child, so waiting for one would never end.
    expected = evaluated(drawn)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(evaluated, [drawn, drawn]).get(timeout=240) == [expected, expected]
    assert evaluated(drawn) == expected


def test_a_recording_opened_before_a_fork_is_read_in_the_child(drawn: str) -> None:
    dataset = taceva.open(drawn)
    expected = dataset.frames()
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.write(write, b"equal" if np.array_equal(dataset.frames(jobs=2), expected) else b"other")
        finally:
            os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as heard:
        assert heard.read() == b"equal"
    os.waitpid(child, 0)


def test_what_travels_arrives_equal(drawn: str) -> None:
    result = taceva.evaluate(drawn, "ridge", split="random 60/0/40", settings={"size": "8x6"})
    assert pickle.loads(pickle.dumps(result)) == result
    assert pickle.loads(pickle.dumps(taceva.compare(result, result))).to_dict() == taceva.compare(result, result).to_dict()
    rows = taceva.open(drawn).split("random 60/0/40")
    arrived = pickle.loads(pickle.dumps(rows))
    assert np.array_equal(arrived.test, rows.test) and arrived.split == rows.split


def of_another_version(sent: Any) -> bytes:
    """Pickle of an object as if its package had version 99."""

    class Sent:
        def __reduce__(self) -> Any:
            make, (_, *others) = sent.__reduce__()
            return make, (99, *others)

    return pickle.dumps(Sent())


def test_a_pickle_of_another_version_is_refused_in_words(drawn: str) -> None:
    result = taceva.evaluate(drawn, "ridge", split="random 60/0/40", settings={"size": "8x6"})
    for sent in (result, taceva.open(drawn)):
        with pytest.raises(ValueError, match="a pickle of version 99, this taceva reads version 4: use the same taceva on both sides"):
            pickle.loads(of_another_version(sent))
    metrics = shard(0)
    state = {**metrics.__getstate__(), "version": 99}
    with pytest.raises(ValueError, match="a pickle of version 99"):
        taceva.TactileMetrics.__new__(taceva.TactileMetrics).__setstate__(state)
    with pytest.raises(ValueError, match="a pickle of version None"):
        taceva.TactileMetrics.__new__(taceva.TactileMetrics).__setstate__({"asked": metrics._asked})


def test_states_of_other_metrics_or_none_are_refused_and_nothing_is_taken_over() -> None:
    metrics = taceva.TactileMetrics(["Fz"])
    for states in (b"", b"[", b"{}", b'[{"family": "unknown"}]', shard(0).states()):
        with pytest.raises(ValueError):
            metrics.merge_states(states)
    assert metrics.compute()["mae", "Fz"].n == 0


def test_states_with_any_changed_byte_are_refused() -> None:
    states, metrics = shard(0).states(), taceva.TactileMetrics()
    for at in (*range(100), *range(100, len(states), max(1, len(states) // 300))):
        changed = bytearray(states)
        changed[at] ^= 1 << at % 8
        with pytest.raises(ValueError, match="states"):
            metrics.merge_states(bytes(changed))
    state = metrics.__getstate__()
    state["states"] = state["states"][:-1] + b" "
    with pytest.raises(ValueError, match="changed after states"):
        metrics.__setstate__(state)
    metrics = taceva.TactileMetrics()
    metrics.merge_states(states)
    assert metrics.compute() == shard(0).compute()


def test_a_cluster_of_ray_on_two_nodes_merges_to_the_same_bytes() -> None:
    pytest.importorskip("ray")
    spec = importlib.util.find_spec("ray.cluster_utils")
    assert spec is not None
    program = textwrap.dedent(
        f"""
        import runpy, sys
        import numpy as np, ray, taceva
        from ray.cluster_utils import Cluster

        cluster = Cluster(initialize_head=True, head_node_args={{"num_cpus": 1, "include_dashboard": False, "object_store_memory": 100_000_000}})
        cluster.add_node(num_cpus=1, object_store_memory=100_000_000)
        cluster.wait_for_nodes(timeout=200)
        ray.init(address=cluster.address, log_to_driver=False)
        assert len([node for node in ray.nodes() if node["Alive"]]) == 2

        @ray.remote(num_cpus=1)
        def node():
            import time
            time.sleep(3)
            return ray.get_runtime_context().get_node_id()

        assert len(set(ray.get([node.remote(), node.remote()]))) == 2
        example = runpy.run_path({os.fspath(EXAMPLES / "ray_metrics.py")!r})
        merged = example["merged"](6)
        whole = taceva.TactileMetrics()
        for shard in range(6):
            whole.merge(example["predicted"]._function(shard))
        assert merged.text == whole.compute().text
        print("equal", merged["mae", "Fz"].n)
        ray.shutdown()
        cluster.shutdown()
        """
    )
    environment = {**os.environ, "RAY_DISABLE_IMPORT_WARNING": "1", "RAY_USAGE_STATS_ENABLED": "0", "RAY_ENABLE_UV_RUN_RUNTIME_ENV": "0"}
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=580, check=False, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "equal 30000" in done.stdout
