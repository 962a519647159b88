"""Flams, drags and buzzes found in plain strokes; times and names by hand, after how they are taught to be played."""

import pytest

from station.core.pieces import Articulation, Ornament, Piece, Zone
from station.core.units import PPQ
from station.drills.transcription.strokes.ornament_finder import FoundOrnaments, found_ornaments
from station.music.grace_strokes import Graces
from station.music.score import Note, Score
from station.music.tempo import TempoMap

TEMPO = TempoMap.constant(120)


def found(*strokes: tuple[float, int], piece: Piece = Piece.SNARE) -> FoundOrnaments:
    """What is found in strokes at so many milliseconds, of such velocities."""
    notes = [Note(round(ms * PPQ / 500), piece, velocity=velocity) for ms, velocity in strokes]
    return found_ornaments(Score.from_notes(notes, TEMPO))


def names(*strokes: tuple[float, int], piece: Piece = Piece.SNARE) -> list[str]:
    """The ornament of each main stroke."""
    kinds = {Ornament.NONE: "stroke", Ornament.FLAM: "flam", Ornament.DRAG: "drag", Ornament.ROLL: "buzz"}
    return [kinds[note.ornament] for note in found(*strokes, piece=piece).mains]


@pytest.mark.parametrize("lead_ms", [12, 22, 30, 41])
def test_a_soft_stroke_shortly_before_a_louder_one_is_a_flam(lead_ms: float) -> None:
    assert names((500 - lead_ms, 35), (500, 100)) == ["flam"]
    assert found((500 - lead_ms, 35), (500, 100)).mains[0].velocity == 100


def test_two_hands_at_nearly_one_moment_are_a_flam() -> None:
    assert names((500, 90), (505, 96)) == ["flam"]


def test_a_pad_that_shakes_strikes_once() -> None:
    """Before or after the stroke, on any piece."""
    assert names((500, 110), (507, 20)) == ["stroke"]
    assert names((493, 20), (500, 110)) == ["stroke"]
    assert found((500, 110), (507, 20), piece=Piece.KICK).bounces == 1


def test_head_and_rim_at_once_are_one_stroke() -> None:
    rim = Note(0, Piece.SNARE, Zone.RIM, velocity=60, articulation=Articulation.RIM_SHOT)
    score = Score.from_notes([rim, Note(0, Piece.SNARE, velocity=90)], TEMPO)
    assert [(n.velocity, n.ornament) for n in found_ornaments(score).mains] == [(90, Ornament.NONE)]


@pytest.mark.parametrize(("first", "second"), [(110, 55), (84, 40), (60, 28)])
def test_two_soft_strokes_before_a_louder_one_are_a_drag(first: float, second: float) -> None:
    assert names((500 - first, 36), (500 - second, 40), (500, 100)) == ["drag"]


@pytest.mark.parametrize(("first", "second"), [(104, 43), (87, 44), (85, 47)])
def test_a_drag_whose_last_gap_is_as_short_as_a_flams_is_a_drag(first: float, second: float) -> None:
    assert names((500 - first, 35), (500 - second, 33), (500, 90), (1000, 80)) == ["drag", "stroke"]


def test_two_strokes_of_a_fast_roll_that_come_close_are_no_flam() -> None:
    """Thirty-seconds at 97 bpm, 77 ms apart, one of them 19 ms late and the next 19 ms early."""
    times = (500, 577, 654 + 19, 731 - 19, 808, 885)
    assert names(*((ms, 80 - i % 2) for i, ms in enumerate(times))) == ["stroke"] * 6


def test_two_strokes_of_a_run_as_close_as_a_flam_leave_no_hole_in_it() -> None:
    """Sixteenths at 150 bpm, 100 ms apart, one 29 ms late and the next 29 ms early."""
    times = (500, 600, 700, 800 + 29, 900 - 29, 1000, 1100, 1200)
    assert names(*((ms, 80 - i % 2) for i, ms in enumerate(times))) == ["stroke"] * 8


def test_a_run_whose_other_strokes_are_uneven_has_no_hole_either() -> None:
    """Thirty-seconds 77 ms apart at which a player's gaps are 60 to 95 ms, and one of them 40."""
    times = (500, 562, 654, 749, 789, 881, 946)
    assert names(*((ms, 80 - i % 2) for i, ms in enumerate(times))) == ["stroke"] * 7


def test_two_hands_alike_on_every_stroke_of_a_run_are_flams() -> None:
    """The same sixteenths, each a flam of 25 ms whose grace stroke is too loud."""
    assert names(*((500 + 100 * i + ms, 80) for i in range(8) for ms in (-25, 0))) == ["flam"] * 8


def test_of_a_roll_without_gaps_each_hands_stroke_is_a_buzz() -> None:
    """The other hand strikes while the last rebounds still sound."""
    one = ((0, 80), (32, 55), (64, 52), (96, 56), (128, 50))
    strokes = [(500 + 160 * i + ms, velocity) for i in range(4) for ms, velocity in one]
    assert names(*strokes) == ["buzz"] * 4


def test_a_press_roll_whose_rebounds_are_as_loud_is_told_by_the_beat() -> None:
    """Sixteenths at 120 bpm, rebounds every 30 ms, each hand's stroke a quarter louder than the rebounds."""
    rebounds = ((0, 70), (30, 52), (60, 58), (90, 49))
    strokes = [(500 + 125 * i + ms, velocity + i % 3) for i in range(8) for ms, velocity in rebounds]
    result = found(*strokes)
    assert [round(note.tick / (PPQ // 4)) for note in result.mains] == list(range(4, 12))
    assert result.buzzes == 8


def test_the_last_rebounds_before_the_other_hand_are_no_drag() -> None:
    """Sixteenths at 90 bpm, each hand's stroke with four rebounds, of which some lose a quarter and some little."""
    rebounds = ((0, 80), (34, 64), (64, 48), (97, 36), (131, 33))
    strokes = [(500 + 166.7 * i + ms, velocity) for i in range(3) for ms, velocity in rebounds]
    assert names(*strokes) == ["buzz"] * 3


def test_a_soft_stroke_alone_before_a_louder_one_is_a_wide_flam() -> None:
    assert names((0, 80), (446, 35), (500, 100), (1000, 80)) == ["stroke", "flam", "stroke"]


def test_flams_of_slow_sixteenths_are_flams_whatever_two_of_their_gaps_are() -> None:
    """Sixteenths at 100 bpm, 150 ms apart, one of them so late that 110 ms are left to the next one's grace stroke."""
    strokes = [(150.0 * i, 80) for i in range(12)]
    strokes[5] = (strokes[5][0] + 20, 80)
    assert names(*strokes[:6], (150 * 6 - 35, 34), (150 * 6, 116), *strokes[7:])[6] == "flam"


def test_in_a_roll_without_flams_two_close_strokes_are_two() -> None:
    """Thirty-seconds at 97 bpm: a stroke of a roll late, the next early, 17 ms between them."""
    times = [77.0 * i for i in range(40)]
    times[20], times[21] = times[20] + 36, times[21] - 24
    assert names(*((ms, 80 + i % 2 * 3) for i, ms in enumerate(times))) == ["stroke"] * 40


def test_a_stroke_right_after_a_buzz_is_a_stroke() -> None:
    assert names((500, 80), (530, 60), (560, 50), (590, 45), (625, 90), (1000, 80)) == ["buzz", "stroke", "stroke"]


def test_a_drag_close_behind_the_last_accent_is_a_drag() -> None:
    """Sixteenths at 120 bpm: the grace strokes begin 15 ms after the note before them."""
    assert names((375, 100), (390, 40), (445, 40), (500, 100)) == ["stroke", "drag"]


def test_a_drag_so_close_that_it_might_be_the_pad_is_a_drag() -> None:
    assert names((375, 100), (383, 40), (440, 40), (500, 100)) == ["stroke", "drag"]


def test_a_run_of_thirty_seconds_is_no_drag() -> None:
    """62.5 ms apart at 120 bpm, growing."""
    assert names((437.5, 60), (500, 70), (562.5, 80), (625, 115)) == ["stroke"] * 4


def test_exact_ghost_thirty_seconds_stay_what_they_are_written_as() -> None:
    assert names((375, 32), (437.5, 32), (500, 116)) == ["stroke"] * 3


def test_fast_single_strokes_are_no_flams() -> None:
    """Sixteenths at 200 bpm, every other accented."""
    assert names(*((75 * i, (50, 110)[i % 2]) for i in range(8))) == ["stroke"] * 8


def test_rebounds_that_follow_each_other_at_once_are_a_buzz() -> None:
    """A press of five rebounds, 30 ms apart and dying away: it lasts from 500 to 650 ms."""
    press = [(500 + 30 * i, velocity) for i, velocity in enumerate((80, 60, 45, 30, 20))]
    (buzz,) = found(*press).mains
    assert (buzz.articulation, buzz.ornament, buzz.velocity) == (Articulation.BUZZ, Ornament.ROLL, 80)
    assert buzz.duration_ticks == pytest.approx(150 * PPQ / 500, abs=PPQ / 100)


def test_a_hi_hat_has_no_flams() -> None:
    assert names((480, 35), (500, 100), piece=Piece.HIHAT) == ["stroke", "stroke"]


def test_what_the_file_says_stays() -> None:
    grace = Note(PPQ, Piece.SNARE, velocity=40, lead_ms=25, ornament=Ornament.FLAM)
    main = Note(PPQ, Piece.SNARE, velocity=100, ornament=Ornament.FLAM)
    close = Note(PPQ + PPQ // 20, Piece.SNARE, velocity=120)
    result = found_ornaments(Score.from_notes([grace, main, close], TEMPO), Graces(flam_ms=25))
    assert (result.mains, result.graces.flam_ms) == ((main, close), 25)


def test_a_program_has_its_own_spacing_and_people_the_usual_one() -> None:
    exact = [(500.0 * i + ms, velocity) for i in range(1, 5) for ms, velocity in ((-22, 50), (0, 100))]
    assert found(*exact).graces == Graces(flam_ms=22, share=0.5)
    human = [(500.0 * i + ms, v) for i, lead in enumerate((18, 27.4, 33), 1) for ms, v in ((-lead, 50), (0, 100))]
    assert found(*human).graces.flam_ms == Graces().flam_ms
