"""Compressed MusicXML (.mxl): a zip file whose META-INF/container.xml names the score.

Source: the MusicXML 4.0 reference, "Compressed MusicXML files": `mimetype` first, and not packed.
"""

import io
import zipfile

from station.core.errors import BadInput
from station.music.formats.safe_xml import MOST_XML_BYTES, parse_xml
from station.music.formats.safe_zip import is_zip, zip_member, zip_names

_CONTAINER = "META-INF/container.xml"
_MUSIC = "application/vnd.recordare.musicxml+xml"
_MOST_CONTAINER_BYTES = 1 << 16
_KIND = "application/vnd.recordare.musicxml"
_SCORE = "score.musicxml"
_WRITTEN_CONTAINER = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    f'<container>\n  <rootfiles>\n    <rootfile full-path="{_SCORE}" media-type="{_MUSIC}" />\n'
    "  </rootfiles>\n</container>\n"
)


def packed_score(text: bytes) -> bytes:
    """The XML of a score as an `.mxl`; the same text gives the same bytes, for members have no times."""
    members = (
        ("mimetype", _KIND.encode(), zipfile.ZIP_STORED),
        (_CONTAINER, _WRITTEN_CONTAINER.encode(), zipfile.ZIP_DEFLATED),
        (_SCORE, text, zipfile.ZIP_DEFLATED),
    )
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        for name, content, packing in members:
            archive.writestr(zipfile.ZipInfo(name), content, packing)
    return data.getvalue()


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
