"""Engraved bars, counted and measured: places by the published staff table, beams and signs by hand."""

import dataclasses
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.loudness_marks import LoudnessMark
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.render.notation.engraving import Engraver
from station.render.notation.rests import draw_rest
from station.render.notation.spelling.note_values import Value
from station.render.notation.staff import PLACES, NoteHead, head_of, height, ledger_steps
from station.render.notation.staff_rows import staff_rows
from station.render.notation.swing_words import swing_marks
from station.render.snapshot import BarNumbers
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, ShapeKind
from station.render.text.sign_outlines import sign_box
from tests.unit.render.scores import BAR, rock, score_of

ATLAS = Atlas()
Shapes = NDArray[np.void]


def bar_of(*notes: Note, bar: int = 0) -> Shapes:
    return Engraver(score_of(*notes), ATLAS).bar(bar)


def of_kind(shapes: Shapes, kind: ShapeKind) -> Shapes:
    return np.asarray(shapes[shapes["kind"] == kind])


def of_sign(shapes: Shapes, *names: str) -> Shapes:
    """The shapes of these signs."""
    uvs = [np.array(ATLAS.sign(name).uv, np.float32) for name in names]
    return np.asarray(shapes[np.any([(shapes["uv"] == uv).all(axis=1) for uv in uvs], axis=0)])


def signs(shapes: Shapes, name: str) -> int:
    return len(of_sign(shapes, name))


def letters(shapes: Shapes, character: str) -> int:
    from station.render.text.fonts import Face

    uv = np.array(ATLAS.letter(character, Face.BOLD).uv, np.float32)
    return int((shapes["uv"] == uv).all(axis=1).sum())


def beams(shapes: Shapes) -> list[float]:
    """Seconds that each beam spans."""
    thick = (shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"][:, 1], 0.25) & (shapes["time_s"][:, 1] > 0)
    return sorted(shapes["time_s"][thick, 1].tolist())


@pytest.mark.parametrize(
    ("piece", "step"),
    # bottom line E4 = 0: kick F4, snare C5, toms E5 D5 A4, hat G5, ride F5, crash A5, foot hat D4
    [
        (Piece.KICK, 1),
        (Piece.SNARE, 5),
        (Piece.TOM_1, 7),
        (Piece.TOM_2, 6),
        (Piece.FLOOR_TOM_1, 3),
        (Piece.HIHAT, 9),
        (Piece.RIDE, 8),
        (Piece.CRASH_1, 10),
        (Piece.HIHAT_PEDAL, -1),
    ],
)
def test_places_on_the_staff(piece: Piece, step: int) -> None:
    assert PLACES[piece].step == step


def test_no_two_pieces_are_written_alike() -> None:
    assert len({(p.step, p.head) for p in PLACES.values()}) == len(PLACES) == len(Piece)


def test_heads() -> None:
    assert head_of(Piece.SNARE, Zone.HEAD, Articulation.NORMAL) is NoteHead.ROUND
    assert head_of(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK) is NoteHead.CROSS
    assert head_of(Piece.RIDE, Zone.BELL, Articulation.NORMAL) is NoteHead.DIAMOND
    assert head_of(Piece.HIHAT, Zone.BOW, Articulation.NORMAL) is NoteHead.CROSS


def test_heights_and_ledger_lines() -> None:
    assert height(4) == 0
    assert height(8) == -2, "the top line is two spaces up"
    assert list(ledger_steps(10)) == [10]
    assert list(ledger_steps(9)) == []
    assert list(ledger_steps(12)) == [10, 12]
    assert list(ledger_steps(-1)) == []
    assert list(ledger_steps(-2)) == [-2]


def test_a_rock_bar() -> None:
    shapes = Engraver(rock(), ATLAS).bar(0)
    assert (signs(shapes, "head_cross"), signs(shapes, "head_round")) == (8, 4), "two snares and two kicks"
    assert beams(shapes) == pytest.approx([0.75] * 2), "each half bar's four eighths, a quarter of a second apart"
    assert letters(shapes, "R") == 8
    assert letters(shapes, "L") == 2


def test_bars_are_numbered_as_in_the_lesson_in_every_pass() -> None:
    twice = rock().repeated(4)
    numbers = BarNumbers(first=4, per_pass=2)  # bars 5 and 6 of a lesson, practised in two passes
    said = [numbers.of(bar) for bar in range(4)]
    assert said == [5, 6, 5, 6]
    shapes = Engraver(twice, ATLAS, numbers=numbers).bar(2)
    assert letters(shapes, "5") == 1
    assert letters(shapes, "3") == 0
    assert letters(Engraver(twice, ATLAS).bar(2), "3") == 1


def test_everything_of_a_note_is_anchored_at_its_time() -> None:
    shapes = bar_of(Note(PPQ, Piece.SNARE))
    heads = of_sign(shapes, "head_round")
    assert heads["time_s"].tolist() == [[0.5, 0.0]]
    assert heads["centre"][0] == pytest.approx([0.0, height(5)], abs=0.03)


def test_stems_of_hands_go_up_and_of_feet_down() -> None:
    shapes = bar_of(Note(0, Piece.SNARE), Note(0, Piece.KICK))
    stems = shapes[(shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"][:, 1], 0.06)]
    ends = {round(float(s["centre"][0]), 2): s for s in stems}
    assert set(ends) == {0.53, -0.53}, "right of the head when up, left when down"
    assert ends[0.53]["centre"][1] < height(5) < height(1) < ends[-0.53]["centre"][1]


@pytest.mark.parametrize(
    ("note", "sign", "count"),
    [
        (Note(0, Piece.SNARE, dynamic=Dynamic.ACCENT), "accent", 1),
        (Note(0, Piece.SNARE), "accent", 0),
        (Note(0, Piece.SNARE, dynamic=Dynamic.GHOST), "bracket_left", 1),
        (Note(0, Piece.SNARE, dynamic=Dynamic.GHOST), "bracket_right", 1),
        (Note(0, Piece.SNARE, articulation=Articulation.BUZZ), "buzz", 1),
        (Note(0, Piece.SNARE, Zone.RIM, articulation=Articulation.RIM_SHOT), "head_slashed", 1),
        (Note(0, Piece.RIDE, Zone.BELL), "head_diamond", 1),
        (Note(0, Piece.CRASH_1, Zone.EDGE, choke_ticks=PPQ), "choke", 1),
    ],
)
def test_signs_of_a_note(note: Note, sign: str, count: int) -> None:
    assert signs(bar_of(note), sign) == count


def test_open_half_open_and_closed_hats() -> None:
    def rings(*openness: float | None) -> int:
        notes = [Note(k * PPQ, Piece.HIHAT, Zone.BOW, openness=o) for k, o in enumerate(openness)]
        return len(of_sign(bar_of(*notes), "hat_open", "hat_half"))

    assert rings(None, 0.0) == 0
    assert rings(1.0) == 1
    assert rings(0.5) == 1
    closing = bar_of(
        Note(0, Piece.HIHAT, Zone.BOW, openness=1.0),
        Note(PPQ, Piece.HIHAT, Zone.BOW, openness=0.0),
        Note(2 * PPQ, Piece.HIHAT, Zone.BOW, openness=0.0),
    )
    crosses = of_sign(closing, "hat_closed")["time_s"][:, 0].tolist()
    assert crosses == [0.5], "one +, on the first closed stroke after the open one"


@pytest.mark.parametrize(("how", "count"), [(Articulation.CHICK, 0), (Articulation.SPLASH, 1)])
def test_a_hat_that_the_foot_has_closed_is_not_told_to_close(how: Articulation, count: int) -> None:
    shapes = bar_of(
        Note(0, Piece.HIHAT, Zone.BOW, openness=1.0),
        Note(PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, articulation=how),
        Note(2 * PPQ, Piece.HIHAT, Zone.BOW, openness=0.0),
    )
    assert signs(shapes, "hat_closed") == count


def test_flams_and_drags() -> None:
    main = Note(PPQ, Piece.SNARE, limb=Limb.RIGHT_HAND)
    flam = dataclasses.replace(main, limb=Limb.LEFT_HAND, lead_ms=30.0, ornament=Ornament.FLAM)
    heads = of_sign(bar_of(main, flam), "head_round")
    assert len(heads) == 2
    small = heads[np.argmin(heads["half"][:, 0])]
    assert small["centre"][0] < -1, "before the main note"
    assert small["time_s"][0] == 0.5, "on its tick: its spacing belongs to the hand"
    shapes = bar_of(main, flam)
    assert (letters(shapes, "l"), letters(shapes, "L"), letters(shapes, "R")) == (0, 1, 1), "no l that could be an I"
    from station.render.text.fonts import Face

    left, right = (np.array(ATLAS.letter(letter, Face.BOLD).uv, np.float32) for letter in "LR")
    small, large = (shapes[(shapes["uv"] == uv).all(axis=1)][0] for uv in (left, right))
    assert small["half"][1] < 0.8 * large["half"][1], "the grace stroke's is small"
    assert small["centre"][0] < large["centre"][0]
    drag = [dataclasses.replace(flam, lead_ms=ms, ornament=Ornament.DRAG) for ms in (80.0, 40.0)]
    places = of_sign(bar_of(main, *drag), "head_round")["centre"][:, 0]
    assert len(set(places.tolist())) == 3


def test_a_tuplet_has_its_number() -> None:
    triplet = [Note(round(k * PPQ / 3), Piece.SNARE) for k in range(3)]
    assert signs(bar_of(*triplet), "tuplet_3") == 1
    eighths = [Note(k * PPQ // 2, Piece.SNARE) for k in range(2)]
    assert signs(bar_of(*eighths), "tuplet_3") == 0


def test_a_single_eighth_has_a_flag_and_two_have_a_beam() -> None:
    single = bar_of(Note(PPQ // 2, Piece.SNARE))
    assert (signs(single, "flag_8"), beams(single)) == (1, [])
    both = bar_of(Note(0, Piece.SNARE), Note(PPQ // 2, Piece.SNARE))
    assert (signs(both, "flag_8"), len(beams(both))) == (0, 1)


def test_secondary_beams_and_stubs() -> None:
    shapes = bar_of(Note(0, Piece.SNARE), Note(3 * PPQ // 4, Piece.SNARE))
    assert beams(shapes) == pytest.approx([0.375])
    stubs = (shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"], [0.55, 0.25]).all(axis=1)
    assert stubs.sum() == 1


def test_a_silent_bar_has_a_whole_rest() -> None:
    shapes = bar_of(Note(BAR, Piece.SNARE), bar=0)
    blocks = of_sign(shapes, "rest_1")
    assert len(blocks) == 1
    assert blocks["time_s"][0, 0] == 1.0, "in the middle of the bar"


def test_rests_of_the_hands() -> None:
    shapes = bar_of(Note(0, Piece.SNARE), Note(2 * PPQ, Piece.SNARE))
    assert signs(shapes, "rest_4") == 2


def test_sticking_may_come_from_elsewhere() -> None:
    score = rock()
    limbs = np.where(score.notes["piece"] == Piece.HIHAT, Limb.LEFT_HAND, Limb.UNKNOWN).astype(np.int8)
    shapes = Engraver(score, ATLAS, limbs).bar(0)
    assert (letters(shapes, "L"), letters(shapes, "R")) == (8, 0)


def test_nothing_leaves_the_staff_s_room() -> None:
    everything = [
        Note(k * PPQ // 2, piece, zone, dynamic=Dynamic.ACCENT, openness=1.0)
        for k, (piece, zone) in enumerate(
            [
                (Piece.SPLASH, Zone.EDGE),
                (Piece.HIHAT, Zone.BOW),
                (Piece.KICK, Zone.HEAD),
                (Piece.HIHAT_PEDAL, Zone.PEDAL),
                (Piece.CHINA, Zone.EDGE),
                (Piece.FLOOR_TOM_2, Zone.HEAD),
            ]
        )
    ]
    shapes = bar_of(*everything)
    top, bottom = staff_rows(score_of(*everything)).reach
    upright = np.abs(shapes["axis"][:, 1]) * shapes["half"][:, 0]
    upright = np.where(shapes["kind"] == ShapeKind.GLYPH, shapes["half"][:, 1] - 5 / 22, upright)  # without its margin
    assert (shapes["centre"][:, 1] + upright).max() < bottom
    assert (shapes["centre"][:, 1] - upright).min() > top


def test_a_change_of_meter_tells_its_groups() -> None:
    tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(4 * PPQ, 7, 8, (3, 2, 2))])
    score = Score.from_notes([Note(0, Piece.SNARE), Note(4 * PPQ, Piece.SNARE)], tempo_map)
    shapes = Engraver(score, ATLAS).bar(1)
    assert [letters(shapes, character) for character in "3+8/"] == [1, 2, 1, 1]
    assert letters(shapes, "2") == 3, "two groups, and the bar's own number"


def test_a_new_tempo_is_a_number_and_a_ramp_a_word_with_its_target() -> None:
    steps = [TempoChange.from_bpm(8 * PPQ + k * PPQ // 4, 95 - 40 * k / 16) for k in range(16)]
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, 80), TempoChange.from_bpm(4 * PPQ, 95), *steps])
    engraver = Engraver(Score.from_notes([Note(11 * PPQ, Piece.SNARE)], tempo_map), ATLAS)
    bars = [engraver.bar(bar) for bar in range(3)]
    assert [letters(shapes, "=") for shapes in bars] == [0, 1, 1]
    assert [letters(shapes, "9") for shapes in bars] == [0, 1, 0]
    assert [(letters(bars[2], character)) for character in "rit."] == [1, 1, 2, 1]
    assert letters(bars[2], "5") == 2, "the target, 55"


def test_tempi_count_the_lesson_s_beat() -> None:
    """Dotted quarters: 90 quarters are 60 of them, and a ramp to 120 quarters goes to 80."""
    steps = [TempoChange.from_bpm(6 * PPQ + k * PPQ // 4, 90 + 30 * k / 12) for k in range(12)]
    six_eight = [MeterChange(0, 6, 8)]
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, 75), TempoChange.from_bpm(3 * PPQ, 90), *steps], six_eight)
    score = Score.from_notes([Note(8 * PPQ, Piece.SNARE)], tempo_map)
    engraver = Engraver(score, ATLAS, beat_ticks=3 * PPQ // 2)
    plain, ramp = engraver.bar(1), engraver.bar(2)
    assert [letters(plain, character) for character in "609"] == [1, 1, 0]
    assert [letters(ramp, character) for character in "8012"] == [1, 1, 0, 0]
    assert (signs(plain, "beat_4"), signs(plain, "beat_dot")) == (1, 1)
    assert signs(Engraver(score, ATLAS).bar(1), "beat_dot") == 0


# --- swing in words ---------------------------------------------------------------------------------------------------


def swung(*quarters: float, ratio: float = 1.6) -> list[Note]:
    """Snares at straight places, the eighths off the beat played late by `ratio`, at 120 bpm half a second a beat."""
    late = round(PPQ * ratio / (ratio + 1)) - PPQ // 2
    offs = [late if q % 1 == 0.5 else 0 for q in quarters]
    return [Note(round(q * PPQ) + off, Piece.SNARE, swing_ticks=off) for q, off in zip(quarters, offs, strict=True)]


def test_swung_eighths_are_written_straight_and_stand_where_they_sound() -> None:
    shapes = bar_of(*swung(0, 0.5, 1, 1.5, 2, 3))
    heads = of_sign(shapes, "head_round")
    heads = heads[heads["centre"][:, 1] > -2.0]  # those of the mark stand above
    late_s = 0.5 * 1.6 / 2.6
    assert sorted(heads["time_s"][:, 0].tolist()) == pytest.approx([0, late_s, 0.5, 0.5 + late_s, 1, 1.5], abs=1e-4)
    assert beams(shapes) == pytest.approx([0.5 + late_s], abs=1e-4), "one beam from the first beat to the late half"
    assert sum(signs(shapes, f"tuplet_{figure}") for figure in range(10)) == 0, "no tuplet"


def test_swing_is_said_where_it_begins_and_where_it_ends() -> None:
    straight = [Note(round(q * PPQ), Piece.SNARE) for q in (0, 0.5, 2)]
    bars = [straight, swung(0, 0.5), swung(1, 1.5), swung(0, 2), straight, straight]
    notes = [replace(note, tick=note.tick + bar * BAR) for bar, some in enumerate(bars) for note in some]
    found = swing_marks(score_of(*notes))
    assert {bar: round(mark.ratio, 2) for bar, mark in found.items()} == {1: 1.6, 4: 1.0}, "a plain bar says nothing"
    assert swing_marks(score_of(*straight)) == {}
    said = Engraver(score_of(*notes), ATLAS)
    assert [letters(said.bar(bar), "w") for bar in range(6)] == [0, 1, 0, 0, 0, 0]


def test_a_swing_that_nothing_straight_comes_before_is_said_at_the_start() -> None:
    bars = [swung(0, 1), swung(0, 0.5, ratio=2.0), swung(0, 0.5, ratio=3.0)]
    notes = [replace(note, tick=note.tick + bar * BAR) for bar, some in enumerate(bars) for note in some]
    found = swing_marks(score_of(*notes))
    assert {bar: (round(mark.ratio, 2), mark.unit_ticks) for bar, mark in found.items()} == {
        0: (2.0, PPQ // 2),
        2: (3.0, PPQ // 2),
    }


def test_swung_sixteenths_are_known_by_the_half_beat_that_is_not_late() -> None:
    late = round(PPQ / 2 * 1.4 / 2.4) - PPQ // 4
    places = [(0, 0), (PPQ // 4, late), (PPQ // 2, 0), (3 * PPQ // 4, late)]
    score = score_of(*(Note(tick + off, Piece.SNARE, swing_ticks=off) for tick, off in places))
    (mark,) = swing_marks(score).values()
    assert mark.ratio == pytest.approx(1.4, abs=0.01)
    assert mark.unit_ticks == PPQ // 4


# --- loudness ---------------------------------------------------------------------------------------------------------


def swell(*marks: tuple[int, str], limb: Limb = Limb.RIGHT_HAND) -> Score:
    """Two bars of quarters at 120 bpm, a second for two of them."""
    plain = score_of(*(Note(k * PPQ, Piece.SNARE, limb=limb) for k in range(8)))
    return replace(plain, loudness=tuple(LoudnessMark(quarter * PPQ, sign) for quarter, sign in marks))


def hairpin_openings(shapes: Shapes) -> list[tuple[float, float]]:
    """Where each step of a hairpin begins, in seconds, and how far apart its lines are there."""
    thin = (shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"][:, 1], 0.08) & (shapes["time_s"][:, 1] > 0)
    by_time: dict[float, list[float]] = {}
    for row in shapes[thin]:
        by_time.setdefault(float(row["time_s"][0]), []).append(float(row["centre"][1]))
    return [(time_s, max(ys) - min(ys)) for time_s, ys in sorted(by_time.items())]


def test_a_hairpin_opens_evenly_over_its_bars() -> None:
    engraver = Engraver(swell((0, "p"), (2, "<"), (6, "f")), ATLAS)
    first, second = (hairpin_openings(engraver.bar(bar)) for bar in (0, 1))
    assert first[0][0] == pytest.approx(1.0), "it begins on beat 3"
    assert second[0][0] == pytest.approx(2.0, abs=0.01), "at the bar line, or what no eye tells from it"
    assert first[0][1] < 0.05, "closed at first"
    assert first[-1][1] == pytest.approx(0.6, abs=0.05), "half way at the bar line: 1.2 spaces at the end"
    assert second[0][1] == pytest.approx(first[-1][1], abs=0.05)
    assert second[-1][1] == pytest.approx(1.2, abs=0.05)
    assert second[-1][0] < 3.0, "the mark ends it, on the second bar's beat 3"


def test_a_fading_hairpin_closes_and_marks_stand_at_their_beats() -> None:
    engraver = Engraver(swell((0, "f"), (1, ">"), (4, "p")), ATLAS)
    first, second = engraver.bar(0), engraver.bar(1)
    openings = [opening for _, opening in hairpin_openings(first)]
    assert openings == sorted(openings, reverse=True)
    assert (signs(first, "loud_f"), signs(first, "loud_p")) == (1, 0)
    assert (signs(second, "loud_f"), signs(second, "loud_p")) == (0, 1)
    assert hairpin_openings(second) == []


def test_loudness_stands_below_the_feet_and_makes_room_for_itself() -> None:
    loud, plain = swell((0, "p"), (1, "<"), (4, "f")), swell()
    signs_of = of_sign(Engraver(loud, ATLAS).bar(0), "loud_p")
    assert staff_rows(plain).bottom < signs_of["centre"][0, 1] < staff_rows(loud).bottom
    assert staff_rows(loud).top == staff_rows(plain).top


def test_the_hands_letters_stand_above_the_staff_and_the_feet_s_below() -> None:
    shapes = bar_of(
        Note(0, Piece.SNARE, limb=Limb.RIGHT_HAND),
        Note(0, Piece.KICK, limb=Limb.RIGHT_FOOT),
        Note(PPQ, Piece.KICK, limb=Limb.LEFT_FOOT),
    )
    from station.render.text.fonts import Face

    uv = np.array(ATLAS.letter("R", Face.BOLD).uv, np.float32)
    hand, foot = sorted(shapes["centre"][(shapes["uv"] == uv).all(axis=1), 1].tolist())
    assert hand < -5.4, "beyond the beams"
    assert foot > 4.35


def test_the_feet_s_letters_stand_where_both_feet_play_one_piece() -> None:
    def said(*limbs: Limb) -> tuple[int, int]:
        shapes = bar_of(*(Note(k * PPQ, Piece.KICK, limb=limb) for k, limb in enumerate(limbs)))
        return letters(shapes, "R"), letters(shapes, "L")

    assert said(Limb.RIGHT_FOOT, Limb.RIGHT_FOOT) == (0, 0), "whose else?"
    assert said(Limb.RIGHT_FOOT, Limb.LEFT_FOOT) == (1, 1)
    assert said(Limb.LEFT_FOOT) == (0, 1), "not the foot that is taken for granted"


# --- notes in brackets ------------------------------------------------------------------------------------------------


def test_a_soft_flam_s_grace_note_keeps_off_the_brackets() -> None:
    def grace_x(dynamic: Dynamic) -> float:
        grace = Note(PPQ, Piece.SNARE, lead_ms=30.0, dynamic=Dynamic.GHOST, ornament=Ornament.FLAM)
        main = Note(PPQ, Piece.SNARE, dynamic=dynamic, ornament=Ornament.FLAM)
        return float(of_sign(bar_of(grace, main), "head_round")["centre"][:, 0].min())

    assert grace_x(Dynamic.NORMAL) - grace_x(Dynamic.GHOST) > 0.436, "a bracket is so wide"


def test_a_dot_stands_outside_the_bracket() -> None:
    """A dotted eighth as a ghost: half a bracket is 0.22 spaces wide, half a dot 0.2."""
    soft = bar_of(Note(0, Piece.SNARE, dynamic=Dynamic.GHOST), Note(3 * PPQ // 4, Piece.SNARE))
    bracket, dot = of_sign(soft, "bracket_right"), of_sign(soft, "dot")
    assert dot["centre"][:, 0].min() > bracket["centre"][:, 0].max() + 0.22 + 0.2


@pytest.mark.parametrize(("step", "beams_drawn"), [(PPQ // 2, 1), (PPQ // 4, 2), (PPQ // 8, 5)])
def test_a_buzz_s_sign_stands_on_the_stem_clear_of_its_beams(step: int, beams_drawn: int) -> None:
    shapes = bar_of(*(Note(k * step, Piece.SNARE, articulation=Articulation.BUZZ) for k in range(PPQ // step)))
    thick = (shapes["kind"] == ShapeKind.BOX) & np.isclose(shapes["half"][:, 1], 0.25) & (shapes["time_s"][:, 1] > 0)
    lowest = (shapes["centre"][thick, 1] + 0.25).max()
    assert len(shapes[thick]) == beams_drawn
    uv = np.array(ATLAS.sign("buzz").uv, np.float32)
    buzz = shapes[(shapes["uv"] == uv).all(axis=1)]
    assert len(buzz) == PPQ // step
    assert (buzz["centre"][:, 1] - 0.464).min() > lowest, "its height in the metadata of the font"
    assert (buzz["centre"][:, 1] + 0.464).max() < of_sign(shapes, "head_round")["centre"][:, 1].min() - 0.5


@pytest.mark.parametrize(("hands", "count"), [(True, 1), (False, 0)])
def test_a_half_rest_below_the_staff_has_a_line_to_sit_on(hands: bool, count: int) -> None:
    """The feet's rest stands below the staff beside hands, and on its middle line where the feet alone play."""
    draw_list = DrawList(ATLAS)
    draw_rest(draw_list, Value(2), False, [] if hands else None)
    shapes = draw_list.shapes()
    lines = shapes[shapes["kind"] == ShapeKind.BOX]
    assert len(lines) == count
    assert all(line["half"][0] > sign_box("rest_2").width / 2 for line in lines)
    draw_rest(quarter := DrawList(ATLAS), Value(4), False, [])
    assert len(quarter.shapes()) == 1, "a quarter's hangs nowhere"


def test_a_short_rest_keeps_clear_of_the_grace_note_after_it() -> None:
    """Where time rolls sixteenths are 1.6 spaces apart; a beat begins with a rest, and a flam follows."""
    at = PPQ + PPQ // 4
    flam = (Note(at, Piece.SNARE, lead_ms=20.0), Note(at, Piece.SNARE, ornament=Ornament.FLAM))
    shapes = bar_of(Note(0, Piece.SNARE), *flam, Note(2 * PPQ, Piece.SNARE))
    rest = of_sign(shapes, "rest_16")
    heads = of_sign(shapes, "head_round")
    grace = heads[heads["half"][:, 0].argmin()]
    reach = rest["centre"][0, 0] + sign_box("rest_16").width / 2
    assert reach < 1.6 + grace["centre"][0] - 0.62 * sign_box("head_round").width / 2
