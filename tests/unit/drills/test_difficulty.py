"""Measured difficulty: figures by hand, and orders that were written down by teachers before anything was measured."""

import pytest
from scipy.stats import spearmanr

from station.drills.difficulty import PARTS, difficulty, goal_difficulty, standings
from station.drills.lesson import Lesson
from station.drills.library import find_lesson, shipped_courses
from tests.shipped_lesson import shipped_lessons
from tests.unit.drills.reading import read
from tools.course_order import in_order, left_out, parts, with_parts
from tools.difficulty_table import PAGE, TEACHERS_ORDER

SINGLES = 'snare = "oooo oooo oooo oooo"\nsticking = "RLRL RLRL RLRL RLRL"'
AT_60, AT_120 = "tempo_bpm = 60", "tempo_bpm = 120"


def figures(grid: str, head: str = AT_60) -> dict[str, float]:
    return dict(difficulty(read(grid, head)).figures)


def test_the_weights_are_a_hundred_points() -> None:
    assert sum(part.weight for part in PARTS.values()) == 100
    assert all(0 <= part.free < part.full for part in PARTS.values())


def test_single_strokes_are_speed_and_nothing_else() -> None:
    """Sixteenths at 120 are eight strokes a second, four of each hand."""
    found = figures(SINGLES, AT_120)
    assert found["hands"] == 4
    assert found["limbs"] == 1
    assert {name for name, size in found.items() if size} == {"hands", "limbs"}
    assert difficulty(read(SINGLES, AT_120)).strokes_per_s == 8


def test_a_paradiddle_has_a_sticking() -> None:
    """Of four rights three are followed by a left, and of four lefts three by a right: H(1/4) = 0.8113 bits."""
    found = figures('snare = "oooo oooo"\nsticking = "RLRR LRLL"', 'tempo_bpm = 60\nmeter = "2/4"')
    assert found["sticking"] == pytest.approx(0.8113, abs=1e-4)


def test_the_first_groove_has_no_independence() -> None:
    """Kick and snare fall with the hat, always on the beat; which of them is all there is to know, at a quarter."""
    found = figures('hihat = "xx xx xx xx"\nsnare = "-- o- -- o-"\nkick = "o- -- o- --"')
    assert found["independence"] == 0
    assert found["rhythm"] == 0
    assert found["variety"] == 1  # two kinds of beat


def test_an_anticipated_kick_is_syncopated_and_a_backbeat_is_not() -> None:
    assert figures('snare = "-- o- -- o-"')["rhythm"] == 0
    assert figures('kick = "o- -o -- o-"')["rhythm"] == 0.25  # one in four beats


@pytest.mark.parametrize(
    ("easier", "harder"),
    [
        (SINGLES, SINGLES.replace("oooo", "oggO")),
        (SINGLES, SINGLES.replace("oooo", "fooo")),
        (SINGLES.replace("oooo", "fooo"), SINGLES.replace("oooo", "dooo")),
        ('snare = "xxxx"', 'snare = "(xxxxx) (xxxxx) (xxxxx) (xxxxx)"'),
        ('ride = "xx xx xx xx"\nkick = "o- o- o- o-"', 'ride = "xx xx xx xx"\nkick = "o- -o -o o-"'),
        ('ride = "xx xx xx xx"', 'ride = "xx xx xx xx"\nhihat_pedal = "-- x- -- x-"'),
    ],
)
def test_what_asks_for_more_is_harder(easier: str, harder: str) -> None:
    assert difficulty(read(harder)).total > difficulty(read(easier)).total


def test_swing_is_read_as_it_is_written() -> None:
    """A ratio of 1.6 puts the offbeat on no division of the beat; it is an eighth all the same."""
    grid = 'ride = "xx xx xx xx"'
    swung = figures(grid, "tempo_bpm = 60\nswing_ratio = 1.6")
    assert swung["rhythm"] == 0.5  # that it swings
    assert swung["independence"] == figures(grid)["independence"] == 0


def test_faster_is_never_easier() -> None:
    for name in ("rock-2", "funk-2", "flam-tap", "samba-1"):
        lesson = find_lesson(name)
        totals = [difficulty(lesson, bpm).total for bpm in (50, 70, 90, 120, 160)]
        assert totals == sorted(totals)
        assert totals[0] < totals[-1]


def test_a_roll_written_as_diddles_is_no_harder_for_the_hands_than_its_strokes() -> None:
    diddles = 'snare = "tt tt tt tt"\nsticking = "RL RL RL RL"'
    strokes = 'snare = "oooo oooo oooo oooo"\nsticking = "RRLL RRLL RRLL RRLL"'
    assert figures(diddles)["hands"] == 1.5  # a diddle a second of each hand, its second stroke a half
    assert figures(strokes)["hands"] == 2


def test_grooves_come_in_the_order_of_teachers() -> None:
    measured = [goal_difficulty(find_lesson(name)) for name in TEACHERS_ORDER]
    assert spearmanr(range(len(measured)), measured).statistic > 0.7


def test_exam_grades_rise() -> None:
    """Grade 1 asks for singles, doubles and paradiddles in eighths and sixteenths at 70; Grade 3 for flams, drags and
    triplets besides, at 75 (an examination board's technical exercises as a teacher's course lists them)."""
    lines = {"single": "RLRL RLRL RLRL RLRL", "double": "RRLL RRLL RRLL RRLL", "paradiddle": "RLRR LRLL RLRR LRLL"}
    grade_1 = [lesson("oooo oooo oooo oooo", hands, 70) for hands in lines.values()]
    grade_3 = [
        *(lesson("oooo oooo oooo oooo", hands, 75) for hands in lines.values()),
        lesson("f f f f", "R L R L", 75),
        lesson("d d d d", "R L R L", 75),
        lesson("oo (ooo) oo (ooo)".replace("oo (", "(oo)("), "(RL)(RLR) (LR)(LRL)", 75),
    ]
    assert max(map(goal_difficulty, grade_1[:1])) < min(map(goal_difficulty, grade_3[3:]))
    mean_1, mean_3 = (sum(map(goal_difficulty, grade)) / len(grade) for grade in (grade_1, grade_3))
    assert mean_1 < mean_3


def lesson(snare: str, sticking: str, tempo_bpm: int) -> Lesson:
    return read(f'snare = "{snare}"\nsticking = "{sticking}"', f"tempo_bpm = {tempo_bpm}")


def test_a_lesson_stands_where_what_it_needs_stands() -> None:
    needs = {"last": ["middle"], "middle": ["hard", "unknown"], "hard": [], "alone": [], "next": ["alone"]}
    found = standings(needs, {"last": 3.0, "middle": 5.0, "hard": 20.0, "alone": 4.0, "next": 6.0})
    assert found == {"alone": (4, 0), "next": (6, 0), "hard": (20, 0), "middle": (20, 1), "last": (20, 2)}


def test_lessons_that_name_each_other_still_stand_somewhere() -> None:
    assert set(standings({"a": ["b"], "b": ["a"]}, {"a": 1.0, "b": 2.0})) == {"a", "b"}


@pytest.fixture(scope="module")
def lessons() -> dict[str, Lesson]:
    return {one.name: one for one in shipped_lessons()}


@pytest.fixture(scope="module")
def hardness(lessons: dict[str, Lesson]) -> dict[str, float]:
    return {name: goal_difficulty(one) for name, one in lessons.items()}


def test_levels_given_by_hand_agree_with_what_is_measured(
    lessons: dict[str, Lesson], hardness: dict[str, float]
) -> None:
    assert spearmanr([lessons[name].level for name in hardness], list(hardness.values())).statistic > 0.5


def test_eight_courses_go_from_easy_to_hard_and_have_every_lesson(
    lessons: dict[str, Lesson], hardness: dict[str, float]
) -> None:
    courses, needs = shipped_courses(), {name: one.prerequisites for name, one in lessons.items()}
    standing = standings(needs, hardness)
    assert len(courses) == 8
    assert left_out(courses, list(lessons)) == []
    for course in courses:
        assert in_order(course, standing) == list(course.lessons), "python -m tools.course_order --write"
        at = {name: i for i, name in enumerate(course.lessons)}
        assert all(at[need] < at[name] for name in at for need in needs[name] if need in at)


def test_a_course_s_file_keeps_its_head_when_it_is_sorted() -> None:
    standing = {"a": (3.0, 0), "b": (13.0, 0), "c": (14.0, 0)}
    text = 'title = "T"\nabout = "lessons"\nlessons = [\n  "c",\n  "a",\n]\n'
    assert with_parts(text, parts(["a", "b", "c"], standing)) == (
        'title = "T"\nabout = "lessons"\n\n'
        '[[part]]\ntitle = "To begin with"\nlessons = [\n  "a",\n]\n\n'
        '[[part]]\ntitle = "The next step"\nlessons = [\n  "b",\n  "c",\n]\n'
    )


def test_the_page_has_every_lesson_of_every_course_as_it_is_measured(hardness: dict[str, float]) -> None:
    rows = [line.split(" | ") for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
    said = {row[0][2:]: float(row[4]) for row in rows if row[0][2:] in hardness}
    assert said == hardness, "python -m tools.difficulty_table"
