"""XML of strangers, read by expat with nothing in it that can reach out or grow.

Refused with their line: entities of the file's own and references to any but XML's five, a document type with rules
inside the file, and more depth or more elements than a piece of music has. The document type of another place
(MusicXML names one) is never fetched. Encodings are those that expat knows (UTF-8, UTF-16, Latin-1) and Python's
single-byte ones, as the declaration or the byte order mark says.
"""

from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from typing import Any
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from station.core.errors import BadInput

MOST_XML_BYTES = 16 << 20
"""Our choice: an orchestra's hour as MusicXML; formats of XML have it as their `most_bytes`."""
MOST_DEPTH = 64
"""Our choice: MusicXML, Hydrogen and Guitar Pro nest about twelve deep."""
MOST_NODES = 400_000
"""Elements and attributes, a few hundred bytes and a few microseconds each (our choice: 1,000 bars of drums)."""


class XmlElement(Element):
    """An element that knows the `line` of the file where it begins, from 1."""

    line: int = 0


def parse_xml(data: bytes, source: str, expected_roots: Collection[str]) -> XmlElement:
    """The root element of `data`, named one of `expected_roots`; names come without their prefix (`h:song` is `song`).

    Raises `BadInput` with the line of the first fault.
    """
    if len(data) > MOST_XML_BYTES:
        raise BadInput(source, "", f"is larger than {MOST_XML_BYTES >> 20} MiB")
    tree = _Tree(source, expected_roots)
    try:
        tree.parser.Parse(data, True)
    except expat.ExpatError as fault:
        raise BadInput(source, f"line {fault.lineno}", f"not XML: {expat.ErrorString(fault.code)}") from fault
    except (ValueError, LookupError) as fault:  # an encoding that Python does not know, or not by single bytes
        raise BadInput(source, "line 1", f"no known encoding: {fault}") from fault
    return tree.root


def root_name(data: bytes) -> str:
    """The name of the root element without its prefix, "" where `data` does not begin as XML does."""
    found: list[str] = []

    def begin(name: str, _attributes: Mapping[str, str]) -> None:
        found.append(_local(name))
        raise _Found

    parser = _parser(begin, _refuse)
    with suppress(_Found, BadInput, expat.ExpatError, ValueError, LookupError):
        parser.Parse(data[:MOST_XML_BYTES], False)
    return found[0] if found else ""


def text_of(element: Element, path: str, default: str = "") -> str:
    """The text of the first child at `path` without the space around it, `default` where there is none."""
    return (element.findtext(path) or default).strip()


class _Found(Exception):
    """The root has begun: no need to read on."""


class _Tree:
    """Builds the elements as the parser meets them, within the limits."""

    def __init__(self, source: str, expected_roots: Collection[str]) -> None:
        self._source, self._expected = source, expected_roots
        self._depth = self._nodes = 0
        self._builder = TreeBuilder(element_factory=XmlElement)
        self.parser = _parser(self._begin, self._refuse)
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._builder.data

    @property
    def root(self) -> XmlElement:
        root = self._builder.close()
        assert isinstance(root, XmlElement), "made by the factory"
        return root

    def _refuse(self, fault: str) -> None:
        raise BadInput(self._source, f"line {self.parser.CurrentLineNumber}", fault)

    def _begin(self, name: str, attributes: dict[str, str]) -> None:
        tag = _local(name)
        if not self._depth and tag not in self._expected:
            self._refuse(f"the file's root is <{tag[:40]}>; expected {' or '.join(f'<{r}>' for r in self._expected)}")
        self._depth += 1
        self._nodes += 1 + len(attributes)
        if self._depth > MOST_DEPTH:
            self._refuse(f"more than {MOST_DEPTH} elements inside each other")
        if self._nodes > MOST_NODES:
            self._refuse(f"more than {MOST_NODES:,} elements and attributes")
        element = self._builder.start(tag, attributes)
        assert isinstance(element, XmlElement), "made by the factory"
        element.line = self.parser.CurrentLineNumber

    def _end(self, name: str) -> None:
        self._depth -= 1
        self._builder.end(_local(name))


def _refuse(fault: str) -> None:
    raise BadInput("", "", fault)


def _parser(begin: Callable[[str, Any], None], refuse: Callable[[str], None]) -> expat.XMLParserType:
    parser = expat.ParserCreate()
    parser.buffer_text = True
    parser.StartElementHandler = begin
    parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)

    def doctype(_name: str, _system: str | None, _public: str | None, has_rules: object) -> int:
        if has_rules:
            refuse("a document type with rules of its own, which music needs none of")
        return 0

    def external(*_: object) -> int:
        refuse("refers to another file")
        return 0

    parser.StartDoctypeDeclHandler = doctype
    parser.EntityDeclHandler = lambda *_: refuse("declares an entity, which music needs none of")
    parser.SkippedEntityHandler = lambda name, _: refuse(f"the entity &{name[:40]}; is not XML's own")
    parser.ExternalEntityRefHandler = external
    return parser


def _local(name: str) -> str:
    return name.rpartition(":")[2] if ":" in name else name
