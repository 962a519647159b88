"""Texts of lessons laid out: expected texts are typed as a careful teacher would type them."""

import pytest

from station.core.toml.toml_source import load
from station.drills.library import lesson_names
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_text import show
from tests.same_lesson import first_difference
from tests.shipped_lesson import shipped_lesson
from tests.unit.drills.lesson_faults import GOOD

HEAD = 'title = "T"\n'


def shown(grid: str, head: str = HEAD) -> list[str]:
    """The rows below the first [grid] or [[grid]] of what is shown of these lines."""
    text = head + grid
    again = show(text)
    assert show(again) == again
    assert load(again)[0].keys() == load(text)[0].keys()
    return again.removeprefix(head).splitlines()[1:]


def test_lines_stand_under_each_other_and_under_their_count() -> None:
    assert shown('[grid]\nhihat="xxxx xxxx|x-x-x-x-"\nkick = "o---|--o-"\n') == [
        "#          1& 2& 3& 4&   1& 2& 3& 4&",
        'hihat = "| xx xx xx xx | x- x- x- x- |"',
        'kick  = "| o  -  -  -  | -  -  o  -  |"',
    ]


def test_what_a_teacher_wrote_besides_stays() -> None:
    grid = [
        "[[grid]]   # the first half",
        'name    =   "A"',
        "times = 0b11",
        "# mind the left foot",
        'snare = "o---"    # on one',
        "",
        "# the feet",
        "left_foot.kick = '-o--'",
    ]
    assert shown("\n".join(grid)) == [
        'name    =   "A"',
        "times = 0b11",
        "# mind the left foot",
        "#                   1 2 3 4",
        'snare          = "| o - - - |"    # on one',
        "",
        "# the feet",
        "left_foot.kick = '| - o - - |'",
    ]


def test_repeats_stay_and_stand_under_the_bars_that_they_repeat() -> None:
    assert shown('[grid]\nsnare = "o|%3|x"\nkick = "o|-|%|o|-"\nhihat = "x|%|%2|-"\n')[1:] == [
        'snare = "| o | %3        | x |"',
        'kick  = "| o | - | % | o | - |"',
        'hihat = "| x | % | %2    | - |"',
    ]


@pytest.mark.parametrize(
    ("keys", "line", "count", "row"),
    [
        ('meter = "6/8"\n', "xxxxxx", " 123 456", "xxx xxx"),
        ('meter = "12/8"\nbeat = "3/8"\n', "x" * 12, " 123 456 789 012", "xxx xxx xxx xxx"),
        ('meter = "7/8"\n', "xxxxxxx", " 1234567", "xxxxxxx"),
        ('meter = "7/8"\n', "x" * 14, " 1& 2& 3& 4& 5& 6& 7&", "xx xx xx xx xx xx xx"),
        ('meter = "3/4"\n', "x-x-(xxx)", " 1& 2&  3ta", "x- x- (xxx)"),
        ('meter = "3+2/4"\n', "xxxxxxxxxx", " 1& 2& 3& 4& 5&", "xx xx xx xx xx"),
        ('meter = "3+2+2/8"\n', "x" * 14, " 1&2&3& 1&2& 1&2&", "xxxxxx xxxx xxxx"),
        ('meter = "3+2+2/8"\n', "(xx)xx(xxx)", "  1   12  1", "(xx) xx (xxx)"),
        ('meter = "2/2"\n', "xxxx", " 1& 2&", "xx xx"),
        ('beat = "1/2"\n', "(xxx)xx", "  1    3 4", "(xxx) x x"),
        ('meter = "6/8"\nbeat = "3/8"\n', "(xx)xxx", "  1   456", "(xx) xxx"),
        ("", "x", " 1", "x"),
        ("", "xx", " 1 3", "x x"),
        ("", "x" * 20, " 1···· 2···· 3···· 4····", "xxxxx xxxxx xxxxx xxxxx"),
    ],
)
def test_a_blank_stands_between_beats_as_the_meter_has_them(keys: str, line: str, count: str, row: str) -> None:
    assert shown(f'[grid]\n{keys}ride = "{line}"\n')[-2:] == [f"#        {count}", f'ride = "| {row} |"']


def test_an_older_count_is_renewed_and_other_comments_are_not() -> None:
    grid = '[grid]\n#        1& 2&\n# 1 is the loudest\nsnare = "oooo oooo oooo oooo"\n'
    assert shown(grid) == [
        "#          1e&a 2e&a 3e&a 4e&a",
        "# 1 is the loudest",
        'snare = "| oooo oooo oooo oooo |"',
    ]


def test_people_count_as_they_like() -> None:
    assert shown('[grid]\nmeter = "6/8"\n#  1&a 2&a\nsnare = "oooooo"\n')[1:] == [
        "#          1&a 2&a",
        'snare = "| ooo ooo |"',
    ]


def test_strings_of_several_rows_keep_their_rows() -> None:
    grid = '[grid]\nsnare = """oooo | o-o-|\n  %|o"""\nkick = """\n| o |\n| o | %2 |\n"""\n'
    assert shown(grid) == [
        'snare = """',
        "| o o o o | o - o - |",
        "| %       | o       |",
        '"""',
        'kick  = """',
        "| o |",
        "| o | %2 |",
        '"""',
    ]


def test_a_bar_that_runs_over_a_rows_end_stays_there() -> None:
    assert shown('[grid]\nsnare = """\noooo\noooo | o\n"""\n') == ['snare = """', "oooo", "oooo | o", '"""']


def test_lines_of_limb_tables_and_lists_in_braces() -> None:
    assert shown('[[grid]]\nsnare = "oo"\n[grid.right_hand]\nhihat = "xxxx"\n')[-3:] == [
        "[grid.right_hand]",
        "#          1 2 3 4",
        'hihat = "| x x x x |"',
    ]
    braces = 'grid = [{snare = "oooo"}, {kick = "o"}]\n'
    assert show(HEAD + braces) == HEAD + braces


def test_blanks_at_the_ends_of_rows_go_but_not_those_of_a_text() -> None:
    text = 'title = "T"  \r\nabout = """\r\nTwo  \r\n"""\t\r\n\r\n[grid]  \r\nsnare = "-o"\r\n\r\n\r\n'
    assert show(text) == 'title = "T"\nabout = """\nTwo  \n"""\n\n[grid]\n#          1 3\nsnare = "| - o |"\n'


@pytest.mark.parametrize("name", lesson_names())
def test_a_shipped_lesson_stands_as_it_is_shown(name: str) -> None:
    """If not: python -m tools.lesson_reference."""
    text = shipped_lesson(name).text
    assert show(text) == text


# --- the same lesson --------------------------------------------------------------------------------------------------


def test_a_lesson_that_uses_every_word_is_the_same_shown() -> None:
    lesson = parse_lesson(GOOD, "rich", "rich").lesson
    again = parse_lesson(show(GOOD), "rich", "rich").lesson
    assert lesson
    assert again
    assert first_difference(lesson, again) == ""
    assert show(show(GOOD)) == show(GOOD)


CHANGES = {
    "tempo_bpm = 80": "tempo_bpm = 81",
    'name = "intro"': 'name = "Intro"',
    "passes = 4": "passes = 5",
    "loop = [1, 4]": "loop = [1, 3]",
    'crash = "X"': 'crash = "x"',
    "max_sd_ms = 30": "max_sd_ms = 31",
    "bars = [3, 4]": "bars = [3, 5]",
    '"Ghosts low"': '"Ghosts lower"',
    "the left hand alone": "the left hand",
    "x-x- x-x- x-x- x-x-": "x-x- x-x- x-x- x-X-",
    "share = 0.5": "share = 0.6",
    "p--- <---": "pp-- <---",
    '"rock-1", ': "",
    "swing_ratio = 1.5": "swing_ratio = 1.6",
}


@pytest.mark.parametrize("old", CHANGES)
def test_a_difference_is_seen(old: str) -> None:
    text = GOOD.replace(old, CHANGES[old]).replace('["intro"', '["Intro"' if "intro" in old else '["intro"')
    lesson, other = (parse_lesson(each, "rich", "rich") for each in (GOOD, text))
    assert other.faults == []
    assert lesson.lesson
    assert other.lesson
    assert first_difference(lesson.lesson, other.lesson) != ""
