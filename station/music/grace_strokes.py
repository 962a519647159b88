"""The grace strokes of flams and drags, which are rows of a score like any other.

A grace stroke stands on the tick of its main stroke, sounds `lead_ms` before it, is a ghost stroke of the other hand,
and has the ornament of its main stroke. Diddles and open rolls have no grace strokes: they are rows at ticks of their
own, with the ornament DIDDLE, or ROLL where several follow each other.
"""

from dataclasses import dataclass, replace

from station.core.pieces import OTHER_HAND, Dynamic, Limb, Ornament
from station.music.score import Note

MIN_VELOCITY, MAX_VELOCITY = 1, 127
"""MIDI 1.0: 0 would be a note off."""

FLAM_RANGE_MS, DRAG_RANGE_MS = (10, 80), (20, 120)
"""The spacings that a lesson may say (wider than HUMANS: a teacher may ask for an open flam; our choice)."""


@dataclass(frozen=True, slots=True)
class Graces:
    """The grace strokes of flams and drags: spacings in ms, whatever the tempo, and their share of the velocity.

    `flam_ms` before its note sounds a flam's grace stroke (the middle of 15–40 ms); `drag_ms` apart are a drag's three
    strokes (the middle of 40–70 ms); `share` of its note's velocity has each (25–50 %). Source: HUMANS, Timing.
    """

    flam_ms: float = 30.0
    drag_ms: float = 55.0
    share: float = 0.4

    def leads_ms(self, ornament: Ornament) -> tuple[float, ...]:
        """How long before its note each grace stroke sounds, the first first; none for what has none."""
        if ornament is Ornament.FLAM:
            return (self.flam_ms,)
        return (2 * self.drag_ms, self.drag_ms) if ornament is Ornament.DRAG else ()

    def velocity(self, main: int) -> int:
        """Velocity 1–127 of a grace stroke before a note of velocity `main`."""
        return max(MIN_VELOCITY, round(main * self.share))


_USUAL = Graces()


def with_graces(note: Note, graces: Graces = _USUAL) -> list[Note]:
    """The grace strokes that the `ornament` of `note` asks for, the first first, then the note itself."""
    found = [
        replace(
            note,
            velocity=graces.velocity(note.velocity),
            dynamic=Dynamic.GHOST,
            lead_ms=lead,
            limb=OTHER_HAND.get(note.limb, Limb.UNKNOWN),
            midi_note=0,
            choke_ticks=0,
            duration_ticks=0,
        )
        for lead in graces.leads_ms(note.ornament)
    ]
    return [*found, note]
