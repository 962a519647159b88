"""Whether two hands and two feet can play what is written.

Judged by the moments at which strokes sound, grace strokes included, at the tempo given. A limb's speed is bounded by
spans: so many strokes of one limb need at least so long. Two hands that share a passage in any way can play at most
2n − 1 strokes in less than the time that one hand needs for n.
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

MAX_HANDS = 2
_HANDS_STRIKE = np.array(sorted(HAND_PIECES), np.uint8)


@dataclass(frozen=True, slots=True)
class Impossible:
    """Row `note` of the score cannot be played; `text` says why."""

    note: int
    text: str


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
    notes, onset = score.notes, score.onset_s
    hands = _is_hand(notes)
    both_hands = {2 * n - 1: span for n, span in HAND_SPANS_S.items()}
    crews = [
        ("the hands need", hands, both_hands),
        *(
            (f"the {word(limb).replace('_', ' ')} needs", notes["limb"] == limb, spans)
            for limb, spans in (
                (Limb.RIGHT_HAND, HAND_SPANS_S),
                (Limb.LEFT_HAND, HAND_SPANS_S),
                (Limb.RIGHT_FOOT, FOOT_SPANS_S),
                (Limb.LEFT_FOOT, FOOT_SPANS_S),
            )
        ),
    ]
    found = [_first_too_fast(name, np.flatnonzero(rows), onset, spans) for name, rows, spans in crews]
    return [f for f in found if f]


def _first_too_fast(
    limb: str, rows: NDArray[np.int64], onset_s: NDArray[np.float64], spans: Mapping[int, float]
) -> Impossible | None:
    rows = rows[np.argsort(onset_s[rows], kind="stable")]
    times = onset_s[rows]
    for strokes, least_s in spans.items():
        lasts = times[strokes - 1 :] - times[: 1 - strokes]
        at_once = lasts == 0 if strokes == 2 else np.zeros(len(lasts), np.bool_)
        short = np.flatnonzero((lasts < least_s) & ~at_once)  # two at once are named by `_crowded_moments`
        if len(short):
            at = int(short[0])
            text = f"too fast: {limb} {strokes} strokes in {1000 * lasts[at]:.0f} ms; people need {1000 * least_s:.0f}"
            return Impossible(int(rows[at + strokes - 1]), text)
    return None
