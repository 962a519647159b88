"""Whether two hands and two feet can play what is written.

Judged by the moments at which strokes sound, grace strokes included, at the tempo given. A limb's speed is bounded by
spans: so many strokes of one limb need at least so long. Two hands that share a passage in any way can play at most
2n − 1 strokes in less than the time that one hand needs for n.

What is too fast is asked at slower speeds, too: the fastest that will do is told, as a share of the speed given. Grace
strokes keep their milliseconds at every speed, so the share is no mere quotient; bisection finds it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from station.core.labels import limb_name
from station.core.pieces import HALF_OPEN, HAND_PIECES, Articulation, Limb, Ornament, Piece, word
from station.music.score import Score

HAND_SPANS_S: Mapping[int, float] = {2: 0.045, 3: 0.13, 4: 0.20, 9: 0.62}
"""Strokes of one hand -> the least time from first to last. The second bounce of a double comes after 50–90 ms, a
champion's single strokes at 10 Hz (HUMANS, Heights); fast double rolls keep each hand at 12.5 Hz. Our choice within."""
FOOT_SPANS_S: Mapping[int, float] = {2: 0.07, 9: 0.72}
"""The same for a foot: champions reach 11 Hz (HUMANS, Heights); the doubles of the Groove MIDI Dataset's drummers come
down to 75 ms, and what is closer there looks like a bouncing beater. Our choice."""
_SPANS_S: Mapping[Limb, Mapping[int, float]] = {
    Limb.RIGHT_HAND: HAND_SPANS_S,
    Limb.LEFT_HAND: HAND_SPANS_S,
    Limb.RIGHT_FOOT: FOOT_SPANS_S,
    Limb.LEFT_FOOT: FOOT_SPANS_S,
}

MAX_HANDS = 2
_HANDS_STRIKE = np.array(sorted(HAND_PIECES), np.uint8)


@dataclass(frozen=True, slots=True)
class Impossible:
    """Row `note` of the score cannot be played; `text` says why.

    `too_fast_for` is who would have to be quicker than people are, such as "the right hand", and `playable_at` the
    largest share of the score's speed at which they could play all that is theirs, below 1. Both are left out where
    no speed mends it.
    """

    note: int
    text: str
    too_fast_for: str = ""
    playable_at: float | None = None


def impossible(score: Score) -> list[Impossible]:
    """All that no drummer can do in `score`, at its own tempo, in the order of its rows."""
    found = [*_crowded_moments(score), *_open_and_shut(score)]
    named = {i.note for i in found}
    found += [i for i in _too_fast(score) if i.note not in named]
    return sorted(found, key=lambda i: i.note)


def _is_hand(notes: NDArray[np.void]) -> NDArray[np.bool_]:
    by_foot = notes["limb"] >= Limb.RIGHT_FOOT
    return np.isin(notes["piece"], _HANDS_STRIKE) & ~by_foot


def _crowded_moments(score: Score) -> list[Impossible]:
    """Moments that ask for three hands, or for one limb in two places."""
    found: list[Impossible] = []
    notes = score.notes
    ticks, limbs = notes["tick"].tolist(), notes["limb"].tolist()
    is_hand = _is_hand(notes).tolist()
    graced = np.isin(notes["ornament"], (Ornament.FLAM, Ornament.DRAG)).tolist()
    for _, group in groupby(np.flatnonzero(~score.is_grace).tolist(), key=ticks.__getitem__):
        rows = list(group)
        hands = [i for i in rows if is_hand[i]]
        needed = len(hands) + sum(graced[i] for i in hands)
        if needed > MAX_HANDS:
            ornament = " with its grace strokes" if needed > len(hands) else ""
            what = f"{needed} hands needed at once: {_pieces(score, hands)}{ornament}"
            found.append(Impossible(hands[-1], what))
        for i, row in enumerate(rows):
            before = [r for r in rows[:i] if limbs[r] == limbs[row] != Limb.UNKNOWN]
            if before:
                limb = limb_name(Limb(limbs[row]))
                found.append(Impossible(row, f"one {limb}, two places: {_pieces(score, [*before, row])}"))
    return found


def _pieces(score: Score, rows: Sequence[int]) -> str:
    names = [word(Piece(score.notes["piece"][i])) for i in rows]
    return ", ".join(names[:-1]) + (" and " if names[1:] else "") + names[-1]


def _open_and_shut(score: Score) -> list[Impossible]:
    """Open strokes on a hi-hat that the foot closes at the same moment."""
    notes = score.notes
    chicks = notes["tick"][notes["articulation"] == Articulation.CHICK]
    open_hats = (notes["piece"] == Piece.HIHAT) & (np.nan_to_num(notes["openness"]) >= HALF_OPEN)
    at_fault = np.flatnonzero(open_hats & np.isin(notes["tick"], chicks))
    return [Impossible(int(i), "the hi-hat is struck open while the foot closes it") for i in at_fault]


def _too_fast(score: Score) -> list[Impossible]:
    """The first place of each limb, or of both hands together, that is faster than people are."""
    notes, hands = score.notes, _is_hand(score.notes)
    crews = [
        _Crew("the hands", "need", hands, {2 * n - 1: span for n, span in HAND_SPANS_S.items()}),
        *(_Crew(f"the {limb_name(limb)}", "needs", notes["limb"] == limb, spans) for limb, spans in _SPANS_S.items()),
    ]
    return [found for crew in crews if (found := _first_too_fast(crew, score))]


@dataclass(frozen=True, slots=True)
class _Crew:
    """Whose strokes share a speed limit: a `name` and its `verb`, `rows` of the score (n,), spans in seconds."""

    name: str
    verb: str
    rows: NDArray[np.bool_]
    spans_s: Mapping[int, float]


def _first_too_fast(crew: _Crew, score: Score) -> Impossible | None:
    rows = np.flatnonzero(crew.rows)
    beat_s = score.tempo_map.seconds_at(score.notes["tick"][rows])
    lead_s = score.notes["lead_ms"][rows].astype(np.float64) / 1000
    order = np.argsort(beat_s - lead_s, kind="stable")
    short = _first_short(np.asarray(beat_s - lead_s)[order], crew.spans_s)
    if short is None:
        return None
    last, strokes, lasts_s, least_s = short
    fastest = _playable_share(beat_s, lead_s, crew.spans_s)
    anyway = "" if fastest else " at any tempo"
    needs = f"{crew.name} {crew.verb} {strokes} strokes in {1000 * lasts_s:.0f} ms"
    text = f"{needs}; people need {1000 * least_s:.0f}{anyway}"
    return Impossible(int(rows[order[last]]), text, crew.name if fastest else "", fastest)


def _first_short(times_s: NDArray[np.float64], spans_s: Mapping[int, float]) -> tuple[int, int, float, float] | None:
    """The last of the first strokes that lie too close, how many they are, how long they last and should last."""
    for strokes, least_s in spans_s.items():
        lasts = times_s[strokes - 1 :] - times_s[: 1 - strokes]
        at_once = lasts == 0 if strokes == 2 else np.zeros(len(lasts), np.bool_)
        short = np.flatnonzero((lasts < least_s - _GRAIN_S) & ~at_once)  # two at once are named by `_crowded_moments`
        if len(short):
            at = int(short[0])
            return at + strokes - 1, strokes, float(lasts[at]), least_s
    return None


_GRAIN_S = 1e-8
"""Some nanoseconds, the grain of the music's times: a span that is kept exactly is kept."""
_HALVINGS = 40
"""So the share is known to a millionth of a millionth; it costs some milliseconds, and only where there is a fault."""
_SLOWEST = 0.001
"""The least share that is looked at: nobody slows music down so far (our choice)."""


def _playable_share(
    beat_s: NDArray[np.float64], lead_s: NDArray[np.float64], spans_s: Mapping[int, float]
) -> float | None:
    """The largest share of the speed at which strokes `beat_s` (n,), each `lead_s` early, keep every span.

    None where none does: two grace strokes of one hand are as near to each other at any speed.
    """

    def fits(share: float) -> bool:
        return _first_short(np.sort(beat_s / share - lead_s), spans_s) is None

    slow, fast = _SLOWEST, 1.0
    if not fits(slow):
        return None
    for _ in range(_HALVINGS):
        middle = (slow + fast) / 2
        slow, fast = (middle, fast) if fits(middle) else (slow, middle)
    return slow
