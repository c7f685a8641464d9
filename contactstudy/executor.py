"""Many runs at once, each in a fresh process of its own with one thread.

A fresh process makes the peak memory of a run its own and its last bits independent of what ran
before. Workers never see Ctrl-C: it is the parent that ends them.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import traceback
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError

#: Read by BLAS, OpenMP and numba when they are loaded; a run's last bits must not depend on them.
ONE_THREAD = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "VECLIB_MAXIMUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
}

Progress = Callable[[int, int], None]
"""Called with the steps done and the steps in all."""


@dataclass(frozen=True)
class Task:
    """One call in a process of its own.

    Attributes
    ----------
    name : str
        Shown to the user and key of the outcome.
    function : callable
        ``function(*arguments, progress)``, importable by name; `progress` is a `Progress`.
    arguments : tuple
        Picklable arguments.
    after : tuple of str
        Names of tasks that must have ended (well or not) before this one starts.
    """

    name: str
    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()
    after: tuple[str, ...] = ()


@dataclass(frozen=True)
class Outcome:
    """What became of a task: its value, or the error that ended it."""

    value: Any = None
    error: ContactStudyError | None = None


@dataclass
class _Worker:
    task: Task
    process: BaseProcess
    pipe: Connection
    outcome: Outcome | None = field(default=None)


def run_tasks(
    tasks: Sequence[Task],
    jobs: int = 2,
    progress: Callable[[str, int, int], None] | None = None,
    finished: Callable[[str, Outcome], None] | None = None,
    note: Callable[[str, str], None] | None = None,
) -> dict[str, Outcome]:
    """Run tasks, `jobs` at a time, in the order given as far as `after` allows.

    Parameters
    ----------
    tasks : sequence of Task
        With distinct names.
    jobs : int
        Processes at once.
    progress : callable, optional
        ``progress(name, done, total)``, called in this process.
    finished : callable, optional
        ``finished(name, outcome)``, called as each task ends.
    note : callable, optional
        ``note(name, text)``, called for each warning that a task gives.

    Returns
    -------
    dict of str to Outcome
        In the order of `tasks`. Errors that a task raises are in its outcome; the others go on.

    Raises
    ------
    KeyboardInterrupt
        After all workers have been ended.
    """
    if jobs < 1:
        raise InputError(f"jobs = {jobs}: must be a whole number at least 1")
    waiting, running = list(tasks), list[_Worker]()
    outcomes: dict[str, Outcome] = {}
    try:
        while waiting or running:
            unfinished = {t.name for t in waiting} | {w.task.name for w in running}
            ready = [t for t in waiting if not unfinished & set(t.after)]
            for task in ready[: max(0, jobs - len(running))]:
                waiting.remove(task)
                running.append(_start(task))
            if not running:
                raise RuntimeError(f"tasks wait for each other: {[t.name for t in waiting]}")
            for worker in _messages(running, progress, note):
                running.remove(worker)
                outcomes[worker.task.name] = outcome = _end(worker)
                if finished is not None:
                    finished(worker.task.name, outcome)
    finally:
        for worker in running:
            worker.process.terminate()
        for worker in running:
            worker.process.join(5.0)
            if worker.process.is_alive():
                worker.process.kill()
                worker.process.join()
    return {task.name: outcomes[task.name] for task in tasks}


def _start(task: Task) -> _Worker:
    context = multiprocessing.get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(sender, task), daemon=True, name=task.name)
    with _one_thread_environment(), _interrupts_held_back():
        process.start()
    sender.close()
    return _Worker(task, process, receiver)


def _messages(
    running: list[_Worker],
    progress: Callable[[str, int, int], None] | None,
    note: Callable[[str, str], None] | None,
) -> Iterator[_Worker]:
    """Wait for messages of the workers; yield those that have ended."""
    pipes = {worker.pipe: worker for worker in running}
    for pipe in wait(list(pipes), timeout=1.0):
        assert isinstance(pipe, Connection)
        worker = pipes[pipe]
        try:
            message = pipe.recv()
        except (EOFError, OSError):  # ended without a word: killed, out of memory
            yield worker
            continue
        if isinstance(message, Outcome):
            worker.outcome = message
            yield worker
        elif isinstance(message, str):
            if note is not None:
                note(worker.task.name, message)
        elif progress is not None:
            progress(worker.task.name, *message)


def _end(worker: _Worker) -> Outcome:
    worker.process.join()
    worker.pipe.close()
    if worker.outcome is not None:
        return worker.outcome
    code = worker.process.exitcode
    return Outcome(
        error=NumericalError(
            f"{worker.task.name}: its process ended without a result (exit code {code}); "
            "most often the machine ran out of memory"
        )
    )


def _work(pipe: Connection, task: Task) -> None:
    """Body of a worker process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    def progress(done: int, total: int) -> None:
        pipe.send((done, total))

    def warned(message: Warning | str, category: type[Warning], *_: Any, **__: Any) -> None:
        if issubclass(category, UserWarning):  # others are for developers
            pipe.send(str(message))

    warnings.showwarning = warned
    try:
        with threadpool_limits(1):
            outcome = Outcome(value=task.function(*task.arguments, progress))
    except BrokenPipeError:  # the parent is gone
        return
    except ContactStudyError as error:
        outcome = Outcome(error=error)
    except MemoryError:
        outcome = Outcome(error=NumericalError(f"{task.name}: out of memory"))
    except Exception:
        text = traceback.format_exc()
        outcome = Outcome(error=ContactStudyError(f"{task.name}: unexpected error\n{text}"))
    with contextlib.suppress(BrokenPipeError):
        pipe.send(outcome)


@contextlib.contextmanager
def _one_thread_environment() -> Iterator[None]:
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


@contextlib.contextmanager
def _interrupts_held_back() -> Iterator[None]:
    """Block SIGINT here, so that a process started meanwhile never gets one.

    A child inherits the mask; without it Ctrl-C in the first tenths of a second, while the child
    imports, would end it with a traceback. Here the signal only arrives later.
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
