"""Each stroke as the letter nearest to it plays it: what a lesson has no letter for becomes what sounds most alike."""

from dataclasses import replace
from types import MappingProxyType

from station.core.pieces import Articulation, Limb, Ornament, Zone
from station.drills.grid.tab_symbols import FOOT_OF, SYMBOLS, TabFamily, TabSymbol, family_of
from station.music.score import Note


def as_letter(note: Note) -> Note:
    """The main stroke `note` as the letter nearest to it plays it, with a limb that can."""
    is_buzz = note.articulation is Articulation.BUZZ
    letter = nearest_letter(replace(note, ornament=Ornament.ROLL if is_buzz else note.ornament))
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


def nearest_letter(note: Note) -> TabSymbol:
    """The letter of the note's piece that differs least.

    What counts most comes first: articulation, a bell or a rim, ornament, openness, dynamic, edge or bow.
    """
    openness = note.openness or 0.0

    def distance(letter: TabSymbol) -> tuple[bool, bool, bool, float, int, bool]:
        return (
            letter.articulation is not note.articulation,
            _SOUND_OF.get(letter.zone, letter.zone) is not _SOUND_OF.get(note.zone, note.zone),
            letter.ornament is not note.ornament,
            abs((letter.openness or 0.0) - openness),
            abs(letter.dynamic - note.dynamic),
            letter.zone is not note.zone,
        )

    return min(SYMBOLS[family_of(note.piece)].values(), key=distance)


_SOUND_OF = MappingProxyType({Zone.EDGE: Zone.BOW})
"""Zones that sound so much alike that a ghost stroke matters more."""


def _able(note: Note) -> Limb:
    """The note's limb if it can play that piece, else who does by custom."""
    if note.piece in FOOT_OF:
        return FOOT_OF[note.piece] if note.limb is Limb.UNKNOWN or note.limb.is_hand else note.limb
    return note.limb if note.limb.is_hand else Limb.UNKNOWN
