"""Scores brought onto the grid; expected cells by hand."""

from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.drills.library import find_lesson
from station.drills.quantise import lesson_of, quantise_score
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_writer import write_lesson
from station.drills.writing.score_difference import score_difference
from station.music.formats.smf.standard_midi import read_midi, score_from_midi
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.real_data import real_files
from tests.unit.drills.reading import EIGHTH, QUARTER, SIXTEENTH, TRIPLET, WHOLE

TEMPO = TempoMap.constant(120)
MS = QUARTER // 500
"""Ticks in a millisecond at 120 bpm (to within 0.02 %)."""


def fitted(*notes: Note, tempo_map: TempoMap = TEMPO) -> list[Note]:
    found = quantise_score(Score.from_notes(notes, tempo_map))
    text = write_lesson(lesson_of(found.score, "x", "x", found.velocities))
    again = parse_lesson(text, "x", "x").lesson
    assert again
    assert score_difference(found.score, again.score) == ""
    return list(found.score)


def snare(tick: int, velocity: int = 80) -> Note:
    return Note(tick, Piece.SNARE, velocity=velocity)


def test_what_the_grid_can_say_stays() -> None:
    lesson = find_lesson("funk-1")
    found = quantise_score(lesson.score)
    assert score_difference(found.score, lesson.score) == ""
    assert (found.moved, found.left_out, found.furthest_ms) == (0, 0, 0)


def test_human_sixteenths_go_to_the_nearest() -> None:
    late = (12, -9, 15, 4)
    played = [snare(i * SIXTEENTH + ms * MS) for i, ms in zip(range(4, 8), late, strict=True)]
    found = quantise_score(Score.from_notes(played, TEMPO))
    assert found.score.notes["tick"].tolist() == [i * SIXTEENTH for i in range(4, 8)]
    assert found.moved == 4
    assert found.furthest_ms == pytest.approx(15, abs=0.1)


def test_human_triplets_are_heard_as_triplets() -> None:
    found = fitted(snare(QUARTER + 5 * MS), snare(QUARTER + TRIPLET - 8 * MS), snare(QUARTER + 2 * TRIPLET + 10 * MS))
    assert [n.tick for n in found] == [QUARTER, QUARTER + TRIPLET, QUARTER + 2 * TRIPLET]


def test_exact_quintuplets_stay() -> None:
    ticks = [i * QUARTER // 5 for i in range(5)]
    found = fitted(*(snare(t) for t in ticks), snare(2 * QUARTER + 7 * MS))
    assert [n.tick for n in found][:5] == ticks


def test_a_stroke_just_before_the_beat_goes_to_it() -> None:
    assert [n.tick for n in fitted(snare(QUARTER - 10 * MS))] == [QUARTER]


def test_a_stroke_just_before_the_end_of_a_loop_goes_to_its_start() -> None:
    score = Score.from_notes([snare(WHOLE - 10 * MS)], TEMPO)
    found = quantise_score(score)
    assert found.score.notes["tick"].tolist() == [0]
    assert found.furthest_ms == pytest.approx(10, abs=0.1)


def test_velocities_become_the_dynamics_of_their_piece() -> None:
    found = fitted(*(snare(i * EIGHTH, v) for i, v in enumerate((30, 34, 70, 74, 90, 104, 118, 127))))
    assert [n.dynamic for n in found] == [Dynamic.GHOST] * 2 + [Dynamic.NORMAL] * 3 + [Dynamic.ACCENT] * 3
    assert [n.velocity for n in found] == [30, 30, 74, 74, 74, 118, 118, 118]  # the low medians


def test_three_hands_become_two_the_drum_set_first() -> None:
    found = fitted(snare(0), Note(0, Piece.TAMBOURINE, velocity=127), Note(0, Piece.HIHAT, Zone.BOW, velocity=60))
    assert {n.piece for n in found} == {Piece.SNARE, Piece.HIHAT}


def test_twins_become_one_the_louder() -> None:
    assert [n.velocity for n in fitted(snare(0, 70), snare(1, 90))] == [90]


def test_a_flam_keeps_its_grace_stroke_at_our_lead() -> None:
    found = fitted(
        Note(0, Piece.SNARE, velocity=20, lead_ms=22, ornament=Ornament.FLAM), Note(0, Piece.SNARE, velocity=90)
    )
    assert [(n.lead_ms, n.velocity, n.ornament) for n in found] == [(30, 36, Ornament.FLAM), (0, 90, Ornament.FLAM)]


def test_a_flam_beside_another_hand_loses_its_grace_stroke() -> None:
    found = fitted(
        Note(0, Piece.SNARE, velocity=20, lead_ms=22, ornament=Ornament.FLAM),
        Note(0, Piece.SNARE, ornament=Ornament.FLAM),
        Note(0, Piece.RIDE, Zone.BOW),
    )
    assert [n.lead_ms for n in found] == [0, 0]


def test_strokes_faster_than_two_hands_are_thinned_out() -> None:
    """Sixty-four strokes 31.25 ms apart. People need 476 ms for eleven, which is sixteen cells: at most 10 in 16."""
    found = fitted(*(snare(i * QUARTER // 16) for i in range(64)))
    assert 64 * 10 // 16 - 4 <= len(found) <= 64 * 10 // 16
    again = [n.tick for n in found] + [n.tick + WHOLE for n in found]
    for strokes, least_ms in ((3, 45), (5, 160), (11, 476)):
        lasts = [b - a for a, b in zip(again, again[strokes - 1 :], strict=False)]
        assert min(lasts) >= least_ms * MS


def test_the_last_kick_makes_room_for_the_first_of_the_next_loop() -> None:
    """A sixty-fourth before the end of the bar is 31 ms from its start, where the same foot plays again."""
    kicks = [Note(0, Piece.KICK), Note(WHOLE - QUARTER // 16, Piece.KICK)]
    assert len(fitted(*kicks)) == 1


def test_strokes_without_a_letter_become_the_nearest() -> None:
    found = fitted(
        Note(0, Piece.SNARE, Zone.EDGE),
        Note(QUARTER, Piece.HIHAT, Zone.BOW, openness=0.7),
        Note(2 * QUARTER, Piece.HIHAT, Zone.EDGE, openness=None),
        Note(3 * QUARTER, Piece.CRASH_1, Zone.EDGE, articulation=Articulation.BUZZ),
    )
    assert [(n.zone, n.openness, n.articulation) for n in found] == [
        (Zone.HEAD, None, Articulation.NORMAL),
        (Zone.BOW, 0.5, Articulation.NORMAL),
        (Zone.EDGE, 0.0, Articulation.NORMAL),
        (Zone.EDGE, None, Articulation.NORMAL),
    ]


def test_feet_get_their_limbs() -> None:
    found = fitted(Note(0, Piece.KICK), Note(QUARTER, Piece.HIHAT_PEDAL, Zone.PEDAL, articulation=Articulation.CHICK))
    assert [n.limb for n in found] == [Limb.RIGHT_FOOT, Limb.LEFT_FOOT]


def test_a_bouncing_beater_is_one_stroke() -> None:
    found = quantise_score(Score.from_notes([Note(0, Piece.KICK), Note(QUARTER // 8, Piece.KICK)], TEMPO))
    assert len(found.score) == 1  # 62 ms apart
    assert found.left_out == 1


def test_a_choke_that_comes_too_late_is_none() -> None:
    crash = Note(0, Piece.CRASH_1, Zone.EDGE)
    found = fitted(
        Note(0, Piece.CRASH_1, Zone.EDGE, choke_ticks=QUARTER + 5),
        Note(2 * QUARTER, Piece.CRASH_1, Zone.EDGE, choke_ticks=QUARTER),
        Note(3 * QUARTER, Piece.CRASH_1, Zone.EDGE, choke_ticks=2 * QUARTER),
    )
    assert [n.choke_ticks for n in found] == [QUARTER, 0, 0]
    assert crash.choke_ticks == 0


def test_a_buzz_lasts_until_the_next_stroke_at_most() -> None:
    buzz = Note(0, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL)
    found = fitted(
        Note(0, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=WHOLE), snare(EIGHTH), snare(QUARTER + 3)
    )
    assert found[0].duration_ticks == EIGHTH
    assert found[0].ornament is buzz.ornament


def test_tempo_changes_move_to_bars_and_cut_sections() -> None:
    tempo_map = TempoMap.build([TempoChange(0, 500_000), TempoChange(WHOLE + 100, 400_000)])
    score = Score.from_notes([snare(0), snare(WHOLE), snare(2 * WHOLE)], tempo_map)
    found = quantise_score(score)
    assert [t.tick for t in found.score.tempo_map.tempos] == [0, WHOLE]
    assert [(s.first_bar, s.last_bar) for s in lesson_of(found.score, "x", "x").sections] == [(0, 0), (1, 2)]


def test_sections_of_four_bars() -> None:
    score = Score.from_notes([snare(9 * WHOLE)], TEMPO)
    assert [(s.first_bar, s.last_bar) for s in lesson_of(score, "x", "x").sections] == [(0, 3), (4, 7), (8, 9)]


def test_a_bar_cut_short_gets_a_meter_of_its_own() -> None:
    tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(2 * QUARTER, 4, 4)])
    found = quantise_score(Score.from_notes([snare(0), snare(2 * QUARTER)], tempo_map))
    assert [(m.tick, m.beats, m.unit) for m in found.score.tempo_map.meters] == [(0, 2, 4), (2 * QUARTER, 4, 4)]
    write_lesson(lesson_of(found.score, "x", "x", found.velocities))


def test_a_bar_cut_where_no_meter_can_is_refused() -> None:
    tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(1001, 4, 4)])
    with pytest.raises(BadInput, match="a change of meter cuts it"):
        quantise_score(Score.from_notes([snare(0), snare(1001)], tempo_map))


@pytest.mark.parametrize(("title", "shown"), [("Song\x1b[2J\n two ", "Song [2J two"), ("\x00", "take")])
def test_of_a_title_what_can_be_printed_counts(title: str, shown: str) -> None:
    found = quantise_score(Score.from_notes([snare(0)], TempoMap()))
    lesson = lesson_of(found.score, "take", title, found.velocities)
    again = parse_lesson(write_lesson(lesson), "x", "x").lesson
    assert again
    assert (lesson.title, again.title) == (shown, shown)


@pytest.mark.parametrize("path", real_files("gmd/*/eval_session/*.mid"))
def test_what_people_played_becomes_a_lesson(path: Path) -> None:
    score = score_from_midi(read_midi(path))
    found = quantise_score(score)
    text = write_lesson(lesson_of(found.score, "x", "x", found.velocities))
    again = parse_lesson(text, "x", "x").lesson
    assert again
    assert again.score.bar_count == score.bar_count
    # The coarsest cells that human playing is given beside sixteenths are triplets: nobody moves by more than half one.
    assert found.furthest_ms <= 60_000 / score.tempo_map.bpm_at(0) / 6 + 1
    # Pressed ghost strokes bounce: several hits of a hand share a cell (up to 43 of 403 in these takes).
    assert found.left_out <= 0.12 * len(score)
