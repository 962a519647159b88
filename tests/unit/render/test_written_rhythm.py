"""Where notation writes what was played: places counted by hand, and bars that add up in lessons and recordings."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.formats.format_table import read_part
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.notation.spelling.bar_spelling import spell_bar
from station.render.notation.spelling.note_values import BeatGroup, Stroke
from station.render.notation.spelling.written_rhythm import written_ticks
from station.render.notation.voice.written_strokes import feet_of, written_strokes
from tests.shipped_lesson import shipped_lessons
from tests.unit.render.rhythm_sums import gaps

GMD = Path(__file__).parents[3].parent / "shared" / "data" / "gmd"


def written(*quarters: float, piece: Piece = Piece.SNARE, bars: int = 1, tempo_bpm: float = 120.0) -> list[float]:
    tempo_map = TempoMap.constant(tempo_bpm)
    notes = [Note(round(q * PPQ), piece) for q in quarters]
    score = Score.from_notes(notes, tempo_map, tempo_map.bar_start(bars))
    return [tick / PPQ for tick in written_ticks(score, feet_of(score)).tolist()]


def test_what_lies_on_divisions_stays() -> None:
    places = [0, 0.25, 1, 1 + 1 / 3, 1 + 2 / 3, 2, 2.2, 2.4, 2.6, 2.8, 3, 3.5]
    assert written(*places) == pytest.approx(places)


def test_what_strays_is_written_where_it_was_meant() -> None:
    assert written(0.01, 0.52, 0.97, 1.49, 2.03, 2.51, 3.02, 3.49) == [k / 2 for k in range(8)]


def test_a_stroke_ahead_of_the_bar_line_is_written_after_it() -> None:
    assert written(0.02, 0.98, 2.03, 2.97, 3.96, bars=2) == [0, 1, 2, 3, 4]
    assert written(0.02, 0.98, 2.03, 2.97, 3.96)[-1] < 4, "but not after the end"


def test_a_flam_that_was_played_is_one_place() -> None:
    assert written(0.0, 0.96, 1.02, 2.03, 2.97) == [0, 1, 1, 2, 3]


def test_fast_strokes_are_guessed_only_where_they_come_in_runs() -> None:
    run = written(0.01, 0.13, 0.26, 0.37, 0.51, 0.62, 0.74, 0.88, 1.02, tempo_bpm=80.0)
    assert run == [k / 8 for k in range(9)]
    assert written(0.02, 0.57, 1.03, 2.02, 3.02)[1] == 0.5, "no thirty-second by itself"


def voice_bars(score: Score) -> Iterator[tuple[list[Stroke], list[BeatGroup], int]]:
    """Every bar of both voices that has strokes, spelled."""
    strokes, tempo = written_strokes(score, feet_of(score)), score.tempo_map
    mains = ~score.is_grace & ~strokes.is_hidden
    for bar in range(score.bar_count):
        start, end = tempo.bar_start(bar), tempo.bar_start(bar + 1)
        for is_foot in (False, True):
            rows = np.flatnonzero(mains & (strokes.is_foot == is_foot) & (strokes.tick >= start) & (strokes.tick < end))
            ticks = sorted(set(strokes.tick[rows].tolist()))
            until = {tick: int(strokes.until[rows[strokes.tick[rows] == tick]].max()) for tick in ticks}
            held = strokes.held_into(start, is_foot)
            found = [Stroke(0, int(strokes.until[list(held)].max()) - start, is_held=True)] if held else []
            found += [Stroke(t - start, until[t] - start if until[t] > t else None) for t in ticks]
            if found:
                yield found, spell_bar(found, tempo.meter_at(start), end - start), end - start


def check(score: Score, name: str) -> None:
    for strokes, groups, length in voice_bars(score):
        assert gaps(groups, length) == [], name
        sources = {value.source for group in groups for value in group.strokes}
        assert sources == set(range(len(strokes))), name
        for group in groups:
            for tuplet in group.tuplets:
                inside = sum(group.time_of(v) for v in group.values if tuplet.start <= v.tick < tuplet.end)
                assert abs(float(inside) - (tuplet.end - tuplet.start)) < 2, name
            assert all(v.value.base <= 64 for v in group.values), name


def test_both_voices_of_all_shipped_lessons_add_up() -> None:
    for lesson in shipped_lessons():
        check(lesson.played_once, lesson.title)


@pytest.mark.skipif(not GMD.is_dir(), reason="the recordings are not here")
def test_recordings_add_up_and_have_no_odd_tuplets() -> None:
    """Some of the Groove MIDI data set (CC BY 4.0), all that people played."""
    for path in sorted(GMD.rglob("*.mid"))[::9]:
        score = read_part(path).score
        check(score, path.name)
        numbers = {t.number for _, groups, _ in voice_bars(score) for group in groups for t in group.tuplets}
        assert numbers <= {2, 3, 4, 6}, path.name
