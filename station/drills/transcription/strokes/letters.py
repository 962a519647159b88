"""Each stroke as the letter nearest to it plays it: what a lesson has no letter for becomes what sounds most alike."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from types import MappingProxyType

from station.core.pieces import TOMS, USUAL_FEET, Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.drills.grid.tab_symbols import SYMBOLS, TabFamily, TabSymbol, family_of
from station.music.score import Note


def as_letter(note: Note) -> Note:
    """The main stroke `note` as the letter nearest to it plays it, with a limb that can."""
    ornament = Ornament.ROLL if note.articulation is Articulation.BUZZ else note.ornament
    meaning = TabSymbol(note.zone, note.articulation, note.dynamic, note.openness, ornament)
    letter = nearest_letter(family_of(note.piece), meaning)
    return replace(
        note,
        zone=letter.zone,
        articulation=letter.articulation,
        dynamic=letter.dynamic,
        openness=letter.openness,
        ornament=letter.ornament,
        limb=_able(note),
        duration_ticks=note.duration_ticks if letter.articulation is Articulation.BUZZ else 0,
        choke_ticks=note.choke_ticks if family_of(note.piece) in (TabFamily.RIDE, TabFamily.CRASH) else 0,
        midi_note=0,
    )


@lru_cache(maxsize=4096)
def nearest_letter(family: TabFamily, meaning: TabSymbol) -> TabSymbol:
    """The letter of the family that differs least from what is meant.

    What counts most comes first: articulation, a bell or a rim, ornament, openness, dynamic, edge or bow.
    """
    openness = meaning.openness or 0.0

    def distance(letter: TabSymbol) -> tuple[bool, bool, bool, float, int, bool]:
        return (
            letter.articulation is not meaning.articulation,
            _SOUND_OF.get(letter.zone, letter.zone) is not _SOUND_OF.get(meaning.zone, meaning.zone),
            letter.ornament is not meaning.ornament,
            abs((letter.openness or 0.0) - openness),
            abs(letter.dynamic - meaning.dynamic),
            letter.zone is not meaning.zone,
        )

    return min(SYMBOLS[family].values(), key=distance)


_SOUND_OF = MappingProxyType({Zone.EDGE: Zone.BOW})
"""Zones that sound so much alike that a ghost stroke matters more."""


_VARIANTS: Mapping[Piece, frozenset[tuple[Zone, Articulation]]] = MappingProxyType(
    {
        **dict.fromkeys(
            (Piece.RIDE, Piece.RIDE_2),
            frozenset({(Zone.BOW, Articulation.NORMAL), (Zone.EDGE, Articulation.NORMAL)}),
        ),
        **dict.fromkeys(
            (Piece.SNARE, *TOMS), frozenset({(Zone.HEAD, Articulation.NORMAL), (Zone.RIM, Articulation.RIM_SHOT)})
        ),
    }
)
"""Two ways to strike a piece that pads tell apart by where the stick happens to land."""


def unified(notes: Sequence[Note]) -> list[Note]:
    """Of a take, strokes of one piece and dynamic that `_VARIANTS` tells apart, all as most of them are.

    A player who keeps time on the ride meets its edge now and then; nobody means that, and nobody writes it. On the
    hi-hat most players strike the edge, at least for accents, and all write it as they do the bow.
    """
    notes = [_on_the_bow(n) for n in notes]
    counts: dict[tuple[Piece, Dynamic], Counter[tuple[Zone, Articulation]]] = {}
    for note in notes:
        if _is_variant(note):
            ways = counts.setdefault((note.piece, note.dynamic), Counter())
            ways[note.zone, note.articulation] += 1
    return [_as_most(n, counts[n.piece, n.dynamic]) if _is_variant(n) else n for n in notes]


def _on_the_bow(note: Note) -> Note:
    return replace(note, zone=Zone.BOW) if (note.piece, note.zone) == (Piece.HIHAT, Zone.EDGE) else note


def _is_variant(note: Note) -> bool:
    return note.ornament is Ornament.NONE and (note.zone, note.articulation) in _VARIANTS.get(note.piece, ())


def _as_most(note: Note, ways: Counter[tuple[Zone, Articulation]]) -> Note:
    zone, articulation = ways.most_common(1)[0][0]
    return replace(note, zone=zone, articulation=articulation)


def _able(note: Note) -> Limb:
    """The note's limb if it can play that piece, else who does by custom."""
    if note.piece in USUAL_FEET:
        return USUAL_FEET[note.piece] if note.limb is Limb.UNKNOWN or note.limb.is_hand else note.limb
    return note.limb if note.limb.is_hand else Limb.UNKNOWN
