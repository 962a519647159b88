"""What a lesson asks beside its notes: goals of limbs and bars, hints, prerequisites, cues, the landing."""

import pytest

from station.core.pieces import Limb, Piece
from station.drills.lesson import BarCue, BarGoals, Lesson, PartGoals
from station.drills.reading.lesson_file import parse_lesson
from station.music.swing import Swing
from tests.unit.drills.reading import EIGHTH, SIXTEENTH, faults

ALL = """
title = "All"
tempo_bpm = 60
prerequisites = ["rock-1", "rock-2"]
form = "A, B, A"

[graces]
flam_ms = 20

[landing]
crash = "X"
kick = "o"
sticking = "R"

[hints]
weak_left = "A minute with the left alone."
late_snare = " Watch the stick. "

[goals]
max_loudness_error_db = 6

[goals.left_hand]
min_accuracy = 0.95
max_sd_ms = 20
max_lean_ms = 10
max_loudness_error_db = 3

[goals.right_foot]
max_lean_ms = 15

[[goals.bars]]
bars = [3, 4]
max_tempo_error_pct = 2

[[goals.bars]]
bars = [5, 5]
min_accuracy = 1

[[grid]]
name = "A"
times = 2
at = [
  {bar = 1, say = "Ghosts low", style = "funk"},
  {bar = 1, time = 2, camera = "left_hand"},
]
snare = "f---"

[[grid]]
name = "B"
swing_ratio = 2
swing_unit = "1/16"
at = [{bar = 1, say = "Now the fill"}]
snare = "oooo"
"""


@pytest.fixture(scope="module")
def lesson() -> Lesson:
    reading = parse_lesson(ALL, "all", "all")
    assert reading.faults == []
    assert reading.lesson
    return reading.lesson


def test_goals_of_limbs_and_bars(lesson: Lesson) -> None:
    assert dict(lesson.goals.limbs) == {
        Limb.LEFT_HAND: PartGoals(0.95, 20, 10, 3),
        Limb.RIGHT_FOOT: PartGoals(max_lean_ms=15),
    }
    assert lesson.goals.bars == (
        BarGoals(2, 3, PartGoals(max_tempo_error_pct=2)),
        BarGoals(4, 4, PartGoals(min_accuracy=1)),
    )
    assert lesson.goals.max_loudness_error_db == 6


def test_hints_and_prerequisites(lesson: Lesson) -> None:
    assert dict(lesson.hints) == {"weak_left": "A minute with the left alone.", "late_snare": "Watch the stick."}
    assert lesson.prerequisites == ("rock-1", "rock-2")


def test_cues_stand_at_the_bars_as_they_are_played(lesson: Lesson) -> None:
    """Bars from 0: A 0 and 1, B 2, A 3 and 4."""
    low, left = BarCue(0, "Ghosts low", "", "funk"), BarCue(1, "", "left_hand", "")
    assert [(c.bar, c.say, c.camera, c.style) for c in lesson.cues] == [
        (0, low.say, "", "funk"),
        (1, low.say, "", "funk"),
        (1, "", left.camera, ""),
        (2, "Now the fill", "", ""),
        (3, low.say, "", "funk"),
        (4, low.say, "", "funk"),
        (4, "", left.camera, ""),
    ]


def test_each_section_has_its_swing(lesson: Lesson) -> None:
    straight, swung = Swing(1.0, EIGHTH), Swing(2.0, SIXTEENTH)
    assert [s.swing for s in lesson.sections] == [straight, swung, straight]
    assert [(s.first_bar, s.last_bar) for s in lesson.sections] == [(0, 1), (2, 2), (3, 4)]
    assert lesson.swing == straight


def test_the_landing_and_the_graces(lesson: Lesson) -> None:
    assert lesson.landing["tick"].tolist() == [0, 0]
    assert sorted(lesson.landing["piece"].tolist()) == sorted([Piece.CRASH_1, Piece.KICK])
    assert lesson.landing["velocity"].tolist() == [80, 116]
    assert lesson.score.notes["lead_ms"].tolist()[:2] == [20, 0]


@pytest.mark.parametrize(
    ("old", "new", "line", "column", "words"),
    [
        ('"rock-2"]', '"rock-1"]', 4, 28, "rock-1 stands here twice"),
        ('"rock-2"]', '"test"]', 4, 28, "test is this lesson itself"),
        ('"rock-2"]', '""]', 4, 28, "expected a word"),
        ("flam_ms = 20", "flam_ms = 5", 8, 11, "flam_ms: expected a number from 10 to 80"),
        ('kick = "o"', 'kick = "oo"', 12, 9, "expected one letter that is struck"),
        ("weak_left", "weak_lefd", 16, 1, "no such fault: weak_lefd; did you mean weak_left?"),
        ('"A minute with the left alone."', '" "', 16, 13, 'expected a sentence such as "A minute'),
        ("max_loudness_error_db = 6", "max_loudness_error_db = 0", 20, 25, "expected a number from 0.5 to 40"),
        ("max_sd_ms = 20\n", "max_tempo_error_pct = 2\n", 24, 1, "expected below [[goals.bars]]"),
        ("goals.left_hand", "goals.left_hands", 22, 1, "no such key: left_hands; did you mean left_hand?"),
        ("[goals.right_foot]\nmax_lean_ms = 15", "[goals.right_foot]", 28, 1, "asks nothing; expected one of min_acc"),
        ("bars = [3, 4]", "bars = [4, 3]", 32, 8, "bar 3 comes before bar 4"),
        ("bars = [5, 5]", "bars = [5, 6]", 36, 12, "from 1 to 5, for so many bars are played; found 6"),
        ("bars = [5, 5]\n", "", 35, 1, "bars is missing; expected two bar numbers such as bars = [3, 4]"),
        ("bars = [5, 5]", "bars = 5", 36, 8, "expected two bar numbers such as [3, 4]"),
        ("max_tempo_error_pct = 2", "max_tempo_error_pct = 60", 33, 23, "expected a number from 0.1 to 50"),
        ('kick = "o"', 'kick = "o"\nsnare = "o"\nhihat = "x"', 11, 10, "3 hands needed at once"),
        ('kick = "o"', 'kick = "o"\nsnare = "f"', 11, 10, "with its grace strokes on the landing"),
    ],
)
def test_faults_of_what_is_asked(old: str, new: str, line: int, column: int, words: str) -> None:
    assert old in ALL
    text = ALL.replace(old, new)
    if "snare" in new:
        text = text.replace('sticking = "R"\n', "")
    found = faults(text)
    assert [(f.line, f.column) for f in found] == [(line, column)], found
    assert words in found[0].text


def test_the_landing_must_be_near_enough_for_the_hand() -> None:
    """The right hand plays the last of 32 cells of a bar at 170 bpm, 44 ms before it must be on the crash."""
    text = """title = "T"
tempo_bpm = 170
[landing]
right_hand.crash = "X"
[grid]
right_hand.snare = "---- ---- ---- ---- ---- ---- ---- ---o"
"""
    (found,) = faults(text)
    assert (found.line, found.column) == (4, 21)
    assert "the right hand needs 2 strokes in 44 ms; people need 45 on the landing" in found.text
    assert "playable up to 166 bpm" in found.text
    assert faults(text.replace("170", "166")) == []


@pytest.mark.parametrize(
    ("lines", "limb", "plays"),
    [
        ('kick = "o---"', "right_foot", True),
        ('kick = "o---"', "left_foot", False),
        ('left_foot.kick = "o---"', "right_foot", False),
        ('snare = "o---"', "left_hand", True),  # nobody says which hand
        ('snare = "oo--"\nsticking = "RR--"', "left_hand", False),
        ('kick = "o---"', "right_hand", False),
    ],
)
def test_a_goal_asks_of_a_limb_that_plays(lines: str, limb: str, plays: bool) -> None:
    found = faults(f'title = "T"\n[goals.{limb}]\nmax_sd_ms = 20\n[grid]\n{lines}\n')
    named = limb.replace("_", " ")
    assert [(f.line, f.column, f.text) for f in found] == (
        [] if plays else [(2, 1, f"the {named} plays nothing in this lesson")]
    )
