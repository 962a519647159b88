"""The tempo of a take whose file names none: MIDI then says 120, whatever was played.

Beats that fit are those on whose halves, thirds and quarters the strokes gather: the resultant of their phases is long
(circular statistics; Fisher 1993). Of the best the one counts on whose beats the take is read at least cost, with a
prior for tempi that people like to tap (van Noorden & Moelants 1999: a resonance about 120 a minute). The first stroke
is taken as the first beat.
"""

from dataclasses import replace
from math import log2

import numpy as np

from station.core.units import NS_PER_S, PPQ
from station.drills.transcription.timing.beat_spans import Floats, spans_of
from station.drills.transcription.timing.take_feel import Feel, Take, cost_of, settled, take_of
from station.music.score import Score
from station.music.swing import Swing
from station.music.tempo import DEFAULT_US_PER_QUARTER, TempoChange, TempoMap

MIN_STROKES = 24
"""Fewer have too many tempi that fit (our choice)."""
HEARD_STROKES = 64
"""A tempo shows in so many strokes, some four bars (our choice). In more the beat of a player who has no click walks by
a cell, and they gather nowhere; the rest of the take is followed (`drift`)."""
_SLOWEST_S, _FASTEST_S = 60 / 40, 60 / 220
_STEP = 0.0007
"""Share by which the beats that are tried differ: over 30 s they part by 20 ms."""
_RIVALS = 6
_MOST_CELLS = 4
_LIKED_BPM, _LIKED_OCTAVES, _LIKING = 98.0, 0.5, 4.0
"""Centre and width of the prior, and how much it weighs: a take has many strokes and one tempo (our choice)."""
_MIN_GAIN = 0.3
"""What each stroke must gain: a file that says 120 is believed unless its strokes gainsay it (our choice)."""
_WHOLE_BPM = 0.002
"""A tempo so near a whole number of beats a minute is that number."""


def at_heard_tempo(score: Score) -> Score:
    """The score over the tempo at which it was played, if its file names none and another than 120 explains it."""
    if not _is_unnamed(score) or len(score) < MIN_STROKES:
        return score
    times_s = score.onset_s - float(score.onset_s.min())
    first = times_s[:HEARD_STROKES]
    before = _cost(score, score.tempo_map, score.onset_s)
    rivals = [(_cost(score, _at(score, beat), times_s) + _liking(beat), beat) for beat in _beats(first)]
    cost, beat = min(rivals, default=(np.inf, 0.0))
    if before + _liking(DEFAULT_US_PER_QUARTER / 1e6) - cost < _MIN_GAIN * len(first):
        return score
    return _moved(score, _at(score, _whole(_refined(times_s, beat))), times_s)


def _is_unnamed(score: Score) -> bool:
    tempos, meters = score.tempo_map.tempos, score.tempo_map.meters
    return len(tempos) == len(meters) == 1 and tempos[0].us_per_quarter == DEFAULT_US_PER_QUARTER


def _at(score: Score, beat_s: float) -> TempoMap:
    """The score's meter at a quarter note of `beat_s`."""
    return TempoMap.build([TempoChange(0, round(beat_s * 1e6))], score.tempo_map.meters)


def _liking(beat_s: float) -> float:
    octaves = log2(60 / beat_s / _LIKED_BPM)
    return _LIKING * (octaves / _LIKED_OCTAVES) ** 2 / 2


def _gathering(times_s: Floats, beats_s: Floats) -> Floats:
    """How much strokes gather on the cells of beats so long (b,): the sum of squared resultants."""
    turn = np.exp(2j * np.pi * times_s / beats_s[:, None])
    turns, found = np.ones_like(turn), np.zeros(len(beats_s))
    for _ in range(_MOST_CELLS):
        turns *= turn
        found += np.abs(turns.mean(axis=1)) ** 2
    return found


def _beats(times_s: Floats) -> list[float]:
    """The lengths of beats on whose cells the strokes gather most, in seconds."""
    count = int(np.log(_SLOWEST_S / _FASTEST_S) / _STEP)
    beats = np.geomspace(_FASTEST_S, _SLOWEST_S, count)
    found = _gathering(times_s, beats)
    peaks = 1 + np.nonzero((found[1:-1] >= found[:-2]) & (found[1:-1] > found[2:]))[0]
    best = peaks[np.argsort(-found[peaks], kind="stable")][:_RIVALS]
    return [float(beats[i]) for i in best]


def _refined(times_s: Floats, beat_s: float) -> float:
    """The beat near `beat_s` on which all strokes gather most."""
    near = beat_s * (1 + np.arange(-40, 41) * _STEP / 20)
    return float(near[np.argmax(_gathering(times_s, near))])


def _whole(beat_s: float) -> float:
    bpm = 60 / beat_s
    return 60 / round(bpm) if abs(bpm - round(bpm)) < _WHOLE_BPM * bpm else beat_s


def _cost(score: Score, tempo_map: TempoMap, times_s: Floats) -> float:
    """What the first strokes cost over that tempo, straight or as triplets or swung, whichever is least."""
    first = times_s[:HEARD_STROKES]
    end = int(tempo_map.ticks_at(float(first.max())))
    take: Take = take_of(
        np.rint(first * NS_PER_S).astype(np.int64), score.notes["piece"][: len(first)], spans_of(tempo_map, end)
    )
    feels = [Feel(swing=swing) for swing in (Swing(), Swing(1.5), Swing(1.5, PPQ // 4))]
    return min(cost_of(take, settled(take, feel)) for feel in feels)


def _moved(score: Score, tempo_map: TempoMap, times_s: Floats) -> Score:
    """The strokes at their times over another tempo, lengths with them; the music ends with its last bar."""
    by = DEFAULT_US_PER_QUARTER / tempo_map.tempos[0].us_per_quarter
    rows = score.notes.copy()
    leads_s = rows["lead_ms"].astype(np.float64) / 1000
    rows["tick"] = tempo_map.ticks_at(times_s + leads_s)
    for name in ("duration_ticks", "choke_ticks"):
        rows[name] = np.rint(rows[name] * by).astype(np.int64)
    return replace(Score.from_array(rows, tempo_map, title=score.title), loudness=())
