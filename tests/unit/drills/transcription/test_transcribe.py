"""Parts made lessons, from the strokes to the page; expected cells, bars and words by hand."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.drills.transcription.timing.take_feel import mean_error
from station.drills.transcription.transcribe import transcribe
from station.drills.writing.lesson_part import part_of
from station.drills.writing.score_difference import score_difference
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.smf.midi_part import MIDI
from station.music.grace_strokes import with_graces
from station.music.loudness_marks import LoudnessMark
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.unit.drills.reading import EIGHTH, QUARTER, SIXTEENTH, WHOLE, read

TEMPO = TempoMap.constant(120)
MS = QUARTER // 500
"""Ticks in a millisecond at 120 bpm (to within 0.02 %)."""


def lesson_from(*notes: Note, tempo_map: TempoMap = TEMPO) -> Lesson:
    return transcribe(DrumPart(Score.from_notes(notes, tempo_map)), "x").lesson


def snare(tick: int, velocity: int = 80) -> Note:
    return Note(tick, Piece.SNARE, velocity=velocity)


def through_midi(lesson: Lesson) -> Lesson:
    written = MIDI.write
    assert written
    return transcribe(MIDI.read(written(part_of(lesson)).data, "x.mid"), "x").lesson


# --- the beat that is counted -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("meter", "said", "beat"),
    [
        ((6, 8), None, 3 * EIGHTH),  # 6/8 is counted in two
        ((6, 8), EIGHTH, EIGHTH),
        ((6, 8), QUARTER, QUARTER),  # also where the file says what is usual elsewhere
        ((3, 4), None, QUARTER),
        ((7, 8), None, QUARTER),
    ],
)
def test_the_beat_is_what_the_part_says_or_what_is_usual(meter: tuple[int, int], said: int | None, beat: int) -> None:
    tempo_map = TempoMap.constant(120, *meter)
    strokes = [snare(k * EIGHTH) for k in range(meter[0] * 8 // meter[1] * 2)]
    part = DrumPart(Score.from_notes(strokes, tempo_map), said_beat_ticks=said)
    assert part.beat_ticks == beat
    assert transcribe(part, "x").lesson.beat_ticks == beat


# --- our own lessons through a MIDI file ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        *("rock-1", "funk-1", "ghosts-under-accents", "flam-taps-wide", "flam-accent", "drag", "single-ratamacue"),
        *("five-stroke-roll-fast", "long-roll-fast", "train-2", "six-eight-1"),
    ],
)
def test_a_lesson_comes_back_from_midi(name: str) -> None:
    """The hands and the hi-hat's edge MIDI cannot tell; all else comes back, the tempo and meter too."""
    lesson = find_lesson(name)
    again = through_midi(lesson).score
    assert score_difference(_without_hands(lesson.played_once, again.end_tick), _without_hands(again)) == ""


def _without_hands(score: Score, end_tick: int | None = None) -> Score:
    rows = score.notes.copy()
    rows["limb"] = np.where(np.isin(rows["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND)), Limb.UNKNOWN, rows["limb"])
    return Score.from_array(rows, score.tempo_map, end_tick or score.end_tick)


def test_the_hands_of_a_groove_are_named_as_its_author_did() -> None:
    """Rock 1 says R on the hi-hat and B where the snare falls, which MIDI does not."""
    assert through_midi(find_lesson("rock-1")).score.notes["limb"].tolist() == (
        find_lesson("rock-1").score.notes["limb"].tolist()
    )


def test_of_single_strokes_on_a_snare_nobody_knows_the_hands() -> None:
    assert "sticking" not in lesson_from(*(snare(i * SIXTEENTH) for i in range(16))).text


def test_a_sticking_that_the_file_says_stays() -> None:
    lesson = read('snare = "oooo"\nsticking = "LLRR"')
    assert 'sticking = "| L L R R |"' in transcribe(part_of(lesson), "x").lesson.text


def test_a_bar_that_only_a_grace_stroke_needed_is_no_bar() -> None:
    """A flam on the first beat sounds before the music: the MIDI file has an empty bar for it."""
    lesson = read('snare = "| F- o- F- o- |"', "tempo_bpm = 100")
    again = through_midi(lesson)
    assert again.score.bar_count == 1
    assert again.score[0].lead_ms == pytest.approx(30)


# --- times ------------------------------------------------------------------------------------------------------------


def test_two_flams_alike_in_loudness_share_what_suits_both() -> None:
    """0.3 of 116 is 35 and of 78 is 23; 35 / 116 would have 24."""
    lead = 30 * MS
    strokes = [snare(2 * QUARTER - lead, 35), snare(2 * QUARTER, 116), snare(3 * QUARTER - lead, 23)]
    found = lesson_from(snare(0, 116), snare(QUARTER, 78), *strokes, snare(3 * QUARTER, 78))
    assert [n.velocity for n in found.score if n.lead_ms] == [35, 23]


def test_the_silent_bars_before_a_take_are_none_of_the_lesson() -> None:
    """The first stroke comes 9 ms before its bar."""
    cells = [c for c in range(17, 48) if c % 8 not in (3, 6)]
    errors_ms = np.random.default_rng(5).normal(0, 8, len(cells))
    strokes = [snare(c * EIGHTH + round(ms * MS)) for c, ms in zip(cells, errors_ms.tolist(), strict=True)]
    found = lesson_from(snare(16 * EIGHTH - 9 * MS), *strokes)
    assert found.score.bar_count == 4
    assert (found.score.notes["tick"] // EIGHTH).tolist()[0] == 0


def test_a_pick_up_has_a_grid_of_its_own() -> None:
    grooves = [c for c in range(8, 40) if c % 8 not in (3, 6)]
    text = lesson_from(*(snare(c * EIGHTH) for c in (6, 7, *grooves))).text
    assert 'name = "pick-up"' in text
    assert "times = 4" in text


def test_a_pick_up_after_a_silent_bar_is_one() -> None:
    """Many a sequencer's song begins with a bar of nothing: the two bars before the groove are its pick-up."""
    grooves = [c for c in range(16, 48) if c % 8 not in (3, 6)]
    text = lesson_from(*(snare(c * EIGHTH) for c in (14, 15, *grooves))).text
    assert text.count('name = "pick-up') == 1
    assert text.index("| - ") < text.index('name = "A"') < text.index("times = 4")


def test_a_silent_bar_is_no_pick_up() -> None:
    grooves = [c for c in range(8, 40) if c % 8 not in (3, 6)]
    assert "pick-up" not in lesson_from(*(snare(c * EIGHTH) for c in grooves)).text


def test_human_sixteenths_go_to_the_nearest() -> None:
    late = (12, -9, 15, 4)
    played = [snare(i * SIXTEENTH + late[i % 4] * MS) for i in range(4, 16)]
    found = transcribe(DrumPart(Score.from_notes(played, TEMPO)), "x")
    assert found.lesson.score.notes["tick"].tolist() == [i * SIXTEENTH for i in range(4, 16)]
    assert any("12 strokes moved onto the grid" in remark for remark in found.remarks)


def test_a_swing_that_the_file_says_stays_where_its_times_are_exact() -> None:
    """Swung eighths at 1.5: the second of each pair falls on three fifths of the beat."""
    lesson = read('hihat = "xx xx xx xx"', "tempo_bpm = 120\nswing_ratio = 1.5")
    found = transcribe(part_of(lesson), "x").lesson
    assert found.swing == lesson.swing
    assert found.score.notes["tick"].tolist() == [i * QUARTER + at for i in range(4) for at in (0, QUARTER * 3 // 5)]


def test_what_lies_on_the_grid_is_not_moved() -> None:
    part = DrumPart(Score.from_notes([snare(i * SIXTEENTH) for i in range(16)], TEMPO))
    assert transcribe(part, "x").remarks == ()


def test_a_tempo_that_only_wanders_is_one_tempo() -> None:
    """Two bars a step, 119 to 121 bpm: a band's, and no teacher writes it down."""
    tempos = [TempoChange.from_bpm(bar * WHOLE, bpm) for bar, bpm in enumerate((120, 119, 121, 120.5, 119.5, 120))]
    tempo_map = TempoMap.build(tempos)
    lesson = lesson_from(*(snare(i * QUARTER) for i in range(24)), tempo_map=tempo_map)
    assert [t.us_per_quarter for t in lesson.score.tempo_map.tempos] == [500_000]


def heard_meter(bar: str, count: int = 12, *, is_meter_said: bool = False) -> str:
    """What a part is heard in whose bar of eighths has kicks (k) and snares (s), over a hi-hat on every one."""
    pieces = {"k": Piece.KICK, "s": Piece.SNARE}
    cells = [(i * EIGHTH, c) for i, c in enumerate(bar * count)]
    notes = [Note(tick, Piece.HIHAT) for tick, _ in cells] + [Note(tick, pieces[c]) for tick, c in cells if c in pieces]
    part = DrumPart(Score.from_notes(notes, TEMPO), is_meter_said=is_meter_said)
    found = transcribe(part, "x")
    meter = str(found.lesson.score.tempo_map.meters[0])
    assert (f"no meter in it: heard as {meter}" in found.remarks) is (meter != "4/4")
    return meter


@pytest.mark.parametrize(
    ("bar", "meter"),
    [("k-s-s-", "3/4"), ("k--s--", "6/8"), ("k-s-k-s", "7/8"), ("k--k--s-k-", "5/4"), ("k-s-kks-", "4/4")],
)
def test_a_file_that_says_no_meter_is_heard(bar: str, meter: str) -> None:
    assert heard_meter(bar) == meter


def test_a_meter_that_the_file_says_stays() -> None:
    """Three against four is music, too."""
    assert heard_meter("k-s-s-", is_meter_said=True) == "4/4"


def test_a_tempo_whose_microseconds_were_cut_off_is_the_whole_number() -> None:
    """60 000 000 / 110 is 545 454.54…, which some programs round down."""
    tempo_map = TempoMap.build([TempoChange(0, 545454)], [MeterChange(0, 4, 4)])
    assert "tempo_bpm = 110\n" in lesson_from(snare(0), snare(QUARTER), tempo_map=tempo_map).text


def test_a_tempo_that_really_changes_does() -> None:
    tempo_map = TempoMap.build([TempoChange(0, 500_000), TempoChange(WHOLE + 100, 400_000)])
    lesson = lesson_from(*(snare(i * WHOLE) for i in range(3)), tempo_map=tempo_map)
    assert [(t.tick, t.us_per_quarter) for t in lesson.score.tempo_map.tempos] == [(0, 500_000), (WHOLE, 400_000)]


def test_a_bar_cut_short_gets_a_meter_of_its_own() -> None:
    tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(2 * QUARTER, 4, 4)])
    lesson = lesson_from(snare(0), snare(2 * QUARTER), tempo_map=tempo_map)
    assert [(m.tick, m.beats, m.unit) for m in lesson.score.tempo_map.meters] == [(0, 2, 4), (2 * QUARTER, 4, 4)]


def test_what_is_refused_names_the_file() -> None:
    with pytest.raises(BadInput, match=r"^songs/b\.mid: there is no drum note in it"):
        transcribe(DrumPart(Score.from_notes((), TEMPO)), "x", "songs/b.mid")
    with pytest.raises(BadInput, match=r"^songs/c\.mid: .*a lesson has at most 2000"):
        transcribe(DrumPart(Score.from_notes([snare(0), snare(2500 * WHOLE)], TEMPO)), "x", "songs/c.mid")


# --- what one player can play -----------------------------------------------------------------------------------------


def test_a_third_hand_is_marked_the_drum_set_first() -> None:
    part = DrumPart(
        Score.from_notes(
            [snare(0), Note(0, Piece.TAMBOURINE, velocity=127), Note(0, Piece.HIHAT, Zone.BOW, velocity=60)], TEMPO
        )
    )
    found = transcribe(part, "x")
    assert {n.piece for n in found.lesson.score} == {Piece.SNARE, Piece.HIHAT}
    assert found.lesson.beyond["piece"].tolist() == [Piece.TAMBOURINE]
    assert found.remarks == ("1 stroke beyond two hands and two feet, written *: bar 1",)
    assert "*" in found.lesson.text


def test_strokes_faster_than_two_hands_are_marked() -> None:
    """Sixty-four strokes of 31.25 ms. People need 476 ms for eleven, which is sixteen cells: at most 10 in 16."""
    lesson = lesson_from(*(Note(i * QUARTER // 16, Piece.HIHAT, Zone.BOW) for i in range(64)))
    assert 64 * 10 // 16 - 4 <= len(lesson.score) <= 64 * 10 // 16
    assert len(lesson.score) + len(lesson.beyond) == 64


def test_kicks_too_fast_for_one_foot_are_for_two() -> None:
    """Sixteenths at 200 bpm, as a double pedal plays them; after a rest of an eighth the right foot is on the beat."""
    fast = TempoMap.constant(200)
    kicks = [Note(i * SIXTEENTH, Piece.KICK) for i in range(16) if i not in (5, 6, 7)]
    found = lesson_from(*kicks, tempo_map=fast)
    assert len(found.beyond) == 0
    feet = {n.tick // SIXTEENTH: n.limb for n in found.score}
    assert feet == {i: Limb.LEFT_FOOT if i % 2 else Limb.RIGHT_FOOT for i in range(16) if i not in (5, 6, 7)}


def test_kicks_that_one_foot_can_play_are_the_right_foots() -> None:
    found = lesson_from(*(Note(i * SIXTEENTH, Piece.KICK) for i in (0, 1, 6, 7, 8)))
    assert {n.limb for n in found.score} == {Limb.RIGHT_FOOT}


def test_the_last_kick_makes_room_for_the_first_of_the_next_loop() -> None:
    """A sixty-fourth before the end of the bar is 31 ms from its start, where the same foot plays again."""
    lesson = lesson_from(Note(0, Piece.KICK), Note(WHOLE - QUARTER // 16, Piece.KICK))
    assert (len(lesson.score), len(lesson.beyond)) == (1, 1)


def test_a_flam_beside_another_hand_loses_its_grace_stroke() -> None:
    grace = Note(0, Piece.SNARE, velocity=20, lead_ms=22, ornament=Ornament.FLAM)
    lesson = lesson_from(grace, Note(0, Piece.SNARE, ornament=Ornament.FLAM), Note(0, Piece.RIDE, Zone.BOW))
    assert [n.lead_ms for n in lesson.score] == [0, 0]


def test_twins_become_one_the_louder() -> None:
    rim = Note(0, Piece.SNARE, Zone.RIM, velocity=60, articulation=Articulation.RIM_SHOT)
    assert len(lesson_from(rim, snare(0, 90)).score) == 1


def test_strokes_without_a_letter_become_the_nearest() -> None:
    lesson = lesson_from(
        Note(0, Piece.SNARE, Zone.EDGE),
        Note(QUARTER, Piece.HIHAT, Zone.BOW, openness=0.7),
        Note(2 * QUARTER, Piece.HIHAT, Zone.EDGE, openness=None),
        Note(3 * QUARTER, Piece.CRASH_1, Zone.EDGE, articulation=Articulation.BUZZ),
    )
    assert [(n.zone, n.openness, n.articulation) for n in lesson.score] == [
        (Zone.HEAD, None, Articulation.NORMAL),
        (Zone.BOW, 0.5, Articulation.NORMAL),
        (Zone.EDGE, 0.0, Articulation.NORMAL),
        (Zone.EDGE, None, Articulation.NORMAL),
    ]


def test_feet_get_their_limbs() -> None:
    chick = Note(QUARTER, Piece.HIHAT_PEDAL, Zone.PEDAL, articulation=Articulation.CHICK)
    assert [n.limb for n in lesson_from(Note(0, Piece.KICK), chick).score] == [Limb.RIGHT_FOOT, Limb.LEFT_FOOT]


def test_a_choke_that_comes_too_late_is_none() -> None:
    lesson = lesson_from(
        Note(0, Piece.CRASH_1, Zone.EDGE, choke_ticks=QUARTER),
        Note(2 * QUARTER, Piece.CRASH_1, Zone.EDGE, choke_ticks=QUARTER),
        Note(3 * QUARTER, Piece.CRASH_1, Zone.EDGE, choke_ticks=2 * QUARTER),
    )
    assert [n.choke_ticks for n in lesson.score] == [QUARTER, 0, 0]


def test_a_buzz_lasts_until_the_next_stroke_at_most() -> None:
    buzz = Note(0, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=WHOLE)
    found = lesson_from(buzz, snare(EIGHTH), snare(QUARTER)).score
    assert (found[0].duration_ticks, found[0].ornament) == (EIGHTH, Ornament.ROLL)


# --- the page ---------------------------------------------------------------------------------------------------------


def test_what_the_file_says_of_itself_stands_in_the_lesson() -> None:
    score = Score.from_notes([snare(0)], TEMPO)
    part = DrumPart(Score.from_array(score.notes, TEMPO, title="Song\x1b[2J\n two "), "A. Drummer", "Quietly.")
    lesson = transcribe(part, "x").lesson
    assert (lesson.title, lesson.author, lesson.about) == ("Song [2J two", "A. Drummer", "Quietly.")


def test_without_a_title_it_has_the_lessons_name() -> None:
    part = DrumPart(Score.from_array(Score.from_notes([snare(0)], TEMPO).notes, TEMPO, title="\x00"))
    assert transcribe(part, "blue moon", "songs/a.mid").lesson.title == "blue moon"


def test_the_files_sections_are_the_lessons() -> None:
    bars = [snare(bar * WHOLE + beat * QUARTER) for bar in range(4) for beat in ((1, 3) if bar < 2 else (0, 2))]
    part = DrumPart(Score.from_notes(bars, TEMPO), sections=(PartSection("verse", 0, 1), PartSection("chorus", 2, 3)))
    lesson = transcribe(part, "x").lesson
    assert [(s.name, s.first_bar, s.last_bar) for s in lesson.sections] == [("verse", 0, 1), ("chorus", 2, 3)]


def test_every_import_says_its_dynamics_as_the_player_has_them() -> None:
    ghosts_and_backbeats = [snare(i * EIGHTH, 112 if i % 4 == 2 else 30) for i in range(8)]
    lesson = lesson_from(*ghosts_and_backbeats)
    assert Counter(n.dynamic for n in lesson.score) == {Dynamic.ACCENT: 2, Dynamic.GHOST: 6}
    assert {n.velocity for n in lesson.score} == {30, 112}


# --- what a teacher reads ---------------------------------------------------------------------------------------------


def test_tempo_and_swing_are_numbers_that_people_write() -> None:
    """666,666 µs are 90.00009 a minute, cut off by a program that means 90; 39 : 25 is how Hydrogen says 1.56."""
    pairs = [snare(beat * QUARTER) for beat in range(8)]
    late = round(QUARTER / 2 * 2 * 39 / 64)
    off = [Note(beat * QUARTER + late, Piece.SNARE, velocity=80, swing_ticks=late - EIGHTH) for beat in range(8)]
    tempo_map = TempoMap.build([TempoChange(0, 666_666)])
    part = DrumPart(Score.from_notes([*pairs, *off], tempo_map), swing=Swing(39 / 25))
    found = transcribe(part, "x")
    assert "tempo_bpm = 90\n" in found.lesson.text
    assert "swing_ratio = 1.56\n" in found.lesson.text
    assert found.remarks == ("swing 1.56:1 of eighths",)


def test_changes_of_tempo_within_bars_are_no_moved_strokes() -> None:
    tempos = [TempoChange.from_bpm(beat * QUARTER, 160 - 20 * (beat % 4)) for beat in range(16)]
    part = DrumPart(Score.from_notes([snare(i * QUARTER) for i in range(16)], TempoMap.build(tempos)))
    remarks = transcribe(part, "x").remarks
    assert any(remark.startswith("15 changes of tempo written as ") for remark in remarks)
    assert not any("moved" in remark for remark in remarks)


def test_a_flam_beside_a_hi_hat_is_told_with_its_bar() -> None:
    hats = [Note(i * QUARTER, Piece.HIHAT, Zone.BOW, velocity=80) for i in range(8)]
    flam = Note(5 * QUARTER, Piece.SNARE, velocity=80, ornament=Ornament.FLAM)
    part = DrumPart(Score.from_notes([*hats, *with_graces(flam)], TEMPO))
    assert "1 ornament without grace strokes, for which no hand is free: bar 2" in transcribe(part, "x").remarks


def test_a_bar_that_comes_again_has_the_same_hands() -> None:
    """samba-1 begins with a bar that comes again as its third; on the drum's head its hands are not sure at first."""
    part = part_of(find_lesson("samba-1"))
    rows = part.score.notes.copy()
    snare = rows["piece"] == Piece.SNARE
    rows["articulation"][snare], rows["zone"][snare] = Articulation.NORMAL, Zone.HEAD
    rows["limb"] = Limb.UNKNOWN
    bare = Score.from_array(rows, part.score.tempo_map, part.score.end_tick)
    lesson = transcribe(DrumPart(bare), "x").lesson
    hands = [lesson.score.bars(bar, bar).notes["limb"].tolist() for bar in (0, 2)]
    assert hands[0] == hands[1]
    assert Limb.LEFT_HAND in hands[0]


def test_two_strokes_far_apart_in_error_have_their_middle() -> None:
    """Neither lies near the middle of both: there is no slip to leave out."""
    assert mean_error(np.array([-1.0, 1.0]), 0.01) == 0.0


def test_a_flam_closer_than_a_lesson_may_say_is_written_as_the_usual_one() -> None:
    """5 ms apart at 20 beats a minute: a lesson says 10 ms at the least."""
    notes = [Note(0, Piece.SNARE, velocity=1), Note(176, Piece.SNARE, velocity=1)]
    assert transcribe(DrumPart(Score.from_notes(notes, TempoMap.constant(20))), "x").lesson.score.is_grace.sum() <= 1


def groove(bar: int, fill: bool = False, late_ms: int = 0) -> list[Note]:
    """A bar of rock, or a fill of sixteenths that ends it; every other stroke so many ms late."""
    hats = [Note(i * EIGHTH, Piece.HIHAT, Zone.BOW, velocity=80, openness=0.0) for i in range(4 if fill else 8)]
    kicks = [Note(beat * QUARTER, Piece.KICK, velocity=80) for beat in (0, 2)]
    snares = [
        snare(QUARTER),
        *([snare(2 * QUARTER + i * SIXTEENTH) for i in range(8)] if fill else [snare(3 * QUARTER)]),
    ]
    notes = sorted([*hats, *kicks, *snares], key=lambda note: (note.tick, note.piece))
    late = [(i + bar) % 2 * late_ms * MS for i in range(len(notes))]
    return [replace(n, tick=bar * WHOLE + n.tick + by) for n, by in zip(notes, late, strict=True)]


def test_the_bars_of_a_takes_groove_are_told() -> None:
    notes = [note for bar in range(8) for note in groove(bar, fill=bar % 4 == 3, late_ms=9)]
    part = DrumPart(Score.from_notes(notes, TEMPO), is_played=True)
    told = [remark for remark in transcribe(part, "x").remarks if "groove" in remark]
    assert told == ["one groove: bars 1–3, 5–7 play bar 1, but for 2 strokes at most; not bars 4, 8"]


def test_of_what_a_program_wrote_no_groove_is_told() -> None:
    part = DrumPart(Score.from_notes([note for bar in range(8) for note in groove(bar)], TEMPO))
    assert transcribe(part, "x").remarks == ()


def test_a_long_piece_is_as_hard_as_two_of_its_bars() -> None:
    """Its fills, a bar in eight, are no more what is mostly played than they would be in a book."""
    song = [note for bar in range(32) for note in groove(bar, fill=bar % 8 == 7)]
    assert lesson_from(*song).level == lesson_from(*groove(0), *groove(1)).level == 1


def test_loudness_marks_that_are_left_out_are_told() -> None:
    """In bars 1 and 2, of which the grid says none."""
    marks = (LoudnessMark(0, "p"), LoudnessMark(WHOLE, "f"))
    score = replace(Score.from_notes([*groove(0), *groove(1)], TEMPO), loudness=marks)
    assert "loudness marks and hairpins left out: bars 1–2" in transcribe(DrumPart(score), "x").remarks
