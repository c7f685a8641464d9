"""The cache of condensed bodies: whole, damaged, unwritable."""

from dataclasses import dataclass

import numpy as np
import pytest

from contactstudy.solids.cache import CacheWarning, cached, entry_path


@dataclass(frozen=True)
class Recipe:
    size: float = 1.0


@dataclass(frozen=True)
class Body:
    recipe: Recipe
    matrix: np.ndarray


def counting():
    calls = []

    def build(recipe):
        calls.append(recipe)
        return Body(recipe, np.arange(12.0).reshape(3, 4) * recipe.size)

    return build, calls


def test_second_time_comes_from_disk(tmp_path):
    build, calls = counting()
    first = cached(build, Body, Recipe(), tmp_path)
    second = cached(build, Body, Recipe(), tmp_path)
    np.testing.assert_array_equal(first.matrix, second.matrix)
    assert len(calls) == 1
    cached(build, Body, Recipe(2.0), tmp_path)
    assert len(calls) == 2
    assert not list(tmp_path.glob("*.tmp"))


@pytest.mark.parametrize("damage", ["truncate", "flip", "garbage", "empty"])
def test_damaged_entry_is_found_out_and_rebuilt(tmp_path, damage):
    build, calls = counting()
    cached(build, Body, Recipe(), tmp_path)
    path = entry_path(Recipe(), tmp_path)
    data = bytearray(path.read_bytes())
    if damage == "flip":
        at = data.find(np.float64(5.0).tobytes())
        data[at] ^= 0xFF
    path.write_bytes(
        {"truncate": data[: len(data) // 2], "flip": data, "garbage": b"x" * 99, "empty": b""}[
            damage
        ]
    )
    with pytest.warns(CacheWarning, match="damaged"):
        body = cached(build, Body, Recipe(), tmp_path)
    np.testing.assert_array_equal(body.matrix, np.arange(12.0).reshape(3, 4))
    assert len(calls) == 2
    cached(build, Body, Recipe(), tmp_path)
    assert len(calls) == 2


def test_unwritable_folder_is_said(tmp_path):
    build, _ = counting()
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    with pytest.warns(CacheWarning, match="cannot be written"):
        assert cached(build, Body, Recipe(), blocked / "cache").matrix.shape == (3, 4)
