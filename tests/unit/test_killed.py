"""Commands that are killed or interrupted at any moment: the same command goes on from there."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from short_study import HERTZ, POINT

STUDY = f"""{POINT.replace("0.2 ms", "0.02 ms")}{HERTZ}
[runs.timoshenko]
solver = "point"
rail = "timoshenko"
"""
SWEEP = """
[sweep]
"irregularity.seed" = "1 to 4"
"journey.speed" = ["200 km/h", "300 km/h"]
"""


def started(study: Path, out: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "contactstudy.cli", "run", str(study), "--out", str(out)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def finish(study: Path, out: Path) -> float:
    """Seconds that the command takes."""
    began = time.monotonic()
    process = started(study, out)
    _, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    return time.monotonic() - began


def content(out: Path) -> dict[str, bytes]:
    """Every file but what tells the time it took."""
    found = {p.relative_to(out).as_posix(): p for p in out.rglob("*") if p.is_file()}
    timed = {name for name in found if name.startswith("runs/") and name.endswith(".json")}
    made = {name: found[name].read_bytes() for name in found.keys() - timed - {"metrics.json"}}
    metrics = untimed(json.loads(found["metrics.json"].read_text("utf-8")))
    return made | {
        "metrics.json": json.dumps(metrics).encode(),
        "slips": repr(sorted(timed)).encode(),
    }


def untimed(data: Any) -> Any:
    if isinstance(data, dict):
        timed = ("seconds", "peak_memory_mb")
        return {key: untimed(value) for key, value in data.items() if key not in timed}
    return data


def same(found: dict[str, bytes], expected: dict[str, bytes]) -> None:
    assert found.keys() == expected.keys()
    assert [name for name in expected if found[name] != expected[name]] == []


@pytest.mark.slow
@pytest.mark.parametrize("sweep", ["", SWEEP], ids=["runs", "sweep"])
def test_thirty_kills_and_a_byte_identical_end(tmp_path, sweep):
    """Every second time with all its workers, every third time in the first half second."""
    study = tmp_path / "study.toml"
    study.write_text(STUDY + sweep)
    seconds = finish(study, tmp_path / "at once")
    expected, rng, killed, ends = content(tmp_path / "at once"), np.random.default_rng(1), 0, 0
    out = tmp_path / "0"
    while killed < 30:
        process = started(study, out)
        time.sleep(rng.uniform(0.0, 0.5 if killed % 3 == 0 else seconds))
        if process.poll() is None:
            if killed % 2:
                os.killpg(process.pid, signal.SIGKILL)
            else:
                process.kill()
            killed += 1
        process.communicate()
        if process.returncode == 0:  # it came to its end all the same: again from nothing
            same(content(out), expected)
            ends += 1
            out = tmp_path / f"{ends}"
    finish(study, out)
    print(f"{killed} kills, {ends + 1} ends, {seconds:.1f} s without")
    same(content(out), expected)


@pytest.mark.slow
def test_two_processes_and_one_folder(tmp_path):
    """The second waits, and then finds all there; where the first is killed, it goes on at once."""
    study, out = tmp_path / "study.toml", tmp_path / "out"
    study.write_text(STUDY)
    finish(study, tmp_path / "at once")
    first, second = started(study, out), started(study, out)
    told = [process.communicate(timeout=300)[1] for process in (first, second)]
    assert first.returncode == second.returncode == 0
    (waited,) = [text for text in told if "is at work here" in text]
    assert re.search(r"out: process \d+ on \S+ is at work here; .*\n.*are there and up to", waited)
    same(content(out), content(tmp_path / "at once"))
    out = tmp_path / "killed"
    first, second = started(study, out), started(study, out)
    lock = out / ".runs.lock"
    while not lock.exists() or not lock.read_text():
        time.sleep(0.05)
    held = int(lock.read_text().split()[1])
    killed, other = (first, second) if first.pid == held else (second, first)
    killed.kill()
    _, err = other.communicate(timeout=300)
    assert other.returncode == 0, err
    killed.communicate()
    same(content(out), content(tmp_path / "at once"))


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_interrupts_in_the_first_moments(tmp_path, number):
    """Ctrl-C as a terminal sends it, while the command starts: one line, and it goes on."""
    study, out = tmp_path / "study.toml", tmp_path / "out"
    study.write_text(STUDY)
    for after in np.linspace(0.1, 1.5, 15):
        process = started(study, out)
        time.sleep(after)
        os.killpg(process.pid, number)
        _, err = process.communicate(timeout=60)
        assert process.returncode in (128 + number, -number)
        if process.returncode == 128 + number or "contactstudy: " in err:  # it had started
            assert process.returncode == 128 + number
            # a library that is being imported may warn of what it could not import then
            lines = [line for line in err.splitlines() if line.startswith("contactstudy: ")]
            assert len(lines) == 1 and "the same command goes on from there" in lines[0]
            assert "Traceback" not in err and err.rstrip().endswith(lines[0])
    finish(study, out)
    finish(study, tmp_path / "at once")
    same(content(out), content(tmp_path / "at once"))


INTERRUPTED = """
import sys
import contactstudy.cli as cli

cli._call = lambda tokens: exec("raise KeyboardInterrupt(15)")
sys.argv = ["contactstudy"]
sys.exit(cli.main())
"""


def test_the_exit_status_is_that_of_the_signal_inside_compiled_text_too(tmp_path):
    """`python -m` ends by SIGINT where a text that `exec` runs is interrupted, caught or not."""
    (tmp_path / "interrupted_text.py").write_text(INTERRUPTED)
    ended = subprocess.run(
        [sys.executable, "-m", "interrupted_text"], cwd=tmp_path, capture_output=True, text=True
    )
    assert "terminated; finished runs are kept" in ended.stderr
    assert ended.returncode == 143


SWALLOWED = """
import os, signal, sys, time
import contactstudy.cli as cli

def call(tokens):
    try:
        os.kill(os.getpid(), signal.SIGTERM)
    except BaseException:  # as libraries do while they import
        pass
    try:
        time.sleep(60)
    finally:
        time.sleep(1)  # what ends a command is not interrupted again
        print("put in order")

cli._call = call
sys.argv = ["contactstudy"]
sys.exit(cli.main())
"""


def test_an_interrupt_that_a_library_catches_comes_again(tmp_path):
    began = time.monotonic()
    ended = subprocess.run([sys.executable, "-c", SWALLOWED], capture_output=True, text=True)
    assert ended.returncode == 143 and "terminated; finished runs are kept" in ended.stderr
    assert ended.stdout == "put in order\n" and time.monotonic() - began < 30.0
