"""Executors of the standard interface: worker processes that live on, or the process at hand.

A call may report on its way: what it gives to `report` arrives where the executor was told.
Any other `concurrent.futures.Executor` runs the same calls; there `report` goes nowhere.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextvars import ContextVar
from multiprocessing.connection import Connection
from types import ModuleType
from typing import Any

from contactstudy.process import collect_garbage, one_thread_environment

Receive = Callable[[Any], None]
_reports: ContextVar[Receive] = ContextVar("reports", default=lambda message: None)
_starting = threading.Lock()


def report(message: Any) -> None:
    """Send a picklable message to whoever made the executor that this call runs in."""
    _reports.get()(message)


@contextlib.contextmanager
def reports_to(receive: Receive) -> Iterator[None]:
    """Meanwhile `receive` is called with each `report`."""
    token = _reports.set(receive)
    try:
        yield
    finally:
        _reports.reset(token)


class WorkerDiedError(Exception):
    """A worker ended in the middle of a call; the message says how."""


class InThisProcess(Executor):
    """Calls run at once, in the process at hand; `receive` is called with each `report`."""

    def __init__(self, receive: Receive) -> None:
        self._receive = receive

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Call, and return a future that is done; Ctrl-C is not caught."""
        future = Future[Any]()
        with reports_to(self._receive):
            try:
                future.set_result(function(*args, **kwargs))
            except Exception as error:
                future.set_exception(error)
        return future


class Workers(Executor):
    """Fresh processes with one thread each, started when needed, that live until the shutdown.

    A worker that dies fails its own call only (`WorkerDiedError`) and is replaced. Workers never
    see Ctrl-C: it is this process that ends them.

    `receive` is called with each `report`, in another thread than the caller's.
    """

    def __init__(self, number: int, receive: Receive) -> None:
        # Each thread here waits for one process.
        self._threads = ThreadPoolExecutor(number)
        self._receive = receive
        self._lock = threading.Lock()
        self._idle: list[_Worker] = []
        self._busy: set[_Worker] = set()
        self._closed = False

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Call in the next free worker; everything must be picklable."""
        return self._threads.submit(self._call, function, args, kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the workers; with `cancel_futures` also what is running in them."""
        if not cancel_futures:
            self._threads.shutdown(wait)
        with self._lock:
            self._closed = True
            workers = [*self._idle, *self._busy]
        for worker in workers:
            worker.process.kill()
        self._threads.shutdown(wait, cancel_futures=True)
        for worker in self._idle:
            worker.process.join()

    def _call(self, *call: Any) -> Any:
        with self._lock:
            if self._closed:
                raise WorkerDiedError("it was ended")
            worker = self._idle.pop() if self._idle else _Worker()
            self._busy.add(worker)
        alive = True
        try:
            good, value = worker.call(call, self._receive)
        except (EOFError, OSError):
            alive = False
            worker.process.join()
            raise WorkerDiedError(
                f"its process ended without a result (exit code {worker.process.exitcode}); "
                "most often the machine ran out of memory"
            ) from None
        finally:
            with self._lock:
                self._busy.remove(worker)
                self._idle += [worker] * alive
        if not good:
            raise value
        return value


class _Worker:
    """A process, and the pipe to it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, far = context.Pipe()
        self.process = context.Process(target=_work, args=(far,), daemon=True)
        with _starting, one_thread_environment(), _interrupts_held_back(), _without_main():
            self.process.start()
        far.close()

    def call(self, call: tuple[Any, ...], receive: Receive) -> tuple[bool, Any]:
        """Whether the call went well, and its value or what it raised."""
        self.pipe.send(call)
        while True:
            is_report, message = self.pipe.recv()
            if not is_report:
                return message
            receive(message)


def _work(pipe: Connection) -> None:
    """Body of a worker process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _reports.set(lambda message: pipe.send((True, message)))
    with contextlib.suppress(EOFError, BrokenPipeError):  # the parent is gone
        while True:
            try:
                function, args, kwargs = pipe.recv()
                collect_garbage()
                answer = True, function(*args, **kwargs)
            except (EOFError, BrokenPipeError):
                raise
            except Exception as error:
                answer = False, error
            try:
                pipe.send((False, answer))
            except (pickle.PicklingError, TypeError, AttributeError) as error:
                pipe.send((False, (False, error)))


@contextlib.contextmanager
def _without_main() -> Iterator[None]:
    """Processes that are started meanwhile do not import the script at hand.

    What they call is found by name in the package, so a user's script that runs studies needs no
    ``if __name__ == "__main__"``.
    """
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


@contextlib.contextmanager
def _interrupts_held_back() -> Iterator[None]:
    """Block SIGINT in this thread, so that a process started meanwhile never gets one.

    A child inherits the mask; without it Ctrl-C in the first tenths of a second, while the child
    imports, would end it with a traceback.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    # Started now, because it unblocks SIGINT when it starts.
    from multiprocessing import resource_tracker

    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
