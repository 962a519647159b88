"""Bytes that are no text are refused where they stand, whatever goes before them."""

import codecs

import pytest

from station.core.toml.toml_source import source_of


def test_a_byte_that_is_no_text_behind_a_mark_and_other_letters() -> None:
    data = codecs.BOM_UTF8 + "title = 'é'\nabout = 'ü".encode() + b"\xff'\n"
    source = source_of(data, "x.toml")
    assert not source.raw
    assert "not UTF-8" in str(source)
    assert source.text == "title = 'é'\nabout = 'ü"


@pytest.mark.parametrize("behind", ["eighths", " # so many", " 5", "]", ".", "_", ""])
def test_a_number_without_end_is_told_whatever_stands_behind_it(behind: str) -> None:
    """`tomllib` reads the digits as a number before it looks at what follows; a fraction of as many is no fault."""
    text = f"fraction = {'1' * 5000}.5\nwhole = {'9' * 5000}{behind}\n"
    ((line, column, words), *_) = source_of(text.encode(), "x.toml").syntax
    assert (line, column) == (2, 9)
    assert "5000 digits" in words
