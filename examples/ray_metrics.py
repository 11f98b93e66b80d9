"""Scores of a test set that several machines predict: each sends back its sums, a few kB, and no sample travels.

    pip install PATH/TO/dist/taceva-*.whl ray   # the wheel that `.ci/wheel dist` builds in a clone: taceva is not on PyPI yet
    python examples/ray_metrics.py              # a cluster of this machine
    python examples/ray_metrics.py ADDRESS      # a cluster that is there, such as 10.0.0.1:6379

The rows are divided among the workers in whatever order they are free. Sums are exact, so the merged scores are those of one process, to the last bit.
Nothing here was measured: labels and predictions are drawn from a fixed seed.
"""

import sys

import numpy as np
import ray
import taceva


@ray.remote
def predicted(shard: int) -> taceva.TactileMetrics:
    """Return the sums over one shard; a real one would open its recording and call its model."""
    generator = np.random.default_rng(shard)
    truth = generator.normal(size=(5_000, 6))  # Px Py Pz in mm, Fx Fy Fz in N
    metrics = taceva.TactileMetrics()
    metrics.update(truth, truth + 0.1 * generator.normal(size=truth.shape), points=generator.integers(0, 50, 5_000))
    return metrics


def merged(shards: int = 16) -> taceva.Result:
    """Return the scores over all shards, merged as they come."""
    whole, waiting = taceva.TactileMetrics(), [predicted.options(scheduling_strategy="SPREAD").remote(shard) for shard in range(shards)]
    while waiting:
        (ready, *_), waiting = ray.wait(waiting)
        whole.merge(ray.get(ready))
    return whole.compute()


if __name__ == "__main__":
    ray.init(address=sys.argv[1] if len(sys.argv) > 1 else None)
    print(merged())
