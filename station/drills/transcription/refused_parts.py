"""What is refused before anything is tried, for no lesson could hold it and trying would take long."""

from station.core.errors import BadInput
from station.core.units import NS_PER_S, PPQ
from station.drills.grid.grid_timing import MAX_BEATS, UNITS
from station.drills.grid.line_group import MAX_BARS
from station.music.drum_part import DrumPart
from station.music.score import Score
from station.music.tempo import MAX_BPM, MIN_BPM

MOST_STROKES = 12_000
"""Our choice: 20 minutes of ten a second, which take some seconds to read; the longest lesson that ships has 230."""
_ABOUT = 1.01
"""A tempo of a file so little beyond a lesson's may be one that was rounded (our choice)."""


def refuse_beyond_lessons(part: DrumPart, name: str) -> None:
    """Raise `BadInput` of `name` for a part without strokes, or of more than a lesson may have."""
    if not len(part.score):
        raise BadInput(name, "", "there is no drum note in it")
    if len(part.score) > MOST_STROKES:
        raise BadInput(name, "", f"{len(part.score):,} strokes; at most {MOST_STROKES:,} become a lesson")
    if part.score.bar_count > MAX_BARS:
        raise BadInput(name, "", f"{part.score.bar_count} bars; a lesson has at most {MAX_BARS}")
    if part.is_meter_said:
        _refuse_meters(part.score, name)
    _refuse_tempo(part.score, name)


def _refuse_meters(score: Score, name: str) -> None:
    """Raise `BadInput` for the first bar played whose meter no lesson has: long bars would take long to be tried."""
    for bar in range(int(score.bar[0]), int(score.bar[-1]) + 1):
        meter = score.tempo_map.meter_at(score.tempo_map.bar_start(bar))
        if meter.beats > MAX_BEATS or meter.unit not in UNITS:
            expected = f"a lesson has 1 to {MAX_BEATS} beats of 1/{UNITS[0]} to 1/{UNITS[-1]}"
            raise BadInput(name, f"bar {bar + 1}", f"a meter of {meter}; {expected}")


def _refuse_tempo(score: Score, name: str) -> None:
    """Raise `BadInput` where its mean tempo is none of a lesson: all strokes at once would take long to be sorted."""
    mean_bpm = score.end_tick / PPQ * 60 * NS_PER_S / max(score.length_ns, 1)
    if not MIN_BPM / _ABOUT <= mean_bpm <= MAX_BPM * _ABOUT:
        expected = f"a lesson has {MIN_BPM:g} to {MAX_BPM:g}"
        raise BadInput(name, "", f"{mean_bpm:.4g} quarter notes a minute from end to end; {expected}")
