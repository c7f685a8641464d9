"""Tasks in processes: outcomes, errors, order, threads, and what an interrupt leaves."""

import math
import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.executor import Outcome, Task, run_tasks
from contactstudy.process import ONE_THREAD
from contactstudy.reporter import Quiet


class Recorder(Quiet):
    """A reporter that remembers."""

    def __init__(self):
        self.notes, self.steps, self.ends = [], [], []

    def note(self, text):
        self.notes.append(text)

    def progress(self, name, done, total):
        self.steps.append((name, done, total))

    def end(self, name, ok):
        self.ends.append((name, ok))


@pytest.fixture
def tasks_module(tmp_path, monkeypatch):
    (tmp_path / "pool_tasks.py").write_text(
        """
import os, signal, time, warnings
from contactstudy.exceptions import InputError, NumericalError

def double(x, progress):
    for done in range(3):
        progress(done + 1, 3)
    return 2 * x

def environment(progress):
    from contactstudy.process import ONE_THREAD
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

def gives_back_a_function(progress):
    return lambda: 0

def memory(millions, progress):
    import numpy as np
    from contactstudy.process import peak_memory_mb
    numbers = np.ones(millions * 1_000_000)
    return peak_memory_mb()

SETTINGS = (
    "solid.mesh_size=5 mm", "solid.coarse_mesh_size=20 mm", "solid.cell_length=50 mm",
    "solid.contact_half_length=15 mm", "solid.contact_half_width=10 mm",
    "solid.interface_modes=8", "solid.internal_modes=0", "track.length=3.6 m",
    "journey.from=1.8 m", "journey.to=1.85 m", "journey.time_step=1e-4", "journey.fade_in=0",
    "journey.stations=[1.82]", "solid.pressure_at=[1.82]", "solid.wheel=rigid",
)

def run(kind, progress):
    import hashlib
    from contactstudy.study.kinds.passage.execution import execute_run
    from contactstudy.study.loading import load_study
    study = load_study("point_vs_surface", SETTINGS)
    data = execute_run(study, kind, progress)
    total = hashlib.sha256()
    for name in sorted(data.variables):
        if data[name].dtype.kind in "fiu":
            total.update(name.encode() + data[name].values.tobytes())
    return total.hexdigest()
"""
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    import importlib

    import pool_tasks

    return importlib.reload(pool_tasks)


def test_values_progress_and_one_thread(tasks_module):
    recorder = Recorder()
    outcomes = run_tasks(
        [Task("a", tasks_module.double, (21,)), Task("b", tasks_module.environment)],
        reporter=recorder,
    )
    assert list(outcomes) == ["a", "b"]
    assert outcomes["a"] == Outcome(value=42)
    environment, ignored, pid = outcomes["b"].value
    assert environment == ONE_THREAD and ignored and pid != os.getpid()
    assert sorted(recorder.ends) == [("a", True), ("b", True)]
    assert recorder.steps == [("a", 1, 3), ("a", 2, 3), ("a", 3, 3)]


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
    recorder = Recorder()
    # in one worker, where Python would show a warning of the same place once
    run_tasks([Task(name, tasks_module.warns) for name in "ab"], workers=1, reporter=recorder)
    assert recorder.notes == [f"{name}: the profile repeats itself" for name in "ab"]


def test_after_is_waited_for(tasks_module):
    tasks = [
        Task("late", tasks_module.clock, after=("early",)),
        Task("early", tasks_module.clock),
    ]
    outcomes = run_tasks(tasks, workers=2)
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
        run_tasks([Task("a", math.sqrt)], workers=0)


def test_workers_live_on_and_one_that_dies_is_replaced(tasks_module):
    def environments(*names):
        return [Task(name, tasks_module.environment) for name in names]

    tasks = [*environments("a", "b"), Task("dies", tasks_module.fails, ("killed",))]
    outcomes = run_tasks([*tasks, *environments("c", "d")], workers=1)
    pids = {name: o.value[2] for name, o in outcomes.items() if o.error is None}
    assert pids["a"] == pids["b"] != pids["c"] == pids["d"]
    assert "without a result" in str(outcomes["dies"].error)


def test_any_executor_of_the_standard_library_will_do(tasks_module):
    tasks = [Task("a", tasks_module.double, (21,)), Task("b", tasks_module.fails, ("numerical",))]
    with ThreadPoolExecutor(2) as executor:
        outcomes = run_tasks(tasks, executor=executor)
    assert outcomes["a"].value == 42 and isinstance(outcomes["b"].error, NumericalError)


def test_tasks_that_may_run_in_this_process(tasks_module):
    recorder = Recorder()
    tasks = [Task("a", tasks_module.double, (1,), here=True)]
    tasks += [Task("b", tasks_module.warns, here=True), Task("c", pid, here=True)]
    outcomes = run_tasks(tasks, reporter=recorder)
    assert outcomes["a"].value == 2 and outcomes["c"].value == os.getpid()
    assert len(recorder.steps) == 3 and recorder.notes == ["b: the profile repeats itself"]
    tasks[0] = Task("a", tasks_module.double, (1,))  # one that needs a process of its own
    assert run_tasks([tasks[0], Task("c", pid, here=True)])["c"].value != os.getpid()


def pid(progress):
    return os.getpid()


def test_what_cannot_be_sent_is_an_error_of_its_task(tasks_module):
    tasks = [Task("there", len, (lambda: 0,)), Task("good", tasks_module.double, (1,))]
    tasks += [Task("back", tasks_module.gives_back_a_function)]
    outcomes = run_tasks(tasks, workers=1)
    assert "unexpected error" in str(outcomes["there"].error)
    assert "unexpected error" in str(outcomes["back"].error)
    assert outcomes["good"].value == 2


def test_peak_memory_is_the_tasks_own(tasks_module):
    tasks = [Task(name, tasks_module.memory, (size,)) for name, size in (("big", 40), ("small", 1))]
    big, small = (o.value for o in run_tasks(tasks, workers=1).values())
    print(f"peak {big:.0f} MB with 320 MB of numbers, {small:.0f} MB without in the same process")
    assert 300 < big - small < 340


def test_results_do_not_depend_on_what_ran_before(tasks_module):
    """Bits of a point run and a surface run: in fresh processes, and one after the other."""
    fresh = {}
    for name in ("point", "surface"):
        (outcome,) = run_tasks([Task(name, tasks_module.run, (name,))]).values()
        assert outcome.error is None, outcome.error
        fresh[name] = outcome.value
    assert len(fresh["point"]) == 64 and fresh["point"] != fresh["surface"]
    (here,) = run_tasks([Task("here", tasks_module.run, ("point",), here=True)]).values()
    assert here.value == fresh["point"]
    order = ("surface", "point", "surface", "point")
    tasks = [Task(f"{name} {k}", tasks_module.run, (name,)) for k, name in enumerate(order)]
    outcomes = run_tasks(tasks, workers=1)
    assert [o.value for o in outcomes.values()] == [fresh[name] for name in order]
