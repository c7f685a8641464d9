"""Tasks through any `concurrent.futures.Executor`: their order, their errors, what they report.

By default they run in worker processes with one thread that live on, so that only the first task
of each pays for the imports. A run's peak memory is its own all the same, and its last bits do
not depend on what ran before.
"""

from __future__ import annotations

import contextlib
import queue
import traceback
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Any

from contactstudy.cluster import Cluster
from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.process import forget_peak_memory
from contactstudy.reporter import Quiet, Reporter
from contactstudy.waiting import Waiting
from contactstudy.workers import InThisProcess, WorkerDiedError, Workers, report

Progress = Callable[[int, int], None]
"""Called with the steps done and the steps in all."""


@dataclass(frozen=True)
class Task:
    """One call.

    Attributes
    ----------
    name
        Shown to the user and key of the outcome.
    function, arguments
        ``function(*arguments, progress)``, importable by name; `progress` is a `Progress`.
    after
        Names of tasks that must have ended (well or not) before this one starts.
    here
        May run in the process at hand, as when it takes less time than to start another one and
        little memory. They do so when this holds for all tasks.
    """

    name: str
    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()
    after: tuple[str, ...] = ()
    here: bool = False


@dataclass(frozen=True)
class Outcome:
    """What became of a task: its value, or the error that ended it."""

    value: Any = None
    error: ContactStudyError | None = None


def run_tasks(
    tasks: Sequence[Task],
    workers: int = 2,
    reporter: Reporter | None = None,
    finished: Callable[[str, Outcome], None] | None = None,
    executor: Executor | None = None,
) -> dict[str, Outcome]:
    """Run tasks in the order given as far as `after` allows.

    Parameters
    ----------
    tasks : sequence of Task
        With distinct names.
    workers : int
        How many run at once, unless there is an `executor`.
    reporter : Reporter, optional
        Told of the beginning, the progress, the warnings and the end of each task.
    finished : callable, optional
        ``finished(name, outcome)``, called instead of ``reporter.end`` as each task ends.
    executor : Executor, optional
        Where they run, as many at once as it likes, which stays open; by default `Workers`, or
        this process. A `Cluster` is listened to.

    Returns
    -------
    dict of str to Outcome
        In the order of `tasks`. Errors that a task raises are in its outcome; the others go on.

    Raises
    ------
    KeyboardInterrupt
        After all workers have been ended.
    """
    check_workers(workers)
    reporter = reporter or Quiet()
    events: queue.SimpleQueue[Any] = queue.SimpleQueue()

    def told(name: str, *message: Any) -> None:
        if len(message) == 1:
            reporter.note(f"{name}: {message[0]}")
        else:
            reporter.progress(name, *message)

    with contextlib.ExitStack() as stack:
        at_once = workers
        if executor is None:
            here = all(task.here for task in tasks)
            own = InThisProcess(lambda m: told(*m)) if here else Workers(workers, events.put)
            stack.callback(own.shutdown, cancel_futures=True)
            executor = own
        else:
            at_once = len(tasks)
            if isinstance(executor, Cluster):
                stack.enter_context(executor.listening(events.put))
        for task in tasks:
            reporter.begin(task.name, 0)
        named, outcomes = {task.name: task for task in tasks}, dict[str, Outcome]()
        left, running = Waiting({t.name: t.after for t in tasks}), dict[Future[Any], str]()
        stack.callback(lambda: [future.cancel() for future in running])
        while left or running:
            while len(running) < at_once and (ready := left.next()) is not None:
                future = executor.submit(perform, named[ready])
                running[future] = ready
                future.add_done_callback(events.put)
            if not running:
                raise RuntimeError(f"tasks wait for each other: {left.names}")
            event = events.get()
            if not isinstance(event, Future):
                told(*event)
                continue
            name = running.pop(event)
            left.ended(name)
            outcomes[name] = outcome = _outcome(name, event)
            if finished is None:
                reporter.end(name, outcome.error is None)
            else:
                finished(name, outcome)
    return {task.name: outcomes[task.name] for task in tasks}


def at_once(workers: int, executor: Executor | None) -> int:
    """How many tasks run at the same time."""
    return executor.number if isinstance(executor, Cluster) else workers


def check_workers(workers: Any) -> None:
    """Refuse what is no number of workers."""
    if not isinstance(workers, int) or isinstance(workers, bool) or workers < 1:
        raise InputError(f"workers = {workers!r}: must be a whole number at least 1")


def perform(task: Task) -> Outcome:
    """Run a task in the process at hand; what an executor is given."""
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    def progress(done: int, total: int) -> None:
        report((task.name, done, total))

    def warned(message: Warning | str, category: type[Warning], *_: Any, **__: Any) -> None:
        if issubclass(category, UserWarning):  # others are for developers
            report((task.name, str(message)))

    forget_peak_memory()
    try:
        with warnings.catch_warnings(), threadpool_limits(1):
            warnings.showwarning = warned
            return Outcome(value=task.function(*task.arguments, progress))
    except BrokenPipeError:  # whoever listened is gone
        raise
    except ContactStudyError as error:
        return Outcome(error=error)
    except MemoryError:
        return Outcome(error=NumericalError(f"{task.name}: out of memory"))
    except Exception:
        return Outcome(error=_unexpected(task.name, traceback.format_exc()))


def _outcome(name: str, future: Future[Any]) -> Outcome:
    """Outcome of a task whose future is done."""
    error = future.exception()
    if error is None:
        outcome: Outcome = future.result()
        return outcome
    if isinstance(error, WorkerDiedError):
        again = "what is finished is kept, the same command goes on from there"
        return Outcome(error=NumericalError(f"{name}: {error}; {again}"))
    return Outcome(error=_unexpected(name, "".join(traceback.format_exception(error))))


def _unexpected(name: str, text: str) -> ContactStudyError:
    return ContactStudyError(f"{name}: unexpected error\n{text}")
