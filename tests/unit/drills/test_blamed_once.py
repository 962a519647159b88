"""One slip in a sound grid is told once, where it was made: what follows from it is not."""

import pytest

from tests.unit.drills.reading import faults

SOUND = """title = "T"
[[grid]]
snare = "o | o"
[[grid]]
name = "groove"
times = 3
hihat    = "| x-x- x-x- x-x- x-x- | % | ---- x-x- x-x- ---- |"
snare    = "| ---- o--- ---- o--- | % | ---- o--- o--- bb~~ |"
sticking = "| R-R- B-R- R-R- B-R- | % | R--- B-R- B-R- LR-- |"
crash    = "| ---- ---- ---- ---- | - | x-#- ---- ---- ---- |"
kick     = "| o--- --o- o--- --o- | % | - |"
loudness = "| mf-- ---- ---- ---- | % | <--- ---- ---- ---f |"
"""


def test_the_grid_is_sound() -> None:
    assert faults(SOUND) == []


SLIPS = {
    "a hi-hat cell too few": ("x-x- x-x- | %", "x-x- x-x | %", 7, "15 cells"),
    "a snare cell too few": ("---- o--- | % |", "---- o-- | % |", 8, "15 cells"),
    "a snare cell too few beside a buzz": ("o--- bb~~", "o--- bb~", 8, "15 cells"),
    "a snare cell too many": ("---- o--- o--- bb~~", "---- o---- o--- bb~~", 8, "17 cells"),
    "a sticking cell too few": ("B-R- LR--", "B-R- LR-", 9, "15 cells"),
    "a kick cell too few": ("--o- | % | - |", "--o | % | - |", 11, "15 cells"),
    "a loudness cell too few": ("<--- ---- ---- ---f", "<--- ---- ---- --f", 12, "15 cells"),
    "a crash cell too few beside a choke": ("x-#- ----", "x-# ----", 10, "15 cells"),
    "a letter of no snare": ("---- o--- o--- bb~~", "---- q--- o--- bb~~", 8, "'q' is no letter"),
    "a letter of no buzz": ("bb~~", "bq~~", 8, "'q' is no letter"),
    "a letter of no crash": ("x-#-", "k-#-", 10, "'k' is no letter"),
    "a bar lost": ("x-x- | % | ----", "x-x- | ----", 7, "2 bars, but"),
    "a bar line too many": (
        "---- o--- | % |",
        "---- | o--- | % |",
        8,
        "4 bars, but kick has 3; is a bar line too many?",
    ),
    "a sticking bar too many": ("LR-- |", "LR-- | % |", 9, "4 bars, but"),
    "a repeat too many": ("--o- | % | - |", "--o- | %2 | - |", 11, "4 bars, but"),
    "a parenthesis without its partner": ("o--- bb~~", "(o-o bb~~", 8, "'(' without its partner"),
    "a wrong hand letter": ("B-R- LR--", "B-Q- LR--", 9, "'Q' is no sticking"),
    "a hand where none strikes": ("B-R- LR--", "B-RL LR--", 9, "L says a hand, but no hand strikes here"),
    "one hand too few": ("R--- B-R- B-R-", "R--- B-R- R-R-", 9, "two strokes here (snare and hihat)"),
    "a line that nobody knows": ('snare    = "| ----', 'snair    = "| ----', 8, "no such line: snair"),
    "a meter that is none": ('name = "groove"', 'name = "groove"\nmeter = "5/3"', 6, "expected a meter"),
    "a beat that is none": ('name = "groove"', 'name = "groove"\nbeat = "1/5"', 6, "expected a note length"),
    "a meter that is none, for two grids": ('snare = "o | o"', 'meter = "4"\nsnare = "o | ooo"', 3, "expected a meter"),
    "three strokes at once": ('kick     = "|', 'tom_1    = "| -o-- | - | - |"\nkick     = "|', 11, "3 hands needed"),
    "a mark that is none": ("mf--", "mmf-", 12, "'mmf' is no loudness"),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_each_slip_is_told_once(slip: str) -> None:
    good, bad, line, words = SLIPS[slip]
    assert SOUND.count(good) == 1, "the slip is made at one place"
    (fault,) = faults(SOUND.replace(good, bad))
    assert fault.line == line, fault
    assert words in fault.text
