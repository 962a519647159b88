"""Rushed, dragged or on? What a student believes of the own playing, asked before the result says it.

Who first judges the own error learns more of the same feedback (docs/sources.md), so the question comes before the
page: only after a session that was played to its end to a click, and once a lesson until the program ends. In the
window it is answered with a pad, a key or the mouse; left of the snare is ahead of the time, right of it behind. In the
terminal, where the kit is no longer heard then, with a letter. Pure: a report in, sentences out.
"""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from station.core.pieces import Piece

ON_TIME_MS = 10.0
"""Full marks within 10 ms (HUMANS, Velocity and ears): nearer to the click nobody rushes or drags."""

LEAST_STROKES = 16
"""Fewer strokes have no tendency worth a question (our choice: two bars of eighths)."""

QUESTION = "Before you look: rushed, on, or dragged?"
TYPED_QUESTION = "Before you look: did you rush (r), drag (d), or were you on (o)? Enter alone: no answer. "


class SelfEstimate(StrEnum):
    """What a student believes."""

    RUSHED = "rushed"
    ON = "on"
    DRAGGED = "dragged"


PADS_OF: Mapping[SelfEstimate, frozenset[Piece]] = MappingProxyType(
    {
        SelfEstimate.RUSHED: frozenset({Piece.HIHAT}),
        SelfEstimate.ON: frozenset({Piece.SNARE}),
        SelfEstimate.DRAGGED: frozenset({Piece.RIDE, Piece.FLOOR_TOM_1}),
    }
)
"""The pads that answer, from left to right as on the kit."""


def typed_guess(line: str) -> SelfEstimate | None:
    """What a line that was typed means: the letter or the word; None for anything else."""
    said = line.strip().lower()
    return next((guess for guess in SelfEstimate if said and guess.value.startswith(said)), None)


def is_worth_asking(document: Mapping[str, object]) -> bool:
    """Whether the report of a session can answer: played to the end, to a click, and enough of it."""
    session, timing = document["session"], document["timing"]
    assert isinstance(session, dict), "the report is ours"
    assert isinstance(timing, dict), "the report is ours"
    strokes = timing["strokes"]
    assert isinstance(strokes, int), "the report is ours"
    return bool(session["complete"] and session["click"]) and strokes >= LEAST_STROKES


def answered(guess: SelfEstimate, document: Mapping[str, object]) -> str:
    """What the student believed beside what was measured, in one sentence."""
    timing = document["timing"]
    assert isinstance(timing, dict), "the report is ours"
    mean_ms = timing["mean_signed_asynchrony_ms"]
    assert isinstance(mean_ms, float | int), "only asked where there is one"
    was = (
        SelfEstimate.ON if abs(mean_ms) <= ON_TIME_MS else SelfEstimate.RUSHED if mean_ms < 0 else SelfEstimate.DRAGGED
    )
    heard = "on the click" if was is SelfEstimate.ON else f"{abs(mean_ms):.0f} ms {'early' if mean_ms < 0 else 'late'}"
    return f"You said {guess}, and you were {heard} on average{': your ear is right' if guess is was else ''}."
