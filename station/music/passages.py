"""Where in a score the things happen that students do badly: fills, waits, swung offbeats, second strokes of doubles.

Each function says something of every row of the score, shape (n,), mostly a flag, never set on grace strokes. They read
what is written and nothing else, so that whoever plants a habit and whoever looks for it mean the same strokes. A row's
*slot* is its tick.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import OTHER_HAND, TOMS, Articulation, Limb, Ornament, Piece
from station.core.units import NS_PER_MS, PPQ
from station.music.score import Score

Flags = NDArray[np.bool_]
Floats = NDArray[np.float64]

TIMEKEEPERS = (Piece.HIHAT, Piece.RIDE, Piece.RIDE_2, Piece.COWBELL, Piece.TAMBOURINE)
"""What keeps the time in a groove; where it stops and drums go on, there is a fill."""
MIN_FILL_STROKES = 2
"""Strokes of the hands in a beat of a fill, at least; our choice: fewer is a rest with an accent."""
MAX_FILL_SHARE = 0.5
"""Were more of the sounding beats like that, they would be the groove; our choice."""
LONG_WAIT, REST = 1.25, 2.5
"""A wait this many times the median is a long one: a slower tempo by a fifth, or a gap; and one in which a stroke or
more is left out before it goes on; our choice."""
LEAST_RUN_STROKES = 4
"""Strokes of a fill that carries into what follows, at least; our choice: a beat of sixteenths."""
SWING_FRACTIONS = (0.54, 0.74)
"""Where in its beat a swung offbeat lies: ratios 1.17 to 2.85, so that a dotted figure (3:1) is none; our choice."""
LONGEST_DOUBLE_MS = 320
"""Beyond, two strokes of one hand are two strokes and no double; our choice: triplets at 63 bpm."""
_DOUBLE_REACH = 1.5
"""The other hand is beside a double if it strikes within so many of its intervals: triplets mix with eighths."""
_OF_TWO = (Ornament.DIDDLE, Ornament.ROLL)
"""The ornaments whose letter plays two strokes, but for the buzz, a roll that is one."""
_BOTH_HANDS = -2
"""Stands for a limb where the hands strike together."""

_PLACE_DIGITS = 3
"""Fractions of a beat that agree to so many digits are one place, so that ticks may be rounded; our choice."""


def slots(score: Score) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Ticks of the slots in order, shape (k,), and the slot of each row, shape (n,)."""
    ticks, slot_of_row = np.unique(score.notes["tick"], return_inverse=True)
    return ticks.astype(np.int64), slot_of_row.astype(np.int64)


def fills(score: Score) -> Flags:
    """Every stroke in the beats where the timekeeping stops and drums go on; none where nothing ever keeps time."""
    notes = score.notes
    main_hand = ~score.is_grace & ~np.isin(notes["piece"], (Piece.KICK, Piece.HIHAT_PEDAL))
    beat = _beats(score)
    count = int(beat.max(initial=-1)) + 1
    drums = np.bincount(beat[main_hand & np.isin(notes["piece"], (Piece.SNARE, *TOMS))], minlength=count)
    keeps = np.bincount(beat[main_hand & np.isin(notes["piece"], TIMEKEEPERS)], minlength=count) > 0
    sounds = np.bincount(beat[main_hand], minlength=count) > 0
    filled = (drums >= MIN_FILL_STROKES) & ~keeps
    if not keeps.any() or filled.sum() > MAX_FILL_SHARE * sounds.sum():
        return np.zeros(len(score), bool)
    return np.asarray(~score.is_grace & filled[beat])


def fill_ramp(score: Score) -> Floats:
    """How far into its fill each stroke stands, in slots, over the mean of the fill's strokes; 0 outside; shape (n,).

    Who rushes a fill mostly rushes more and more: an effect times this has the effect as its mean.
    """
    ramp = np.zeros(len(score))
    rows = np.flatnonzero(fills(score))
    beat = score.notes["tick"][rows] // PPQ
    for fill in np.split(rows, np.flatnonzero(np.diff(beat) > 1) + 1) if len(rows) else ():
        place = np.unique(score.notes["tick"][fill], return_inverse=True)[1] + 1.0
        ramp[fill] = place / place.mean()
    return ramp


def landings(score: Score) -> Flags:
    """The strokes on which fills land: on the first beat after each, and what follows it for a beat.

    Only fills that carry over, of `LEAST_RUN_STROKES` or more that go to the toms or on for more than a beat: a snare
    beat whose hat is left out lands nowhere.
    """
    flags, filled, beat = np.zeros(len(score), bool), fills(score), _beats(score)
    rows = np.flatnonzero(filled)
    is_tom, on_beat = np.isin(score.notes["piece"], TOMS), _within_quarter(score) == 0
    for fill in np.split(rows, np.flatnonzero(np.diff(beat[rows]) > 1) + 1) if len(rows) else ():
        after = beat == beat[fill[-1]] + 1
        carries = len(fill) >= LEAST_RUN_STROKES and (is_tom[fill].any() or beat[fill[0]] < beat[fill[-1]])
        if carries and (after & on_beat).any():
            flags |= after
    return np.asarray(flags & ~score.is_grace)


def landing_fade(score: Score) -> Floats:
    """What is left at each stroke (n,) of a landing that is put right within its beat: 1 on the one, then less, then 0.

    So lands who comes out of a fill beside the time and finds back to it.
    """
    return landings(score) * (1 - _within_quarter(score) / PPQ)


@dataclass(frozen=True, eq=False)
class Offbeats:
    """Strokes beside the beat that are written straight; a beat is a pulse of the meter (`MeterChange.pulses`).

    Flags (n,): `all` of them, `ands` in the middle of the beat, `quarters` at its first and third quarter.
    """

    all: Flags
    ands: Flags
    quarters: Flags


def offbeats(score: Score) -> Offbeats:
    """The strokes beside the beat; swung ones are none."""
    within, beat_ticks = _in_pulse(score)
    straight = ~score.is_grace & ~swung(score).flags
    halved = straight & (2 * within == beat_ticks) & (beat_ticks == PPQ)
    quartered = straight & ((4 * within == beat_ticks) | (4 * within == 3 * beat_ticks)) & (beat_ticks == PPQ)
    return Offbeats(straight & (within > 0), halved, quartered)


def long_waits(score: Score, longer: float = LONG_WAIT) -> Flags:
    """Strokes that come `longer` or more times the median wait after the slot before; never the first slot's."""
    ticks, slot_of_row = slots(score)
    if len(ticks) < 2:
        return np.zeros(len(score), bool)
    waits = np.diff(score.tempo_map.ns_at(ticks)).astype(np.float64)
    is_long = np.concatenate([[False], waits >= longer * np.median(waits)])
    return np.asarray(is_long[slot_of_row] & ~score.is_grace)


@dataclass(frozen=True, eq=False)
class Swung:
    """The swung offbeats among n rows, all of shape (n,).

    `flags` which they are; `span_ms` the length of the unit that swings (a quarter or an eighth), `places` where in it
    they lie, 0–1; both are 0 on other rows.
    """

    flags: Flags
    span_ms: Floats
    places: Floats

    @property
    def written_place(self) -> float:
        """Where the offbeats mostly lie; there is at least one."""
        return float(np.median(self.places[self.flags]))


def swung(score: Score) -> Swung:
    """The swung offbeats.

    A beat swings where its only strokes are on it and at one later place within `SWING_FRACTIONS`; sixteenths swing
    where both halves of the beat do so alike.
    """
    within = _within_quarter(score)
    beat = _beats(score)
    flags, spans, places = np.zeros(len(score), bool), np.full(len(score), PPQ), within / PPQ
    order = np.argsort(beat, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(beat[order])) + 1):
        span = _swing_span({int(w) for w in within[rows]})
        if span is not None:
            spans[rows], places[rows] = span, (within[rows] % span) / span
            flags[rows] = places[rows] > SWING_FRACTIONS[0]
    flags &= ~score.is_grace
    start = score.notes["tick"] - np.rint(places * spans).astype(np.int64)
    span_ms = (score.tempo_map.ns_at(start + spans) - score.tempo_map.ns_at(start)) / NS_PER_MS
    return Swung(flags, np.where(flags, span_ms, 0.0), np.where(flags, places, 0.0))


def _swing_span(within: set[int]) -> int | None:
    """Length in ticks of the unit that swings in a beat with strokes at `within`; None where none does."""
    for span in (PPQ, PPQ // 2):
        offbeats = {round(w % span / span, _PLACE_DIGITS) for w in within} - {0.0}
        halves_told = span == PPQ or PPQ // 2 in within
        if len(offbeats) == 1 and SWING_FRACTIONS[0] < min(offbeats) < SWING_FRACTIONS[1] and halves_told:
            return span
    return None


def diddle_pairs(score: Score) -> list[tuple[int, int]]:
    """First and second row of each diddle and of each cell of an open roll: they pair up in order, piece by piece."""
    notes, pairs = score.notes, list[tuple[int, int]]()
    two = ~score.is_grace & np.isin(notes["ornament"], _OF_TWO) & (notes["articulation"] != Articulation.BUZZ)
    for piece in np.unique(notes["piece"][two]):
        rows = np.flatnonzero(two & (notes["piece"] == piece)).tolist()
        pairs += zip(rows[::2], rows[1::2], strict=False)
    return pairs


def second_of_doubles(score: Score) -> Flags:
    """Second strokes of doubles, by what is written: diddles and open rolls, and what the sticking makes doubles.

    The rows that a diddle or an open roll stands for pair up in order, piece by piece. By sticking a double is two
    quick strokes of one hand, alone in their slots, beside a stroke of the other.
    """
    notes, flags = score.notes, np.zeros(len(score), bool)
    flags[[second for _, second in diddle_pairs(score)]] = True
    hands = ~score.is_grace & np.isin(notes["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    rows = np.flatnonzero(hands)
    at_ns = score.onset_ns[rows]
    gaps = np.diff(at_ns)
    chord = np.concatenate([[False], gaps == 0]) | np.concatenate([gaps == 0, [False]])
    hand = np.where(chord[: len(rows)], _BOTH_HANDS, notes["limb"][rows])
    ends = (np.diff(hand) != 0) | (gaps > LONGEST_DOUBLE_MS * NS_PER_MS) | (gaps == 0)
    for run in np.split(np.arange(len(rows)), np.flatnonzero(ends) + 1):
        if len(run) == 2 and _beside_other_hand(hand, at_ns, int(run[0])):
            flags[rows[run[1]]] = True
    return flags


def double_interval_ms(score: Score) -> float:
    """The usual time from the first to the second stroke of a double as written; infinite without doubles."""
    second = np.flatnonzero(second_of_doubles(score))
    slot_ticks, slot_of_row = slots(score)
    before = slot_ticks[np.maximum(slot_of_row[second] - 1, 0)]
    gaps_ms = (score.tempo_map.ns_at(score.notes["tick"][second]) - score.tempo_map.ns_at(before)) / NS_PER_MS
    return float(np.median(gaps_ms)) if len(second) else float("inf")


def _beside_other_hand(hand: NDArray[np.int8], at_ns: NDArray[np.int64], first: int) -> bool:
    """Whether the other hand strikes alone before stroke `first` or after the next, about as near as these two are."""
    other = OTHER_HAND.get(hand[first])
    reach = _DOUBLE_REACH * (at_ns[first + 1] - at_ns[first])
    before, after = first - 1, first + 2
    near_before = before >= 0 and hand[before] == other and at_ns[first] - at_ns[before] <= reach
    near_after = after < len(hand) and hand[after] == other and at_ns[after] - at_ns[first + 1] <= reach
    return bool(near_before or near_after)


def _beat_starts(score: Score) -> NDArray[np.int64]:
    """Tick on which the meter of each row began: quarters are counted from there."""
    meters = np.array([m.tick for m in score.tempo_map.meters], np.int64)
    starts: NDArray[np.int64] = meters[np.searchsorted(meters, score.notes["tick"], side="right") - 1]
    return starts


def _in_pulse(score: Score) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Ticks of each row since its pulse began, and the pulse's length, both (n,)."""
    meters, ticks = score.tempo_map.meters, score.notes["tick"]
    within, lengths = np.zeros(len(score), np.int64), np.zeros(len(score), np.int64)
    row_of_meter = np.searchsorted(ticks, [m.tick for m in meters])  # rows are in order of their ticks
    for meter, rows in zip(meters, np.split(np.arange(len(score)), row_of_meter[1:]), strict=True):
        starts, ends = np.array(meter.pulses, np.int64).T
        in_bar = (ticks[rows] - meter.tick) % meter.bar_ticks
        pulse = np.searchsorted(starts, in_bar, side="right") - 1
        within[rows], lengths[rows] = in_bar - starts[pulse], (ends - starts)[pulse]
    return within, lengths


def _within_quarter(score: Score) -> NDArray[np.int64]:
    """Ticks of each row since its quarter began."""
    within: NDArray[np.int64] = (score.notes["tick"] - _beat_starts(score)) % PPQ
    return within


def _beats(score: Score) -> NDArray[np.int64]:
    """Index of the quarter that holds each row, counted anew where the meter changes; rising with time, with gaps."""
    starts = _beat_starts(score)
    beats: NDArray[np.int64] = (
        starts // PPQ + np.searchsorted(np.unique(starts), starts) + (score.notes["tick"] - starts) // PPQ
    )
    return beats
