"""The process at hand: the threads of its libraries, and its peak memory."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import math
import os
import sys
from collections.abc import Iterator
from pathlib import Path

#: Read by BLAS, OpenMP and numba when they are loaded; a run's last bits must not depend on them.
ONE_THREAD = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "VECLIB_MAXIMUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
}


@contextlib.contextmanager
def one_thread_environment() -> Iterator[None]:
    """Processes that are started meanwhile compute with one thread."""
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(ONE_THREAD)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def collect_garbage() -> None:
    """Free what earlier work left, quickly: what survives is never looked at again.

    For processes of ours only, because it holds for all objects that there are.
    """
    gc.collect()
    gc.freeze()  # modules and what they keep are most of it: 0.1 s a time


def machine_memory() -> float:
    """Memory of the machine [bytes], or what a control group allows of it; inf where unknown."""
    try:
        most = float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, OSError, ValueError):
        return math.inf
    for file in ("memory.max", "memory/memory.limit_in_bytes"):
        with contextlib.suppress(OSError, ValueError):
            most = min(most, float(Path("/sys/fs/cgroup", file).read_text("ascii")))
    return most


def forget_peak_memory() -> None:
    """From now on `peak_memory_mb` tells the peak of what comes; only Linux can do that."""
    with contextlib.suppress(OSError, AttributeError):  # memory that was freed, back to the system
        ctypes.CDLL(None).malloc_trim(0)
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5", "ascii")  # proc(5): resets VmHWM


def peak_memory_mb() -> float | None:
    """Peak resident memory of this process, in MB (1e6 bytes); None where unknown.

    On Linux since `forget_peak_memory`, elsewhere since the process started. ``getrusage`` also
    counts what the process that started this one had in memory at that moment.
    """
    try:
        status = Path("/proc/self/status").read_text("utf-8")
        return int(status.split("VmHWM:")[1].split()[0]) * 1024 / 1e6
    except (OSError, IndexError, ValueError):
        pass
    try:
        import resource
    except ImportError:  # not a POSIX system
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return float(peak * (1 if sys.platform == "darwin" else 1024) / 1e6)
