"""Feel, described and not scolded: how each piece leans, the swing that is held, fills against the groove.

A stable lean of a piece up to `points.FREE_LEAN_MS` and a swing ratio within `points.FREE_SWING` cost nothing unless
the lesson asks for less. Leans are those of `habits`, with everything else that can be told apart taken out.
"""

from dataclasses import dataclass

from station.core.pieces import Piece, word
from station.music import passages
from station.music.score import Score
from station.scoring.analysis.habits import Habits
from station.scoring.analysis.points import Feel, free_ms, ratio_of_place
from station.scoring.analysis.technique.estimates import Estimate, difference, figure
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment


@dataclass(frozen=True, slots=True)
class Lean:
    """A piece's lean against the others in ms, negative is ahead; `free`: it costs nothing."""

    piece: Piece
    lean_ms: float
    ci: tuple[float, float]
    free: bool


@dataclass(frozen=True, slots=True)
class HeldSwing:
    """The ratio that is written and the one that is held, long to short; `sd_ms` of the offbeats about the held one."""

    written: float
    held: float
    ci: tuple[float, float]
    sd_ms: float | None
    free: bool


@dataclass(frozen=True, slots=True)
class Fills:
    """Asynchrony in `fills` and in the `groove`, in ms; `apart_ms` fills less groove, negative is rushed."""

    fills: Estimate
    groove: Estimate
    apart_ms: float | None
    ci: tuple[float, float] | None


def fills_against_groove(score: Score, alignment: Alignment) -> Fills | None:
    """How far fills are played ahead of or behind the groove; None of a score without fills."""
    fills, timed = passages.fills(score), timed_notes(score, alignment)
    if not fills.any():
        return None
    off, ticks = asynchrony_ms(alignment), score.notes["tick"]
    one, other = (figure(off[here], ticks[here]) for here in (timed & fills, timed & ~fills))
    apart = None if one.mean is None or other.mean is None else one.mean - other.mean
    return Fills(one, other, apart, difference(one, other))


def leans(found: Habits, feel: Feel) -> tuple[Lean, ...]:
    """How each piece leans, of which enough is known."""
    names = {word(piece): piece for piece in Piece}
    known = [(names[name], effect) for name, effect in found.effects.items() if name in names]
    return tuple(
        Lean(piece, effect.value, effect.ci, abs(effect.value) <= feel.lean_ms)
        for piece, effect in known
        if effect.slots > _FEWEST
    )


def swing(score: Score, alignment: Alignment, found: Habits, feel: Feel) -> HeldSwing | None:
    """The swing that is held; None where none is written or too little was played."""
    swung = passages.swung(score)
    effect = found.effects.get("swing")
    if effect is None or effect.slots <= _FEWEST or not swung.flags.any():
        return None
    written = swung.written_place
    low, high = effect.ci
    held = ratio_of_place(written + effect.value)
    counted = swung.flags & timed_notes(score, alignment)
    off = (asynchrony_ms(alignment) - free_ms(score, alignment, feel))[counted]
    sd_ms = float(off.std(ddof=1)) if len(off) > 1 else None
    ends = (ratio_of_place(written + low), ratio_of_place(written + high))
    return HeldSwing(ratio_of_place(written), held, ends, sd_ms, feel.allows(held, ratio_of_place(written)))


_FEWEST = 3
"""Slots: fewer have no interval."""
