"""Rolls held over beats and bars: note values by the common table of notes, ties counted by hand."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.notation.engraving import Engraver
from station.render.notation.page.bar_columns import BarColumns, bar_columns
from station.render.notation.voice.held_rolls import held_until
from station.render.text.atlas import Atlas
from station.render.text.draw_list import ShapeKind
from tests.unit.render.scores import BAR, score_of

ATLAS = Atlas()
SIXTEENTH = PPQ // 4
Shapes = NDArray[np.void]


def columns(score: Score) -> BarColumns:
    """Those of the first bar, two seconds long."""
    return bar_columns(Engraver(score, Atlas()).bar(0, with_line=False), 2.0, score.tempo_map.ticks_at)


def roll(tick: int, length: int, swing: int = 0) -> Note:
    return Note(tick, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=length, swing_ticks=swing)


def signs(shapes: Shapes, name: str) -> list[float]:
    """When each of these signs stands, in seconds; a quarter lasts half a second."""
    uv = np.array(ATLAS.sign(name).uv, np.float32)
    return sorted(shapes["time_s"][(np.sort(shapes["uv"], axis=1) == np.sort(uv)).all(axis=1), 0].tolist())


def heads(shapes: Shapes, hollow: bool) -> list[float]:
    """When the heads that are filled, or `hollow`, stand."""
    names = ("head_half", "head_whole") if hollow else ("head_round",)
    return sorted(time_s for name in names for time_s in signs(shapes, name))


def stems(shapes: Shapes) -> int:
    return int(((shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"][:, 1], 0.06)).sum())


def tied(shapes: Shapes) -> tuple[float, float] | None:
    """From when to when ties reach; None where there is none."""
    steps = shapes[(shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"][:, 1], 0.075)]
    return (float(steps["time_s"][:, 0].min()), float(steps["time_s"].sum(axis=1).max())) if len(steps) else None


def bars_of(*notes: Note, count: int = 1, meter: tuple[int, int] = (4, 4)) -> list[Shapes]:
    tempo_map = TempoMap.constant(120, *meter)
    engraver = Engraver(Score.from_notes(notes, tempo_map, tempo_map.bar_start(count)), ATLAS)
    return [engraver.bar(bar) for bar in range(count)]


def test_a_roll_of_two_beats_is_a_half_note() -> None:
    (shapes,) = bars_of(roll(0, 2 * PPQ), Note(2 * PPQ, Piece.SNARE), Note(3 * PPQ, Piece.SNARE))
    assert (heads(shapes, hollow=True), heads(shapes, hollow=False)) == ([0.0], [1.0, 1.5])
    assert (signs(shapes, "buzz"), signs(shapes, "rest_4"), tied(shapes)) == ([0.0], [], None)
    assert stems(shapes) == 3


def test_a_roll_of_a_bar_is_a_whole_note_without_a_stem() -> None:
    (shapes,) = bars_of(roll(0, BAR))
    assert (heads(shapes, hollow=True), stems(shapes), signs(shapes, "buzz")) == ([0.0], 0, [0.0])
    assert signs(shapes, "rest_4") == []


def test_in_six_eight_a_bar_is_a_dotted_half() -> None:
    (shapes,) = bars_of(roll(0, 3 * PPQ), meter=(6, 8))
    assert (heads(shapes, hollow=True), stems(shapes), signs(shapes, "dot")) == ([0.0], 1, [0.0])


def test_what_begins_off_the_beat_is_tied_to_it_and_ends_where_it_ends() -> None:
    """An eighth before beat 2, all of beat 2, an eighth of beat 3; then a sixteenth's rest and a stroke."""
    last = 2 * PPQ + 3 * SIXTEENTH
    (shapes,) = bars_of(roll(PPQ // 2, 2 * PPQ), Note(last, Piece.SNARE))
    assert heads(shapes, hollow=False) == [0.25, 0.5, 1.0, 1.375]
    assert signs(shapes, "buzz") == [0.25, 0.5, 1.0]
    assert tied(shapes) == pytest.approx((0.25, 1.0))
    assert signs(shapes, "rest_16") == [1.25]


def test_a_roll_over_the_bar_line_is_tied_to_the_next_bar_and_is_no_silence_there() -> None:
    first, second = bars_of(roll(2 * PPQ, 4 * PPQ), count=2)
    assert (heads(first, hollow=True), heads(second, hollow=True)) == ([1.0], [2.0])
    assert tied(first) == pytest.approx((1.0, 2.0))
    assert tied(second) is None, "the bar before drew it"
    assert signs(second, "rest_2") == [3.0]


def test_a_tie_from_the_line_before_begins_anew() -> None:
    score = score_of(roll(2 * PPQ, 6 * PPQ))
    shapes = Engraver(score, ATLAS).bar(1, with_line=False, opens_line=True)
    assert tied(shapes) == (2.0, 2.0)


def test_a_roll_inside_its_beat_is_no_longer_than_it_sounds() -> None:
    """A sixteenth of each beat; rests say that the roll does not fill it, as a stroke's note value would."""
    (shapes,) = bars_of(*(roll(k * PPQ, SIXTEENTH) for k in range(4)))
    assert heads(shapes, hollow=False) == [0.0, 0.5, 1.0, 1.5]
    assert (len(signs(shapes, "rest_16")), len(signs(shapes, "rest_8")), tied(shapes)) == (4, 4, None)


def test_a_roll_ends_at_the_next_stroke_of_its_voice_as_it_is_written() -> None:
    """The feet do not end it; a swung stroke does where notation has it, on the half beat."""
    late = round(PPQ * 2 / 3) - PPQ // 2
    notes = [roll(0, 4 * PPQ), Note(PPQ, Piece.KICK), Note(PPQ + PPQ // 2 + late, Piece.SNARE, swing_ticks=late)]
    score = score_of(*notes)
    until = held_until(score, score.notes["piece"] == Piece.KICK, score.notes["tick"] - score.notes["swing_ticks"])
    assert until.tolist() == [PPQ + PPQ // 2, PPQ, PPQ + PPQ // 2]


def test_a_bar_has_room_for_where_a_roll_ends() -> None:
    plain = columns(score_of(Note(0, Piece.SNARE), Note(2 * PPQ, Piece.SNARE)))
    held = columns(score_of(roll(0, PPQ + SIXTEENTH), Note(2 * PPQ, Piece.SNARE)))
    assert held.width(1.0) > plain.width(1.0)
