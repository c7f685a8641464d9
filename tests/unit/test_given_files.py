"""Whatever a user names as a file ends in its text or in one sentence (seeded, in seconds)."""

import codecs
import os

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.exceptions import InputError
from contactstudy.given_files import file_content, file_text, is_file, toml_file
from contactstudy.study.loading import load_study
from contactstudy.units import UnitError, to_si

TEXT = 'title = "Pad µ 垫"\n\n[irregularity]\nseed = 3\n'


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32"]
)
def test_encodings_that_a_mark_tells(tmp_path, encoding, newline):
    file = tmp_path / "study.toml"
    marks = {"utf-16-le": codecs.BOM_UTF16_LE, "utf-16-be": codecs.BOM_UTF16_BE}
    file.write_bytes(marks.get(encoding, b"") + TEXT.replace("\n", newline).encode(encoding))
    assert file_text(file) == TEXT
    assert toml_file(file)["title"] == "Pad µ 垫"
    assert load_study(file).title == "Pad µ 垫"


@pytest.mark.parametrize(
    "content", [TEXT.replace("µ", "").encode("gbk"), TEXT.encode("utf-16-le"), b"\x89PNG\x00"]
)
def test_what_is_no_text(tmp_path, content):
    file = tmp_path / "study.toml"
    file.write_bytes(content)
    with pytest.raises(InputError, match=r"study\.toml: this is not a TOML file"):
        load_study(file)
    assert file_text(file, fallback="latin-1") if b"\0" not in content else True


def test_names_that_no_file_has(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "large.toml").write_bytes(b"")
    os.truncate(tmp_path / "large.toml", 2**33)  # a hole, no bytes on the disk
    for name, reason in (
        ("none.toml", "there is no such file"),
        ("x" * 300 + ".toml", "its name is too long"),
        ("a\0b.toml", "a zero byte in the name"),
        ("pipe.toml", "a device or pipe"),
        ("", "it is a folder"),
        ("large.toml", "8192 MiB large; allowed: up to 256 MiB"),
    ):
        with pytest.raises(InputError, match=reason) as found:
            file_text(str(tmp_path / name))
        assert len(str(found.value)) < 500
        if name != "large.toml":
            assert not is_file(str(tmp_path / name))
            with pytest.raises(InputError):
                load_study(str(tmp_path / name))
    with pytest.raises(InputError, match="device or pipe"):
        file_content("/dev/zero")


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("[" * 5000 + "]" * 5000, "nested too deep"),
        ("[" * 50 + "]" * 50, "nested too deep; allowed: 20 levels"),
        ("9" * 5000, "a number with too many digits"),
        ("0x" + "f" * 6000, "track.length = a number of thousands of digits: must be"),
        ("9" * 400, "must be finite"),
        ('"' + "a" * 10**5 + '"', "must be"),
        ("1e999", "must be finite"),
    ],
    ids=range(7),
)
def test_numbers_and_nesting_beyond_bounds(tmp_path, value, reason):
    file = tmp_path / "study.toml"
    file.write_text(f"[track]\nlength = {value}\n", "utf-8")
    with pytest.raises(InputError, match=reason) as found:
        load_study(file)
    assert len(str(found.value)) < 2000
    with pytest.raises(InputError) as found:
        load_study("smooth_rail", [f"track.length={value}"])


@pytest.mark.parametrize(
    "text",
    ["36 m^9^9^9", "36 m**9**9**9", "36 m^(9^9)", "2 (m^9)^9", "3 m^99", "1 9^9^9 m", "3 m^1.5",
     "1e9 m^-9^-9", "1 (((((m)))))))" + ")" * 9999, "٣ m", "１２ m", "1 m" + " m" * 9999],
    ids=range(12),
)  # fmt: skip
def test_quantities_compute_nothing(text):
    with pytest.raises(UnitError):
        to_si(text, "m")


to_si("1 inch", "m")  # the first such text loads pint, which the deadline is not about


@settings(max_examples=300, deadline=2000)
@given(st.text("0123456789.eE+-*/^() mskNµ·_%", max_size=60), st.sampled_from(["m", "N/m", ""]))
def test_any_text_is_a_quantity_or_refused_at_once(text, unit):
    try:
        assert isinstance(to_si(text, unit), float)
    except UnitError as error:
        assert str(error)
