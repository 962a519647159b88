"""Compressed MusicXML (.mxl): a zip file whose META-INF/container.xml names the score."""

from station.core.errors import BadInput
from station.music.formats.safe_xml import MOST_XML_BYTES, parse_xml
from station.music.formats.safe_zip import is_zip, zip_member, zip_names

_CONTAINER = "META-INF/container.xml"
_MUSIC = "application/vnd.recordare.musicxml+xml"
_MOST_CONTAINER_BYTES = 1 << 16


def score_text(data: bytes, source: str) -> bytes:
    """The XML of the score, unpacked if it is packed; raises `BadInput`."""
    if not is_zip(data):
        return data
    return zip_member(data, source, _root_file(data, source), MOST_XML_BYTES)


def _root_file(data: bytes, source: str) -> str:
    """The first root file of music that the container names."""
    if _CONTAINER not in zip_names(data, source):
        raise BadInput(source, "", f"no compressed MusicXML: the zip file has no {_CONTAINER}")
    container = parse_xml(zip_member(data, source, _CONTAINER, _MOST_CONTAINER_BYTES), source, ("container",))
    for root_file in container.iter("rootfile"):
        if root_file.get("media-type", _MUSIC) in (_MUSIC, "text/xml", "application/xml"):
            return root_file.get("full-path", "")
    raise BadInput(source, _CONTAINER, "names no score")
