"""Labels of lines and letters of strokes in drum tablature; where tabs disagree, the usual meaning."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.core.pieces import (
    CLOSED,
    CYMBALS,
    HALF_OPEN,
    OPEN,
    TOMS,
    Articulation,
    Dynamic,
    Ornament,
    Piece,
    Zone,
)

CHOKE = "#"
RESTS = "-. _=–—"
"""A cell without a stroke, the dashes of word processors included."""


@dataclass(frozen=True, slots=True)
class LineMeaning:
    """What a label says: the piece, and how it is struck where the label says that too."""

    piece: Piece
    articulation: Articulation = Articulation.NORMAL
    zone: Zone | None = None
    openness: float | None = None


def _many(names: str, meaning: LineMeaning) -> dict[str, LineMeaning]:
    return dict.fromkeys(names.split(), meaning)


LABELS: Mapping[str, LineMeaning] = MappingProxyType(
    {
        **_many(
            "bd b kd k bs ba bdr bd1 bd2 b1 b2 k1 k2 kick1 kick2 bass bassdr bassdrum kick kickdr kickdrum",
            LineMeaning(Piece.KICK),
        ),
        **_many("sd s sn snr snare snaredr snaredrum", LineMeaning(Piece.SNARE)),
        **_many(
            "ss cs xs rs sr stick xstick sidestick crossstick rimclick",
            LineMeaning(Piece.SNARE, Articulation.CROSS_STICK),
        ),
        **_many("hh h hat hihat hc ch hhc chh closedhihat", LineMeaning(Piece.HIHAT)),
        **_many("ho oh hho ohh openhihat", LineMeaning(Piece.HIHAT, openness=OPEN)),
        **_many(
            "hf fh hp ph pf hhf hhp pedal foothihat hihatpedal hihatfoot hhpedal hhfoot hatfoot",
            LineMeaning(Piece.HIHAT_PEDAL),
        ),
        **_many("rd r ri rc rc1 rcy ride ridecymbal", LineMeaning(Piece.RIDE)),
        **_many("rb bell ridebell rdb", LineMeaning(Piece.RIDE, zone=Zone.BELL)),
        **_many("r2 ride2", LineMeaning(Piece.RIDE_2)),
        **_many("cc c cr cym c1 cr1 cy crash crash1 crashcymbal lc", LineMeaning(Piece.CRASH_1)),
        **_many("c2 cr2 cc2 crash2 rcr", LineMeaning(Piece.CRASH_2)),
        **_many("sp spl sc splash splashcymbal", LineMeaning(Piece.SPLASH)),
        **_many("cn chi chn china chinacymbal", LineMeaning(Piece.CHINA)),
        **_many("t1 t ht st tom tom1 tt1 ht1 hightom hitom smalltom racktom racktom1", LineMeaning(Piece.TOM_1)),
        **_many("t2 mt mid tom2 tt2 midtom middletom racktom2", LineMeaning(Piece.TOM_2)),
        **_many("t3 lt tom3 tt3 lowtom lotom racktom3", LineMeaning(Piece.TOM_3)),
        **_many("t4 tom4", LineMeaning(Piece.TOM_4)),
        **_many("ft f f1 ft1 floor floortom floortom1", LineMeaning(Piece.FLOOR_TOM_1)),
        **_many("f2 ft2 floor2 floortom2", LineMeaning(Piece.FLOOR_TOM_2)),
        **_many("cb cow cowbell", LineMeaning(Piece.COWBELL)),
        **_many("tb tam tamb tambourine", LineMeaning(Piece.TAMBOURINE)),
        **_many("cl hcl clap", LineMeaning(Piece.CLAP)),
        **_many("pc perc sh shaker", LineMeaning(Piece.PERCUSSION)),
    }
)
"""Meanings of labels, their letters small and all else taken out. One of `ch` is the closed hat, as machines label it;
tabs that mean a china by it strike it with `c`. One of `rc` is the ride cymbal, as most collections of tabs have it."""

OWN_LABELS: Mapping[Piece, str] = MappingProxyType(
    {
        Piece.CRASH_1: "C1",
        Piece.CRASH_2: "C2",
        Piece.SPLASH: "Sp",
        Piece.CHINA: "Cn",
        Piece.RIDE: "Rd",
        Piece.RIDE_2: "R2",
        Piece.HIHAT: "HH",
        Piece.COWBELL: "Cb",
        Piece.TAMBOURINE: "Tb",
        Piece.CLAP: "Cl",
        Piece.PERCUSSION: "Pc",
        Piece.TOM_1: "T1",
        Piece.TOM_2: "T2",
        Piece.TOM_3: "T3",
        Piece.TOM_4: "T4",
        Piece.SNARE: "SD",
        Piece.FLOOR_TOM_1: "FT",
        Piece.FLOOR_TOM_2: "F2",
        Piece.KICK: "BD",
        Piece.HIHAT_PEDAL: "Hf",
    }
)
"""What the station writes, from the top line to the lowest; `LABELS` reads each back."""


@dataclass(frozen=True, slots=True)
class TabStroke:
    """What a letter strikes; `piece` where a letter on a line of cymbals names another one."""

    zone: Zone
    articulation: Articulation = Articulation.NORMAL
    dynamic: Dynamic = Dynamic.NORMAL
    openness: float | None = None
    ornament: Ornament = Ornament.NONE
    piece: Piece | None = None


def _pair(small: str, large: str, stroke: TabStroke) -> dict[str, TabStroke]:
    loud = TabStroke(stroke.zone, stroke.articulation, Dynamic.ACCENT, stroke.openness, stroke.ornament, stroke.piece)
    return {small: stroke, large: loud}


def _plain(zone: Zone, letters: str) -> dict[str, TabStroke]:
    """Strokes of a plain piece; of two letters that mean the same the first is written."""
    return {
        **_pair(letters[0], letters[1], TabStroke(zone)),
        **_pair(letters[2], letters[3], TabStroke(zone)),
        "g": TabStroke(zone, dynamic=Dynamic.GHOST),
    }


_HEAD = Zone.HEAD
_DRUM = {
    **_plain(_HEAD, "oOxX"),
    **_pair("f", "F", TabStroke(_HEAD, ornament=Ornament.FLAM)),
    **_pair("d", "D", TabStroke(_HEAD, ornament=Ornament.DRAG)),
    **_pair("b", "B", TabStroke(_HEAD, Articulation.BUZZ, ornament=Ornament.ROLL)),
    **_pair("z", "Z", TabStroke(_HEAD, Articulation.BUZZ, ornament=Ornament.ROLL)),
}
_SNARE = {
    **_DRUM,
    **_pair("r", "R", TabStroke(Zone.RIM, Articulation.RIM_SHOT)),
    "@": TabStroke(Zone.RIM, Articulation.CROSS_STICK),
    "c": TabStroke(Zone.RIM, Articulation.CROSS_STICK),
}
_HAT = {
    **_pair("x", "X", TabStroke(Zone.BOW, openness=CLOSED)),
    **_pair("o", "O", TabStroke(Zone.BOW, openness=OPEN)),
    **_pair("h", "H", TabStroke(Zone.BOW, openness=HALF_OPEN)),
    "g": TabStroke(Zone.BOW, dynamic=Dynamic.GHOST, openness=CLOSED),
}
_PEDAL = {
    **_pair("x", "X", TabStroke(Zone.PEDAL, Articulation.CHICK, openness=CLOSED)),
    **_pair("o", "O", TabStroke(Zone.PEDAL, Articulation.SPLASH, openness=OPEN)),
    "g": TabStroke(Zone.PEDAL, Articulation.CHICK, Dynamic.GHOST, CLOSED),
}
_CRASH = {
    **_plain(Zone.EDGE, "xXoO"),
    "b": TabStroke(Zone.BELL),
    "s": TabStroke(Zone.EDGE, piece=Piece.SPLASH),
    "c": TabStroke(Zone.EDGE, piece=Piece.CHINA),
}
_RIDE = {
    **_plain(Zone.BOW, "xXoO"),
    **_pair("b", "B", TabStroke(Zone.BELL)),
    "c": TabStroke(Zone.EDGE, piece=Piece.CHINA),
    "s": TabStroke(Zone.EDGE, piece=Piece.SPLASH),
}

LETTERS: Mapping[Piece, Mapping[str, TabStroke]] = MappingProxyType(
    {
        **{piece: _plain(_HEAD, "xXoO") for piece in Piece},
        Piece.KICK: _plain(_HEAD, "oOxX"),
        **dict.fromkeys(TOMS, _DRUM),
        Piece.SNARE: _SNARE,
        Piece.HIHAT: _HAT,
        Piece.HIHAT_PEDAL: _PEDAL,
        **dict.fromkeys(CYMBALS, _CRASH),
        Piece.RIDE: _RIDE,
        Piece.RIDE_2: _RIDE,
    }
)
"""What each letter strikes on a line of each piece."""

TAB_CHARACTERS = frozenset("".join(letter for table in LETTERS.values() for letter in table)) | set(RESTS) | {CHOKE}


def label_key(label: str) -> str:
    """A label as `LABELS` has it."""
    return re.sub(r"[^a-z0-9]", "", label.lower())
