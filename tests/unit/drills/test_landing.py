"""What the last loop lands on: velocities from the default table, leads from HUMANS' flam."""

import pytest

from station.core.pieces import Dynamic, Limb, Piece
from station.core.toml.toml_faults import Faults
from station.core.units import PPQ
from station.drills.grid.grid_timing import GridTiming
from station.drills.grid.landing import read_landing
from station.drills.grid.stroke_settings import StrokeSettings
from station.music.grace_strokes import Graces
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoMap

TIMING = GridTiming(80, (MeterChange(0, 4, 4),), PPQ, settings=StrokeSettings(graces=Graces(flam_ms=20)))


def landed(table: dict[str, object]) -> list[Note]:
    faults = Faults()
    rows, _ = read_landing(table, TIMING, faults)
    assert faults.noted == []
    return list(Score.from_array(rows, TempoMap()))


def test_crash_and_kick_on_one() -> None:
    kick, crash = landed({"crash": "X", "kick": "o", "sticking": "R"})
    assert (kick.tick, kick.piece, kick.limb, kick.velocity) == (0, Piece.KICK, Limb.RIGHT_FOOT, 80)
    assert (crash.tick, crash.piece, crash.limb, crash.velocity) == (0, Piece.CRASH_1, Limb.RIGHT_HAND, 116)
    assert crash.dynamic is Dynamic.ACCENT


def test_a_limb_table_and_both_hands() -> None:
    (crash,) = landed({"left_hand": {"crash": " x "}})
    assert crash.limb is Limb.LEFT_HAND
    assert [n.limb for n in landed({"ride": "x", "snare": "o", "sticking": "B"})] == [Limb.LEFT_HAND, Limb.RIGHT_HAND]


def test_a_flam_lands_with_its_grace_stroke() -> None:
    grace, main = landed({"snare": "f"})
    assert (grace.lead_ms, grace.velocity, main.lead_ms) == (20, 32, 0)


@pytest.mark.parametrize(
    ("table", "path", "words"),
    [
        ({"crash": "xx"}, ("landing", "crash"), 'expected one letter that is struck, such as "X"'),
        ({"crash": "-"}, ("landing", "crash"), "expected one letter that is struck"),
        ({"snare": "b", "crash": "~"}, ("landing", "crash"), "expected one letter that is struck"),
        ({"snare": "u"}, ("landing", "snare"), "a diddle is two strokes"),
        ({"snare": "q"}, ("landing", "snare"), "'q' is no letter for a snare line"),
        ({"snare": "o", "sticking": "RL"}, ("landing", "sticking"), "expected one letter: R, L or B"),
        ({"snare": "o", "sticking": "B"}, ("landing", "sticking"), "B says both hands, but one strikes here"),
        ({"snair": "o", "ride": "x", "sticking": "B"}, ("landing", "snair"), "no such line: snair"),
        ({"snair": "o"}, ("landing", "snair"), "no such line: snair; did you mean snare?"),
        ({"left_foot": {"snare": "o"}}, ("landing", "left_foot", "snare"), "a foot plays no snare"),
        ({}, ("landing",), 'nothing to land on; expected a line such as crash = "X"'),
        ("X", ("landing",), 'expected a table, found "X"'),
    ],
)
def test_each_fault_is_told_once_at_its_place(table: object, path: tuple[str, ...], words: str) -> None:
    faults = Faults()
    read_landing(table, TIMING, faults)
    (fault,) = faults.noted
    assert fault.path == path
    assert words in fault.text
