"""XML of strangers: what is read, and what is refused with its line."""

import pytest

from station.core.errors import BadInput
from station.music.formats.safe_xml import MOST_DEPTH, MOST_NODES, XmlElement, parse_xml, root_name, text_of


def _parse(text: str | bytes) -> XmlElement:
    return parse_xml(text.encode() if isinstance(text, str) else text, "file.xml", ("song", "pattern"))


def test_elements_know_their_lines_and_lose_their_prefixes() -> None:
    root = _parse('<h:song xmlns:h="http://h">\n <h:name> Löwe </h:name>\n</h:song>')
    (name,) = root
    assert isinstance(name, XmlElement)
    assert (root.tag, name.tag, name.line, text_of(root, "name")) == ("song", "name", 2, "Löwe")
    assert text_of(root, "author", "nobody") == "nobody"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1", "windows-1252"])
def test_encodings_by_declaration_and_mark(encoding: str) -> None:
    text = f'<?xml version="1.0" encoding="{encoding.removesuffix("-sig")}"?><song>Grüße</song>'
    assert _parse(text.encode(encoding)).text == "Grüße"


def test_a_document_type_of_another_place_is_never_fetched() -> None:
    assert _parse('<!DOCTYPE song PUBLIC "-//X//EN" "http://127.0.0.1:1/song.dtd"><song/>').tag == "song"


@pytest.mark.parametrize(
    ("text", "place", "fault"),
    [
        ("", "line 1", "not XML"),
        ("<song>\n<name></song>", "line 2", "not XML: mismatched tag"),
        ("<song/><song/>", "line 1", "not XML"),
        ("<html/>", "line 1", "<html>"),
        ('<!DOCTYPE song [\n<!ENTITY a "aaaa">]><song>&a;</song>', "line 1", "rules of its own"),
        ('<!DOCTYPE song SYSTEM "x.dtd"><song>\n&a;</song>', "line 2", "&a;"),
        ("<song>&a;</song>", "line 1", "undefined entity"),
        ("<song>" * (MOST_DEPTH + 1), "line 1", "inside each other"),
        ("<song>" + "<a/>" * MOST_NODES, "line 1", "elements and attributes"),
        ('<?xml version="1.0" encoding="no-such-code"?><song/>', "line 1", "encoding"),
        ('<?xml version="1.0" encoding="shift_jis"?><song/>', "line 1", "encoding"),
    ],
)
def test_what_is_refused(text: str, place: str, fault: str) -> None:
    with pytest.raises(BadInput) as caught:
        _parse(text)
    assert (caught.value.source, caught.value.place) == ("file.xml", place)
    assert fault in caught.value.fault


def test_the_root_is_found_without_reading_on() -> None:
    assert root_name(b'\xef\xbb\xbf<?xml version="1.0"?><!-- a --><h:song><broken') == "song"
    assert root_name(b"PK\x03\x04") == root_name(b"") == ""
    assert root_name(b'<!DOCTYPE s [<!ENTITY a "b">]><s/>') == ""
