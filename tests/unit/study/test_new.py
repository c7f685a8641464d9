"""Study files to start from: they mean what the study means that they are made from."""

import pytest

from contactstudy import cli
from contactstudy.exceptions import InputError
from contactstudy.study.loading import load_study
from contactstudy.study.new import new_study, write_new


def alike(a, b):
    """Whether plain data is equal, numbers to the six digits that are written."""
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(alike(a[k], b[k]) for k in a)
    if isinstance(a, list) and a and isinstance(a[0], float):
        return a == pytest.approx(b, rel=1e-5)
    return a == pytest.approx(b, rel=1e-5) if isinstance(a, float) else a == b


def resolved(text, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(text, "utf-8")
    study = load_study(path)
    return study.config(), study.title, study.description, study.companions


@pytest.mark.parametrize(
    "name",
    ["point_vs_surface", "ladder", "trust_map", "manchester", "dipped_joint", "error_study"],
)
def test_it_is_the_study_again(name, tmp_path):
    made, given = load_study(write(name, tmp_path)), load_study(name)
    assert made.config() == given.config()
    assert (made.title, made.description) == (given.title, given.description)
    assert made.companions == given.companions
    for design in getattr(given, "designs", ()):
        assert design in made.designs


def write(name, tmp_path):
    path = tmp_path / "mine.toml"
    write_new(path, name)
    return path


@pytest.mark.parametrize("name", ["point_vs_surface", "manchester"])
def test_every_line_that_is_not_set_states_what_holds(name, tmp_path):
    """Each by itself: without its mark the study is the same."""
    lines = new_study(name).splitlines()
    expected = resolved("\n".join(lines), tmp_path)
    tables = [k for k, line in enumerate(lines) if line.startswith("# Keys of any table")]
    stated = [
        k
        for k, line in enumerate(lines[: tables[0] if tables else None])
        if line.startswith("# ") and " = " in line and " = ..." not in line and k > 5
    ]
    assert len(stated) > (10 if name == "point_vs_surface" else 0)
    for k in stated:
        if lines[k].split()[1] in ("file", "rail", "wheel") and ' = ""' in lines[k]:
            continue  # no file is no name of a file
        changed = [*lines[:k], lines[k].removeprefix("# "), *lines[k + 1 :]]
        try:
            found = resolved("\n".join(changed), tmp_path)
        except InputError as error:  # a whole table may mean nothing here
            assert "applies only with" in str(error), lines[k]
        else:
            assert alike(found[0], expected[0]), lines[k]


def test_what_is_there_is_kept(tmp_path, capfd):
    path = tmp_path / "mine.toml"
    assert cli.main(["new", str(path)]) == 0
    text = path.read_text("utf-8")
    assert cli.main(["new", str(path)]) == 2
    assert "is there already" in capfd.readouterr().err
    assert path.read_text("utf-8") == text
    with pytest.raises(InputError, match=r'ends in "\.toml"'):
        write_new(tmp_path / "mine.txt", "ladder")
    with pytest.raises(InputError, match="did you mean 'ladder'"):
        write_new(tmp_path / "other.toml", "lader")
    assert [p.name for p in tmp_path.iterdir()] == ["mine.toml"]
