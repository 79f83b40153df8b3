"""A fixed workload, whose time says how fast the processor is tonight.

It depends on nothing of this project, so that no change of ours is normalised away: on every core
that we may use, a process multiplies and adds vectors that fit the second-level cache, gathers from
a table that does not, and keeps a heap, as rasterising, texturing and traversing do. What it cannot
follow: a GPU, and Mesa (its version is in the machine's key). Its times compare only with those of
the same workload and numpy, which its name has.
"""

import heapq
import multiprocessing
import os
import signal
import time

import numpy as np

from sweeping import child

WORKLOAD = f"numpy-1/{np.__version__}"
NONE = "none"
VECTOR = 16384  # float32: three of them are 192 KiB
TABLE = 4 << 20  # float32: 16 MiB
VECTOR_ROUNDS, GATHER_ROUNDS, HEAP_STEPS = 12000, 60, 120000


def measure():
    """Seconds that the workload takes on all cores at once, from the moment that all are ready."""
    context = multiprocessing.get_context("fork")
    count = len(os.sched_getaffinity(0))
    barrier = context.Barrier(count + 1)
    workers = [context.Process(target=_work, args=(barrier,), daemon=True) for _ in range(count)]
    for worker in workers:
        worker.start()
    barrier.wait()
    begun = time.monotonic()
    for worker in workers:
        worker.join()
    return time.monotonic() - begun


def _work(barrier):
    child.die_with_parent(signal.SIGKILL)
    rng = np.random.default_rng(1)
    a, b = (rng.random(VECTOR, dtype=np.float32) for _ in range(2))
    c = np.empty_like(a)
    table = rng.random(TABLE, dtype=np.float32)
    places = rng.integers(0, TABLE, 1 << 16)
    barrier.wait()
    for _ in range(VECTOR_ROUNDS):
        np.multiply(a, b, out=c)
        np.add(c, b, out=c)
    for _ in range(GATHER_ROUNDS):
        table.take(places)
    heap, state = [], 1
    for _ in range(HEAP_STEPS):
        state = state * 1103515245 + 12345 & 0x7FFFFFFF
        heapq.heappush(heap, state)
        if len(heap) > 200:
            heapq.heappop(heap)
