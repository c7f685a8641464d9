"""Workers of a Dask scheduler that exists already, as an executor of the standard interface.

A call goes there pickled, with the content of the input files that its arguments name, so a worker
needs the same program and packages but no disk of ours. Numbers do not depend on which worker
makes them: a worker does one call at a time, with one thread. One that dies in the middle costs
time only, because the scheduler gives its calls to others.
"""

from __future__ import annotations

import contextlib
import functools
import io
import logging
import os
import pickle
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import CancelledError, Executor, Future, InvalidStateError
from pathlib import Path
from typing import Any

from contactstudy.carried import Carrying, receiving
from contactstudy.code import code_digest
from contactstudy.exceptions import InputError
from contactstudy.process import ONE_THREAD
from contactstudy.provenance import COMPUTING, versions
from contactstudy.workers import Receive, WorkerDiedError, reports_to

CONNECTING = 5.0
"""Seconds that a scheduler has to answer."""
_one_call = threading.Lock()


class Cluster(Executor):
    """The workers of the scheduler at `address`, "tcp://host:port".

    Raises
    ------
    InputError
        When nothing answers there, or a worker has another program or other packages.
    """

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client
        except ImportError:
            raise InputError(
                "scheduler: needs dask.distributed; pip install 'contactstudy[cluster]'"
            ) from None
        for name in ("distributed", "distributed.client"):  # their errors are told by us
            logging.getLogger(name).setLevel(logging.CRITICAL)
        try:
            self._client = Client(address, timeout=CONNECTING, set_as_default=False)
        except (OSError, ValueError) as error:
            raise InputError(
                f"scheduler = {address!r}: no Dask scheduler answers there "
                f"({str(error).splitlines()[0] or type(error).__name__}); "
                "must be the address of one that runs, e.g. tcp://host:8786"
            ) from error
        self._address, self._topic = address, f"contactstudy {self._client.id}"
        self._program, self._calls = _program(), dict[Future[Any], Any]()
        try:
            self._check_workers()
        except BaseException:
            self._client.close()
            raise

    @property
    def number(self) -> int:
        """How many calls run at once, as the workers are now; at least 1."""
        return max(1, len(self._client.nthreads()))

    @property
    def remarks(self) -> list[str]:
        """What the user should know of the workers."""
        threads = self._client.nthreads()
        if not threads:
            return [f"{self._address}: has no workers yet, they are waited for"]
        many = sorted(worker for worker, number in threads.items() if number > 1)
        return [
            f"{worker}: has {threads[worker]} threads, of which one is used; start more workers "
            "with --nthreads 1"
            for worker in many
        ]

    @contextlib.contextmanager
    def listening(self, receive: Receive) -> Iterator[None]:
        """Meanwhile `receive` is called with each `report`, in another thread."""
        self._client.subscribe_topic(self._topic, lambda event: receive(tuple(event[1])))
        try:
            yield
        finally:
            self._client.unsubscribe_topic(self._topic)

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Call on the next free worker; on another one should it die."""
        future = Future[Any]()
        try:
            buffer = io.BytesIO()
            Carrying(buffer).dump((function, args, kwargs))
            arguments = (buffer.getvalue(), self._topic, self._program)
            remote = self._client.submit(_call, *arguments, pure=False)
        except Exception as error:
            future.set_exception(error)
            return future
        self._calls[future] = remote
        future.add_done_callback(self._forget)
        remote.add_done_callback(functools.partial(self._pass_on, future))
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Take leave of the scheduler, which drops what is still to be done for us."""
        self._client.close()

    def _check_workers(self) -> None:
        problems = []
        for worker, program in self._client.run(_program, on_error="return").items():
            problems += _differences(worker, program, self._program)
        if problems:
            raise InputError(problems)

    def _forget(self, future: Future[Any]) -> None:
        remote = self._calls.pop(future)
        if future.cancelled():
            with contextlib.suppress(Exception):  # the scheduler may be gone as well
                remote.cancel()

    def _pass_on(self, future: Future[Any], remote: Any) -> None:
        value: Any = None
        error: Exception | None = None
        try:
            value = remote.result()
        except CancelledError:
            error = WorkerDiedError(f"the scheduler {self._address} has gone, or dropped it")
        except Exception as raised:
            error = raised
            if type(raised).__name__ == "KilledWorker":
                error = WorkerDiedError("several workers ended in the middle of it")
        with contextlib.suppress(InvalidStateError):  # it was cancelled here
            if error is None:
                future.set_result(value)
            else:
                future.set_exception(error)


@functools.cache
def _program() -> Mapping[str, str]:
    """All that decides numbers: versions of program and packages, and the program's code."""
    return {**versions(COMPUTING), "the program's code": code_digest()[:12]}


def _differences(worker: str, found: Any, wanted: Mapping[str, str]) -> list[str]:
    """Why a worker would make other numbers."""
    if isinstance(found, Exception):
        return [f"worker {worker}: cannot run contactstudy ({found})"]
    return [
        f"worker {worker}: {name} is {found.get(name, 'missing')} there and "
        f"{wanted.get(name, 'missing')} here; must be the same"
        for name in sorted(wanted.keys() | found.keys())
        if found.get(name) != wanted.get(name)
    ]


def _call(call: bytes, topic: str, program: Mapping[str, str]) -> Any:
    """Body of a call, on a worker."""
    from distributed import get_worker
    from distributed.worker import thread_state

    worker, key = get_worker(), thread_state.key

    def tell(message: Any) -> None:
        task = worker.state.tasks.get(key)
        if task is None or task.state != "executing":  # nobody waits for it any more
            raise BrokenPipeError
        worker.log_event(topic, list(message))

    with _one_call, reports_to(tell):
        os.environ.update(ONE_THREAD)  # for libraries that are still to be loaded
        if problems := _differences(worker.address, _program(), program):
            raise InputError(problems)
        with receiving(Path(worker.local_directory)):
            function, args, kwargs = pickle.loads(call)
        return function(*args, **kwargs)
