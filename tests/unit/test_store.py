"""What is kept on disk: whole, damaged, unwritable; what its key holds; leftovers of writers."""

import ast
import os
import re
import select
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from contactstudy import code
from contactstudy.files import alone, remove_unfinished, writing
from contactstudy.solids.cache import CachedBody, cache_store, cached, entry_path
from contactstudy.store import ARRAYS, DATASET, Store, StoreWarning, store_key
from contactstudy.study.kind import KINDS, find_kind
from contactstudy.verification.cases import CASES


@dataclass(frozen=True)
class Recipe:
    size: float = 1.0


@dataclass(frozen=True)
class Plate:
    recipe: Recipe
    matrix: np.ndarray


def counting():
    calls = []

    def build(recipe):
        calls.append(recipe)
        return Plate(recipe, np.arange(12.0).reshape(3, 4) * recipe.size)

    return (lambda recipe: CachedBody("plate", recipe, build, Plate)), calls


def test_second_time_comes_from_disk(tmp_path):
    plate, calls = counting()
    first = cached(plate(Recipe()), cache_store(tmp_path))
    second = cached(plate(Recipe()), cache_store(tmp_path))
    np.testing.assert_array_equal(first.matrix, second.matrix)
    assert len(calls) == 1
    cached(plate(Recipe(2.0)), cache_store(tmp_path))
    assert len(calls) == 2
    assert not list(tmp_path.glob(".*"))


@pytest.mark.parametrize("damage", ["truncate", "flip", "garbage", "empty"])
def test_damaged_entry_is_found_out_and_rebuilt(tmp_path, damage):
    plate, calls = counting()
    cached(plate(Recipe()), cache_store(tmp_path))
    path = entry_path(plate(Recipe()), cache_store(tmp_path))
    data = bytearray(path.read_bytes())
    if damage == "flip":
        at = data.find(np.float64(5.0).tobytes())
        data[at] ^= 0xFF
    path.write_bytes(
        {"truncate": data[: len(data) // 2], "flip": data, "garbage": b"x" * 99, "empty": b""}[
            damage
        ]
    )
    with pytest.warns(StoreWarning, match="damaged"):
        body = cached(plate(Recipe()), cache_store(tmp_path))
    np.testing.assert_array_equal(body.matrix, np.arange(12.0).reshape(3, 4))
    assert len(calls) == 2
    cached(plate(Recipe()), cache_store(tmp_path))
    assert len(calls) == 2


def test_unwritable_folder_is_said(tmp_path):
    plate, _ = counting()
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    with pytest.warns(StoreWarning, match="cannot be written"):
        assert cached(plate(Recipe()), cache_store(blocked / "cache")).matrix.shape == (3, 4)


def test_plain_data_and_datasets_survive(tmp_path):
    data = xr.Dataset({"force": ("time", np.arange(3.0), {"units": "N"})})
    data.attrs = {"symmetric": True, "nothing": None, "seconds_setup": 0.3}
    for store, value in ((Store(tmp_path), {"rows": [1.5, "a", None]}),
                         (Store(tmp_path, DATASET), data)):  # fmt: skip
        store.save("one", "0" * 16, value, {"seconds": 2.0})
        kept = store.load("one", "0" * 16)
        assert kept.about == {"seconds": 2.0} and kept.damage == ""
    assert kept.value.force.identical(data.force) and kept.value.attrs == {"symmetric": 1}
    assert Store(tmp_path).load("one", "0" * 16).value is None  # the dataset's slip has no value


@pytest.mark.parametrize("lost", ["slip", "content"])
def test_half_an_entry_is_no_entry(tmp_path, lost):
    store = Store(tmp_path, ARRAYS)
    path = store.save("one", "0" * 16, {"a": np.arange(3)})
    (path.with_suffix(".json") if lost == "slip" else path).unlink()
    kept = store.load("one", "0" * 16)
    assert kept.value is None and ("checksum is missing" in kept.damage) == (lost == "slip")


def test_clearing_removes_own_files_only(tmp_path):
    store = Store(tmp_path, ARRAYS)
    store.save("CellRecipe", "0123456789abcdef", {"a": np.arange(3)})
    names = ("notes.json", "mesh-2.npz", ".hidden", "my-cafe.json")
    for name in names:
        (tmp_path / name).write_text("mine")
    assert len(store.files()) == 2
    store.clear()
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(names)


def test_a_file_is_whole_or_not_there_with_the_usual_mode(tmp_path):
    target = tmp_path / "deep" / "a.txt"
    target.parent.mkdir()
    with pytest.raises(ZeroDivisionError), writing(target) as stream:
        stream.write(b"half")
        raise ZeroDivisionError
    assert list(target.parent.iterdir()) == []
    (tmp_path / "plain").touch()
    with writing(target) as stream:
        stream.write(b"whole")
    assert target.read_text() == "whole"
    assert target.stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_what_a_killed_writer_leaves_is_removed(tmp_path):
    script = (
        "import os, sys, pathlib, shutil, tempfile; from contactstudy import files\n"
        "make = tempfile.mkstemp\n"
        "tempfile.mkstemp = lambda **names: (make(**names), os.kill(os.getpid(), 9))\n"
        "files.write_file(pathlib.Path(sys.argv[1]), b'lost')"
    )
    command = [sys.executable, "-c", script, str(tmp_path / "one-01.nc")]
    subprocess.run(command, check=False)
    (left,) = tmp_path.iterdir()
    mine = tmp_path / re.sub(r"-\d+-", f"-{os.getpid()}-", left.name)  # of a writer that lives
    mine.touch()
    Store(tmp_path).save("other", "0" * 16, 1)
    assert mine.exists() and not left.exists()
    subprocess.run(command, check=False)
    Store(tmp_path).save("other", "0" * 16, 2)
    assert len(list(tmp_path.glob(".unfinished*"))) == 2  # a process looks once
    mine.unlink()
    remove_unfinished(tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == [f"other-{'0' * 16}.json"]


def test_one_process_at_a_time(tmp_path):
    """A process that is killed gives way, and what it locked is left to the others."""
    script = (
        "import os, sys, time, pathlib; from contactstudy.files import alone\n"
        "with alone(pathlib.Path(sys.argv[1])): print('in', flush=True); time.sleep(60)"
    )
    command = [sys.executable, "-c", script, str(tmp_path / "body.npz")]
    first, second = (subprocess.Popen(command, stdout=subprocess.PIPE) for _ in range(2))
    try:
        inside, _, _ = select.select([first.stdout, second.stdout], [], [], 30)
        assert len(inside) == 1
        holder, waiter = (first, second) if inside[0] is first.stdout else (second, first)
        assert select.select([waiter.stdout], [], [], 0.5)[0] == []
        holder.kill()
        assert waiter.stdout.readline() == b"in\n"
    finally:
        for process in (first, second):
            process.kill()
            process.wait()
            process.stdout.close()
    with alone(tmp_path / "body.npz"):
        pass
    assert list(tmp_path.iterdir()) == []


RUN = "contactstudy.study.kinds.passage.execution"
BODY = "contactstudy.solids.cell"


def test_imports_are_found_as_python_finds_them():
    """Against a plainly written twin on the syntax tree."""
    for module in (RUN, BODY, "contactstudy.cli"):
        found, waiting = set(), [module]
        while waiting:
            name = waiting.pop()
            parts = name.split(".")
            path = code._ROOT.joinpath(*parts[1:])
            path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
            if name in found or len(parts) < 2 or not path.is_file():
                continue
            found.add(name)
            waiting.append(".".join(parts[:-1]))
            tree = ast.parse(path.read_text("utf-8"))
            skipped = {
                id(inner)
                for node in tree.body
                if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING"
                for inner in ast.walk(node)
            }
            for node in ast.walk(tree):
                if id(node) in skipped:
                    continue
                if isinstance(node, ast.Import):
                    names = [alias.name for alias in node.names]
                elif isinstance(node, ast.ImportFrom):
                    names = [node.module, *(f"{node.module}.{a.name}" for a in node.names)]
                else:
                    continue
                waiting += [n for n in names if n.split(".")[0] == "contactstudy"]
        assert code.modules_of(module) == found


@pytest.fixture
def keys(tmp_path):
    """Keys of a run, of a body and of all outputs as a copy of the program makes them."""
    top = Path(__file__).parents[2]
    for folder in ("contactstudy", "meshes", "studies", "reports/template"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(top / folder, tmp_path / "copy" / folder, ignore=ignored)
    script = (
        "from contactstudy.store import store_key as key; "
        f"print(key(1, {RUN!r}), key(1, {BODY!r}), key(1, None))"
    )

    def current():
        made = subprocess.run(
            [sys.executable, "-c", script], cwd=tmp_path / "copy", env={**os.environ,
            "PYTHONPATH": str(tmp_path / "copy")}, capture_output=True, text=True, check=True,
        )  # fmt: skip
        return made.stdout.split()

    return tmp_path / "copy", current


@pytest.mark.parametrize(
    ("file", "run", "body"),
    [
        ("contactstudy/dynamics/stepper.py", True, False),
        ("contactstudy/solids/hexahedron.py", True, True),
        ("contactstudy/plot/style.py", False, False),
        ("contactstudy/report/content.py", False, False),
        ("contactstudy/cli.py", False, False),
        ("reports/template/template.typ", False, False),
        ("meshes/profiles/60E1.toml", True, True),
    ],
)
def test_an_edit_changes_the_keys_of_what_it_decides(keys, file, run, body):
    folder, current = keys
    before = current()
    assert before == current() and all(re.fullmatch("[0-9a-f]{16}", key) for key in before)
    path = folder / file
    comment = {".py": "#", ".toml": "#", ".typ": "//"}[path.suffix]
    path.write_text(path.read_text("utf-8") + f"{comment} edited\n", "utf-8")
    changed = [a != b for a, b in zip(before, current(), strict=True)]
    assert changed == [run, body, True]


SHOWS = re.compile(
    r"contactstudy\.(figures|report|commands|cli|driver|notebook|plot\.(draw|fonts|style)"
    r"|study\.(terminal|kinds\.\w+\.(report|drawings|terminal)))\b"
)


def test_nothing_that_computes_imports_what_shows():
    """So another caption, colour or option computes nothing again."""
    kinds = [find_kind(name) for name in KINDS]
    does = [
        getattr(k, f"{how}ing") for k in kinds for how in ("comput", "batch", "measur", "refin")
    ]
    computing = {place.partition(":")[0] for place in does if place}
    computing |= {case.function.partition(":")[0] for case in CASES} | {BODY}
    assert RUN in computing and len(computing) > len(CASES) / 2
    for module in computing:
        assert not [name for name in code.modules_of(module) if SHOWS.match(name)], module
    assert [name for name in code.modules_of("contactstudy.cli") if SHOWS.match(name)]


def test_other_inputs_make_another_key():
    assert store_key([1], RUN) != store_key([2], RUN)
