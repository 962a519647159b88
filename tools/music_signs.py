"""Cuts the musical signs that the notation uses out of Bravura into `station/render/text/music_signs.ttf`.

    python tools/music_signs.py bravura.otf

Needs fonttools (a tool, no dependency of the program) and Bravura 1.392, the reference font of the Standard Music Font
Layout (SMuFL). Its cubic outlines become the quadratic ones of TrueType, which `truetype` reads, off by at most
`_ERROR` of an em. Bravura's licence, the SIL Open Font License 1.1, keeps its name for the original, so the cut bears
another; the licence lies beside it.
"""

import sys
from pathlib import Path

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.cu2quPen import Cu2QuPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont

from station.render.text.sign_outlines import FONT_FILE, SIGNS

_NAME = "Station Music Signs"
_ERROR = 0.0005
"""Of an em: two thousandths of a staff space, far below what a printer shows."""


def main(source: Path) -> None:
    """Write the cut of the font at `source`."""
    font = TTFont(source)
    units, names, glyphs = font["head"].unitsPerEm, font.getBestCmap(), font.getGlyphSet()
    codes = sorted({sign.code for sign in SIGNS.values()})
    outlines, widths = {".notdef": TTGlyphPen(None).glyph()}, {".notdef": (units // 2, 0)}
    for code in codes:
        pen, glyph = TTGlyphPen(None), glyphs[names[code]]
        glyph.draw(Cu2QuPen(pen, _ERROR * units, reverse_direction=True))
        outlines[f"uni{code:04X}"], widths[f"uni{code:04X}"] = pen.glyph(), (round(glyph.width), 0)
    cut = FontBuilder(units, isTTF=True)
    cut.setupGlyphOrder(list(outlines))
    cut.setupCharacterMap({code: f"uni{code:04X}" for code in codes})
    cut.setupGlyf(outlines)
    cut.setupHorizontalMetrics(widths)
    cut.setupHorizontalHeader(ascent=2 * units, descent=-2 * units)
    cut.setupNameTable(
        {
            "copyright": str(font["name"].getDebugName(0)),
            "familyName": _NAME,
            "styleName": "Regular",
            "licenseDescription": "SIL Open Font License, Version 1.1",
            "licenseInfoURL": "https://openfontlicense.org",
        }
    )
    cut.setupOS2()
    cut.setupPost(keepGlyphNames=False)
    cut.font["head"].created = cut.font["head"].modified = 0  # the same file whenever it is cut
    cut.font.recalcTimestamp = False
    cut.save(FONT_FILE)
    sys.stdout.write(f"{FONT_FILE}: {len(codes)} signs, {FONT_FILE.stat().st_size} bytes\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
