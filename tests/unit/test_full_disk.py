"""Disks that fill up at any moment: one message, nothing lost, the same bytes with room again."""

import errno
import io
import os
import re
import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from test_killed import STUDY, content, same

from contactstudy import cli, files
from contactstudy.compiled import compiled
from contactstudy.exceptions import StorageError
from contactstudy.files import write_file
from contactstudy.solids.cache import CachedBody, cache_store, cached
from contactstudy.store import ARRAYS, Store, StoreWarning

MOMENTS = 10


@pytest.fixture
def disk(monkeypatch):
    """Stands for the disk: so many bytes have room."""

    def put(room: float, reason: int = errno.ENOSPC) -> None:
        left = [room]

        class Stream(io.FileIO):
            def write(self, data):
                super().write(data[: int(max(0, min(left[0], len(data))))])
                left[0] -= len(data)
                if left[0] < 0:
                    raise OSError(reason, os.strerror(reason))

        monkeypatch.setattr(files, "open", Stream, raising=False)

    return put


@pytest.mark.parametrize(
    ("reason", "told"),
    [
        (errno.ENOSPC, "the disk is full; 5 kB needed, .*B free"),
        (errno.EDQUOT, "your quota on the disk is used up"),
        (errno.EFBIG, "it is larger than files may become here, see ulimit -f"),
        (errno.EIO, "the disk reports an error"),
    ],
)
def test_what_was_there_stays(tmp_path, disk, reason, told):
    file = tmp_path / "one.npz"
    write_file(file, b"before")
    disk(1000, reason)
    with pytest.raises(StorageError, match=rf"^{re.escape(str(file))}: .*{told}") as found:
        write_file(file, bytes(5000))
    assert found.value.exit_status == 1 and "\n" not in str(found.value)
    assert [p.name for p in tmp_path.iterdir()] == ["one.npz"] and file.read_bytes() == b"before"


def test_half_an_entry_is_no_entry(tmp_path, disk):
    store, values = Store(tmp_path, ARRAYS), {"a": np.arange(100.0)}
    for room in (0, 60, 300, 700):  # the slip does not fit, or does and the content does not
        disk(room)
        with pytest.raises(StorageError):
            store.save("one", "0" * 16, values)
        assert store.load("one", "0" * 16).value is None
    disk(np.inf)
    store.save("one", "0" * 16, values)
    np.testing.assert_array_equal(store.load("one", "0" * 16).value["a"], values["a"])


@dataclass(frozen=True)
class Plate:
    recipe: float
    matrix: np.ndarray


def test_a_body_goes_uncached(tmp_path, disk):
    body = CachedBody("plate", 1.0, lambda recipe: Plate(recipe, np.arange(3.0)), Plate)
    disk(10)
    with pytest.warns(StoreWarning, match="cannot be written .*disk is full.* used uncached"):
        assert cached(body, cache_store(tmp_path)).matrix.shape == (3,)
    assert not cache_store(tmp_path).has("float", body.key)


def add_one(number):
    return number + 1


def test_compiling_needs_no_disk(monkeypatch):
    """What numba would keep is compiled again the next time."""
    from numba.core.caching import IndexDataCacheFile as Kept

    def full(*arguments):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Kept, "_save_index", full)
    monkeypatch.setattr(Kept, "_load_index", full)
    assert compiled(add_one)(2) == 3


def attempt(study: Path, out: Path, capfd) -> bool:
    """Whether the command came to its end; if not, it says in one message why."""
    status, err = cli.main(["run", str(study), "--out", str(out)]), capfd.readouterr().err
    if status:
        assert status == 1
        assert re.fullmatch(r"contactstudy: \S+: cannot be written \(the disk is full; .*\n", err)
        assert not list(out.rglob(".*"))
    return status == 0


@pytest.mark.slow
def test_ten_moments_and_a_byte_identical_end(tmp_path, disk, capfd):
    """With a stand-in for the disk, which any user may run."""
    study = tmp_path / "study.toml"
    study.write_text(STUDY)
    assert attempt(study, tmp_path / "at once", capfd)
    expected = content(tmp_path / "at once")
    size, out, moments = sum(map(len, expected.values())), tmp_path / "out", 0
    finished: set[Path] = set()
    for share in np.linspace(0.01, 0.95, MOMENTS):
        disk(share * size - sum(p.stat().st_size for p in out.rglob("*.*") if p.is_file()))
        moments += not attempt(study, out, capfd)
        kept = set(out.glob("runs/*.npz"))
        assert finished <= kept
        finished = kept
    assert moments >= MOMENTS - 1
    disk(np.inf)
    assert attempt(study, out, capfd)
    same(content(out), expected)


@pytest.fixture
def small_disk(tmp_path):
    """Folder on a disk of its own, and what changes its size."""
    folder = tmp_path / "disk"
    folder.mkdir()

    def mount(*options: str) -> int:
        command = ["mount", "-t", "tmpfs", *options, "tmpfs", str(folder)]
        return subprocess.run(command, capture_output=True, check=False).returncode

    if sys.platform != "linux" or mount("-o", "size=16k") != 0:
        pytest.skip("this user may not mount a small disk")
    yield folder, lambda size: mount("-o", f"remount,size={size}k")
    subprocess.run(["umount", "-l", str(folder)], check=True)


@pytest.mark.slow
def test_a_disk_that_is_full(tmp_path, small_disk):
    """Results and temporary files on one full disk, in processes of their own."""
    study, (folder, grow) = tmp_path / "study.toml", small_disk
    study.write_text(STUDY)
    env = {**os.environ, "TMPDIR": str(folder)}

    def run(out: Path) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "contactstudy.cli", "run", str(study), "--out", str(out)]
        return subprocess.run(command, env=env, capture_output=True, text=True, check=False)

    assert run(tmp_path / "at once").returncode == 0
    expected, moments = content(tmp_path / "at once"), 0
    size = sum(p.stat().st_size for p in (tmp_path / "at once").rglob("*") if p.is_file()) / 1000
    for share in np.linspace(0.02, 0.9, MOMENTS):
        grow(int(share * size))
        made = run(folder / "out")
        assert made.returncode == 1 and made.stderr.count("\n") == 1, made.stderr
        assert f"{folder}/out" in made.stderr and "the disk is full" in made.stderr
        moments += 1
    grow(10 * int(size))
    assert run(folder / "out").returncode == 0
    print(f"{moments} full disks of up to {0.9 * size:.0f} kB")
    same(content(folder / "out"), expected)


@pytest.mark.slow
@pytest.mark.parametrize("limit", [1, 50, 150])
def test_a_limit_of_file_sizes(tmp_path, limit):
    study = tmp_path / "study.toml"
    study.write_text(STUDY)
    command = [sys.executable, "-m", "contactstudy.cli", "run", str(study), "--out"]

    def limited():
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000 * limit, 1000 * limit))

    made = subprocess.run(
        [*command, str(tmp_path / "out")], preexec_fn=limited, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert made.returncode == 1 and "see ulimit -f" in made.stderr, made.stderr
    assert made.stderr.count("\n") == 1
    subprocess.run([*command, str(tmp_path / "out")], check=True)
    subprocess.run([*command, str(tmp_path / "at once")], check=True)
    same(content(tmp_path / "out"), content(tmp_path / "at once"))
