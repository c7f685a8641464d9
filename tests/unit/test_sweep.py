"""Tasks in processes: outcomes, errors, order, threads, and what an interrupt leaves."""

import math
import os
import signal
import threading
import time

import pytest

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.executor import ONE_THREAD, Outcome, Task, run_tasks


@pytest.fixture
def tasks_module(tmp_path, monkeypatch):
    (tmp_path / "sweep_tasks.py").write_text(
        """
import os, signal, time, warnings
from contactstudy.exceptions import InputError, NumericalError

def double(x, progress):
    for done in range(3):
        progress(done + 1, 3)
    return 2 * x

def environment(progress):
    from contactstudy.executor import ONE_THREAD
    ignored = signal.getsignal(signal.SIGINT) == signal.SIG_IGN
    return {name: os.environ.get(name) for name in ONE_THREAD}, ignored, os.getpid()

def fails(kind, progress):
    if kind == "numerical":
        raise NumericalError("step 7 at X = 8.5 m: the patch left the mesh")
    if kind == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    raise ZeroDivisionError("a bug")

def sleeps(mark, progress):
    open(mark, "w").close()
    progress(1, 100)
    time.sleep(60)

def warns(progress):
    warnings.warn("the profile repeats itself")
    warnings.warn("for developers", DeprecationWarning)

def clock(progress):
    start = time.time(); time.sleep(0.2)
    return start, time.time()
"""
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    import importlib

    import sweep_tasks

    return importlib.reload(sweep_tasks)


def test_values_progress_and_one_thread(tasks_module):
    seen: list[tuple[str, int, int]] = []
    outcomes = run_tasks(
        [Task("a", tasks_module.double, (21,)), Task("b", tasks_module.environment)],
        progress=lambda *call: seen.append(call),
    )
    assert list(outcomes) == ["a", "b"]
    assert outcomes["a"] == Outcome(value=42)
    environment, ignored, pid = outcomes["b"].value
    assert environment == ONE_THREAD and ignored and pid != os.getpid()
    assert seen == [("a", 1, 3), ("a", 2, 3), ("a", 3, 3)]


def test_errors_stay_with_their_task(tasks_module):
    tasks = [Task(kind, tasks_module.fails, (kind,)) for kind in ("numerical", "killed", "bug")]
    outcomes = run_tasks([*tasks, Task("good", tasks_module.double, (1,))])
    assert isinstance(outcomes["numerical"].error, NumericalError)
    assert "X = 8.5 m" in str(outcomes["numerical"].error)
    assert "without a result (exit code -9)" in str(outcomes["killed"].error)
    assert type(outcomes["bug"].error) is ContactStudyError
    assert "ZeroDivisionError: a bug" in str(outcomes["bug"].error)
    assert outcomes["good"].value == 2


def test_warnings_reach_the_parent(tasks_module):
    notes: list[tuple[str, str]] = []
    run_tasks([Task("a", tasks_module.warns)], note=lambda *call: notes.append(call))
    assert notes == [("a", "the profile repeats itself")]


def test_after_is_waited_for(tasks_module):
    tasks = [
        Task("late", tasks_module.clock, after=("early",)),
        Task("early", tasks_module.clock),
    ]
    outcomes = run_tasks(tasks, jobs=2)
    assert outcomes["late"].value[0] >= outcomes["early"].value[1]


def test_interrupt_ends_the_workers(tasks_module, tmp_path):
    # a test run in the background of a script starts with interrupts ignored
    before_test = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        _interrupt_while_a_task_sleeps(tasks_module, tmp_path)
    finally:
        signal.signal(signal.SIGINT, before_test)


def _interrupt_while_a_task_sleeps(tasks_module, tmp_path):
    mark = tmp_path / "started"

    def interrupt() -> None:
        while not mark.exists():
            time.sleep(0.02)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt, daemon=True).start()
    before = time.time()
    with pytest.raises(KeyboardInterrupt):
        run_tasks([Task("long", tasks_module.sleeps, (str(mark),))])
    assert time.time() - before < 20
    import multiprocessing

    assert multiprocessing.active_children() == []


def test_jobs_must_be_positive():
    with pytest.raises(InputError, match="at least 1"):
        run_tasks([Task("a", math.sqrt)], jobs=0)
