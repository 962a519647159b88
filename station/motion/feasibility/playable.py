"""Whether two hands and two feet can play what is written.

Judged by the moments at which strokes sound, grace strokes included, at the tempo given. A limb's speed is bounded by
spans: so many strokes of one limb need at least so long. Two hands that share a passage in any way can play at most
2n − 1 strokes in less than the time that one hand needs for n.

What is too fast is asked at slower speeds, too: the fastest that will do is told, as a share of the speed given. Grace
strokes keep their milliseconds at every speed, so the share is no mere quotient; bisection finds it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.labels import limb_name
from station.core.pieces import HALF_OPEN, HAND_PIECES, Articulation, Limb, Ornament, Piece, word
from station.motion.feasibility.limb_speeds import SPANS_S
from station.music.score import Score

MAX_HANDS = 2
_HANDS_STRIKE = np.isin(np.arange(256), sorted(HAND_PIECES))
"""By `Piece`, whether a hand strikes it."""
_GRACED = np.isin(np.arange(256), (Ornament.FLAM, Ornament.DRAG))
"""By `Ornament`, whether grace strokes go before it."""


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


def unplayable_rows(score: Score) -> NDArray[np.int64]:
    """The rows to leave out so that nothing impossible is left; of strokes that come too soon, the later ones."""
    score = score.on_the_grid
    left_out = {i.note for i in (*_crowded_moments(score), *_open_and_shut(score))}
    for crew in reversed(_crews(score)):  # each limb first: what it leaves out spares both hands together
        rows = np.flatnonzero(crew.rows)
        rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
        rows = rows[~np.isin(rows, sorted(left_out))]
        left_out |= set(rows[_too_soon(score.onset_s[rows], crew.spans_s)].tolist())
    return np.array(sorted(left_out), np.int64)


def _too_soon(times_s: NDArray[np.float64], spans_s: Mapping[int, float]) -> NDArray[np.bool_]:
    """Which strokes (n,), in order of time, come too soon after those that are left before them."""
    kept: list[float] = []
    is_late = np.zeros(len(times_s), np.bool_)
    for i, time_s in enumerate(times_s.tolist()):
        is_late[i] = any(
            len(kept) >= strokes - 1
            and time_s - kept[1 - strokes] < least_s - _GRAIN_S
            and not (strokes == 2 and time_s == kept[-1])
            for strokes, least_s in spans_s.items()
        )
        if not is_late[i]:
            kept.append(time_s)
    return is_late


def _is_hand(notes: NDArray[np.void]) -> NDArray[np.bool_]:
    by_foot = notes["limb"] >= Limb.RIGHT_FOOT
    return np.asarray(_HANDS_STRIKE[notes["piece"]] & ~by_foot)


def _crowded_moments(score: Score) -> list[Impossible]:
    """Moments that ask for three hands, or for one limb in two places."""
    found: list[Impossible] = []
    notes = score.notes
    limbs, struck = notes["limb"].tolist(), np.flatnonzero(~score.is_grace)
    is_hand, graced = _is_hand(notes), _GRACED[notes["ornament"]]
    for rows in _crowds(notes["tick"][struck], (is_hand * (1 + graced))[struck], notes["limb"][struck], struck):
        hands = [i for i in rows if is_hand[i]]
        needed = len(hands) + int(graced[hands].sum())
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


def _crowds(
    ticks: NDArray[np.int64], hands: NDArray[np.int64], limbs: NDArray[np.int8], rows: NDArray[np.int64]
) -> list[list[int]]:
    """Of strokes (n,) in order of `ticks` the `rows` of each moment that needs too many `hands` or a limb twice."""
    moment = np.cumsum(np.diff(ticks, prepend=ticks[:1]) != 0)
    known = limbs != Limb.UNKNOWN
    who = np.sort(moment[known] * len(Limb) + limbs[known])
    twice = who[1:][np.diff(who) == 0] // len(Limb)
    crowded = np.union1d(np.flatnonzero(np.bincount(moment, hands) > MAX_HANDS), twice)
    return [rows[moment == one].tolist() for one in crowded.tolist()]


def _pieces(score: Score, rows: Sequence[int]) -> str:
    names = [word(Piece(score.notes["piece"][i])) for i in rows]
    return ", ".join(names[:-1]) + (" and " if names[1:] else "") + names[-1]


def _open_and_shut(score: Score) -> list[Impossible]:
    """Open strokes on a hi-hat that the foot closes at the same moment."""
    notes = score.notes
    chicks = notes["tick"][notes["articulation"] == Articulation.CHICK]
    if not len(chicks):
        return []
    open_hats = (notes["piece"] == Piece.HIHAT) & (np.nan_to_num(notes["openness"]) >= HALF_OPEN)
    at_fault = np.flatnonzero(open_hats & np.isin(notes["tick"], chicks))
    return [Impossible(int(i), "the hi-hat is struck open while the foot closes it") for i in at_fault]


def _too_fast(score: Score) -> list[Impossible]:
    """The first place of each limb, or of both hands together, that is faster than people are."""
    beat_s = score.tempo_map.seconds_at(score.notes["tick"])
    lead_s = score.notes["lead_ms"].astype(np.float64) / 1000
    return [found for crew in _crews(score) if (found := _first_too_fast(crew, beat_s, lead_s))]


@dataclass(frozen=True, slots=True)
class _Crew:
    """Whose strokes share a speed limit: `name` and `verb`, how many limbs, `rows` of the score (n,), spans in s."""

    name: str
    verb: str
    limbs: int
    rows: NDArray[np.bool_]
    spans_s: Mapping[int, float]


def _crews(score: Score) -> list[_Crew]:
    """Both hands together, then each limb."""
    together = {2 * n - 1: span for n, span in SPANS_S[Limb.RIGHT_HAND].items()}
    return [
        _Crew("the hands", "need", MAX_HANDS, _is_hand(score.notes), together),
        *(
            _Crew(f"the {limb_name(limb)}", "needs", 1, score.notes["limb"] == limb, spans)
            for limb, spans in SPANS_S.items()
        ),
    ]


def _first_too_fast(crew: _Crew, beat_s: NDArray[np.float64], lead_s: NDArray[np.float64]) -> Impossible | None:
    """The same of one crew, where the strokes of all (n,) are `lead_s` before `beat_s`."""
    rows = np.flatnonzero(crew.rows)
    if len(rows) < 2:
        return None
    beat_s, lead_s = beat_s[rows], lead_s[rows]
    order = np.argsort(beat_s - lead_s, kind="stable")
    order = order[~_surplus(beat_s[order], lead_s[order], crew.limbs)]
    rows, beat_s, lead_s = rows[order], beat_s[order], lead_s[order]
    short = _first_short(beat_s - lead_s, crew.spans_s)
    if short is None:
        return None
    last, strokes, lasts_s, least_s = short
    fastest = _playable_share(beat_s, lead_s, crew.spans_s)
    anyway = "" if fastest else " at any tempo"
    needs = f"{crew.name} {crew.verb} {strokes} strokes in {1000 * lasts_s:.0f} ms"
    text = f"{needs}; people need {1000 * least_s:.0f}{anyway}"
    return Impossible(int(rows[last]), text, crew.name if fastest else "", fastest)


def _surplus(beat_s: NDArray[np.float64], lead_s: NDArray[np.float64], limbs: int) -> NDArray[np.bool_]:
    """Which strokes (n,), in order of time, are more than `limbs` at one moment: `_crowded_moments` names them."""
    surplus = np.zeros(len(beat_s), np.bool_)
    surplus[limbs:] = (beat_s[limbs:] == beat_s[:-limbs]) & (lead_s[limbs:] == lead_s[:-limbs])
    return surplus


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
