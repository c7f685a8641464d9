"""A Dask scheduler and two workers on loopback: same bytes as here, one worker killed, Ctrl-C."""

import os
import re
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from short_study import HERTZ, WAY

from contactstudy import cli, cluster, driver
from contactstudy.cluster import Cluster
from contactstudy.driver import compute_study, run_study
from contactstudy.exceptions import InputError
from contactstudy.executor import Task, run_tasks
from contactstudy.reporter import Quiet
from contactstudy.study.axes.swept import variants
from contactstudy.study.loading import load_study

TASKS = '''
import os, time, warnings
from pathlib import Path

def counts(folder, progress):
    """Notes its process and waits for a sign."""
    warnings.warn("the profile repeats itself")
    Path(folder, f"{os.getpid()}").touch()
    done = 0
    while not Path(folder, "go on").exists():
        done += 1
        progress(done, 1000)
        time.sleep(0.02)
    return os.getpid()

def threads(progress):
    import numpy, scipy.linalg, threadpoolctl
    return {found["num_threads"] for found in threadpoolctl.threadpool_info()}

def ends(progress):
    os.kill(os.getpid(), 9)
'''

STUDY = f"""{WAY}
[irregularity]
spectrum = "measured"
file = "level.csv"
level_column = "z"
wavelengths = ["0.1 m", "3 m"]
[runs.point]
solver = "point"
{HERTZ}
[sweep]
"journey.speed" = ["200 km/h", "250 km/h", "300 km/h"]
"track.pad_stiffness" = ["60 MN/m", "70 MN/m"]
keep = ["contact_force"]
"""


#: A call is given up when two workers have ended in the middle of it.
GIVES_UP_EARLY = {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"}


Process = subprocess.Popen[bytes]


class Dask:
    """A scheduler and its workers, each a process; `home` is where the workers stand."""

    def __init__(self, home: Path) -> None:
        self.home = home
        (home / "cluster_tasks.py").write_text(TASKS)
        self.processes: list[Process] = []
        _, line = self._start("scheduler", r"Scheduler at: +(tcp://127\S+)", "--no-dashboard")
        self.address = line

    def worker(self) -> Process:
        arguments = ("--no-nanny", "--nthreads", "1", "--no-dashboard")
        return self._start("worker", r"Registered to: +(\S+)", *arguments, self.address)[0]

    def _start(self, what: str, wanted: str, *arguments: str) -> tuple[Process, str]:
        path = os.pathsep.join([str(self.home), os.environ.get("PYTHONPATH", "")])
        cache = str(self.home / "cache")
        log = self.home / f"{what}{len(self.processes)}.log"
        with log.open("w") as stream:
            process = subprocess.Popen(
                [sys.executable, "-m", "distributed.cli.dask_" + what, "--host", "127.0.0.1",
                 *(("--port", "0") if what == "scheduler" else ()), *arguments],
                env=os.environ | {"PYTHONPATH": path, "CONTACTSTUDY_CACHE": cache}
                | GIVES_UP_EARLY,
                cwd=self.home, stderr=stream,
            )  # fmt: skip
        self.processes.append(process)
        for _ in range(600):
            if found := re.search(wanted, log.read_text()):
                return process, found[1]
            time.sleep(0.05)
        raise AssertionError(f"{what} did not start: {log.read_text()}")

    def close(self) -> None:
        for process in reversed(self.processes):
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def dask(tmp_path_factory):
    made = Dask(tmp_path_factory.mktemp("elsewhere"))
    try:
        for _ in range(2):
            made.worker()
        yield made
    finally:
        made.close()


@pytest.fixture
def tasks(dask, monkeypatch):
    monkeypatch.syspath_prepend(str(dask.home))
    import cluster_tasks

    return cluster_tasks


class Recorder(Quiet):
    def __init__(self):
        self.notes, self.steps = [], []

    def note(self, text):
        self.notes.append(text)

    def progress(self, name, done, total):
        self.steps.append((name, done, total))


def test_progress_warnings_and_a_worker_that_is_killed(dask, tasks, tmp_path):
    """The killed worker's call is made by another one, and nothing is lost."""
    victim = dask.worker()

    class Killer(Recorder):
        def progress(self, name, done, total):
            super().progress(name, done, total)
            # once all have begun: a call that is taken over waits for a worker that is free
            begun = {name for name, *_ in self.steps} == set(names)
            if begun and (tmp_path / str(victim.pid)).exists():
                victim.kill()
                (tmp_path / "go on").touch()

    killer, names = Killer(), "abc"
    with Cluster(dask.address) as workers:
        assert workers.number == 3 and workers.remarks == []
        calls = [Task(name, tasks.counts, (str(tmp_path),)) for name in names]
        outcomes = run_tasks(calls, reporter=killer, executor=workers)
    victim.wait()
    assert (tmp_path / str(victim.pid)).exists()
    assert all(outcomes[name].value not in (None, victim.pid) for name in names)
    assert {f"{name}: the profile repeats itself" for name in names} == set(killer.notes)


def test_one_thread(dask, tasks):
    with Cluster(dask.address) as workers:
        (outcome,) = run_tasks([Task("t", tasks.threads)], executor=workers).values()
    assert outcome.value == {1}


def study_file(folder: Path) -> Path:
    """A swept study with a measured level, in a folder that no worker stands in."""
    x = np.arange(0.0, 6.0, 0.01)
    rows = [f"{a:.3f},{1e-2 * np.sin(2 * np.pi * a):.7f}" for a in x]
    (folder / "level.csv").write_text("\n".join(["x,z", *rows]) + "\n")
    path = folder / "measured.toml"
    path.write_text(STUDY)
    return path


def test_results_are_byte_identical_though_a_worker_is_killed(dask, tmp_path, monkeypatch):
    """Also the measured file gets to the workers, which do not find it by its relative path."""
    study_file(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(driver, "render", lambda *_: [])
    study, victim = load_study("measured.toml"), dask.worker()
    assert all(v.study.irregularity.file == "level.csv" for v in variants(study).values())

    class Killer(Quiet):
        def progress(self, name, done, total):
            victim.kill()

    one = run_study(study, tmp_path / "here", 1)
    run_study(study, tmp_path / "there", 1, Killer(), scheduler=dask.address)
    victim.wait()
    assert not one.failures
    for name in ("result.nc", "sweep.csv"):
        assert (tmp_path / "here" / name).read_bytes() == (tmp_path / "there" / name).read_bytes()


def test_bodies_are_condensed_where_they_are_needed(dask, tmp_path):
    """A run on the solid rail, on workers with a cache of their own; as here, bit for bit."""
    settings = (
        "solid.mesh_size=5 mm", "solid.coarse_mesh_size=20 mm", "solid.cell_length=50 mm",
        "solid.contact_half_length=15 mm", "solid.contact_half_width=10 mm",
        "solid.interface_modes=8", "solid.internal_modes=0", "track.length=3.6 m",
        "journey.from=1.8 m", "journey.to=1.85 m", "journey.time_step=1e-4", "journey.fade_in=0",
        "journey.stations=[1.82]", "solid.pressure_at=[1.82]", "solid.wheel=rigid",
    )  # fmt: skip
    study = load_study("point_vs_surface", settings)
    study = replace(study, runs={"surface": study.runs["surface"]}, companions=())
    here = compute_study(study, tmp_path / "here", 1)
    there = compute_study(study, tmp_path / "there", 1, scheduler=dask.address)
    assert there.runs["surface"].identical(here.runs["surface"])
    assert len(list((dask.home / "cache").glob("*.npz"))) == 1


def test_an_interrupt_ends_what_runs_on_the_workers(dask, tasks, tmp_path):
    class Interrupted(Quiet):
        def progress(self, name, done, total):
            raise KeyboardInterrupt

    with Cluster(dask.address) as workers, pytest.raises(KeyboardInterrupt):
        calls = [Task(name, tasks.counts, (str(tmp_path),)) for name in "abcd"]
        run_tasks(calls, reporter=Interrupted(), executor=workers)
    # both workers are free again, though nobody gave the sign that the calls wait for
    with Cluster(dask.address) as workers:
        calls = [Task(name, tasks.threads) for name in "abcd"]
        outcomes = run_tasks(calls, executor=workers)
    assert all(outcome.value == {1} for outcome in outcomes.values())


def test_a_call_that_ends_every_worker_is_given_up(dask, tasks):
    dask.worker()
    with Cluster(dask.address) as workers:
        (outcome,) = run_tasks([Task("bad", tasks.ends)], executor=workers).values()
    assert "bad: several workers ended in the middle of it" in str(outcome.error)


def test_a_scheduler_that_dies(tasks, tmp_path, capfd):
    made = Dask(tmp_path)
    try:
        made.worker()

        class Killer(Quiet):
            def progress(self, name, done, total):
                made.processes[0].kill()

        with Cluster(made.address) as workers:
            calls = [Task("lost", tasks.counts, (str(tmp_path),))]
            (outcome,) = run_tasks(calls, reporter=Killer(), executor=workers).values()
    finally:
        made.close()
    assert f"lost: the scheduler {made.address} has gone" in str(outcome.error)
    assert "the same command goes on from there" in str(outcome.error)
    assert capfd.readouterr().err == ""


def refused(capfd, *arguments):
    assert cli.main([str(a) for a in arguments]) == 2
    return capfd.readouterr().err


def test_a_scheduler_that_cannot_be_reached(capfd, tmp_path):
    began = time.monotonic()
    command = ("run", "smooth_rail", "--out", tmp_path, "--scheduler")
    for address in ("tcp://127.0.0.1:9", "nonsense", "http://127.0.0.1:9"):
        assert f"scheduler = '{address}': no Dask scheduler" in refused(capfd, *command, address)
    assert time.monotonic() - began < 20


def test_a_worker_with_another_program_is_refused(dask, monkeypatch):
    cluster._program.cache_clear()
    monkeypatch.setattr(cluster, "versions", lambda packages: {"numpy": "1.0"})
    try:
        with pytest.raises(InputError, match=r"worker tcp://\S+: numpy is \S+ there and 1.0 here"):
            Cluster(dask.address)
    finally:
        cluster._program.cache_clear()
