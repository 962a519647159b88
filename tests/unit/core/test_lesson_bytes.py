"""Bytes that are no text are refused where they stand, whatever goes before them."""

import codecs

from station.core.toml.toml_source import source_of


def test_a_byte_that_is_no_text_behind_a_mark_and_other_letters() -> None:
    data = codecs.BOM_UTF8 + "title = 'é'\nabout = 'ü".encode() + b"\xff'\n"
    source = source_of(data, "x.toml")
    assert not source.raw
    assert "not UTF-8" in str(source)
    assert source.text == "title = 'é'\nabout = 'ü"
