"""Beams by hand: outer beams over a beat or half a bar, inner ones that break, stubs that point to their own step."""

import pytest

from station.music.tempo import MeterChange
from station.render.notation.spelling.bar_spelling import spell_bar
from station.render.notation.spelling.beaming import beam_runs, beam_spans
from station.render.notation.spelling.note_values import BeatGroup, Stroke


def group_of(letters: str, beats: int = 1, unit: int = 4, accents: tuple[int, ...] = ()) -> BeatGroup:
    """The first group of a bar divided as the letters divide it, x where one is struck."""
    meter = MeterChange(0, beats, unit)
    ticks = [round(k * meter.bar_ticks / len(letters)) for k, letter in enumerate(letters) if letter == "x"]
    strokes = [Stroke(tick, is_accented=k in accents) for k, tick in enumerate(ticks)]
    return spell_bar(strokes, meter, meter.bar_ticks)[0]


def beams(group: BeatGroup) -> list[str]:
    """Beams as 0:1-3, the level and the notes; a stub as 1:2< or 1:2>."""
    return sorted(
        f"{span.level}:{span.first}" + ({-1: "<", 1: ">"}[span.stub] if span.stub else f"-{span.last}")
        for span in beam_spans(group)
    )


@pytest.mark.parametrize(
    ("letters", "expected"),
    [
        ("xx", ["0:0-1"]),
        ("xxxx", ["0:0-3", "1:0-3"]),
        ("x-xx", ["0:0-2", "1:1-2"]),
        ("xxx-", ["0:0-2", "1:0-1"]),
        ("xx-x", ["0:0-2", "1:0>", "1:2<"]),  # sixteenth, eighth, sixteenth: both stubs point inwards
        ("x--x", ["0:0-1", "1:1<"]),
        ("xx--", ["0:0-1", "1:0>"]),
        ("xxxxxxxx", ["0:0-7", "1:0-3", "1:4-7", "2:0-3", "2:4-7"]),  # thirty-seconds break at the eighth
        ("x---xxxx", ["0:0-4", "1:1-4", "2:1-4"]),
        ("-x", []),
        ("x", []),
    ],
)
def test_beams_of_a_quarter(letters: str, expected: list[str]) -> None:
    assert beams(group_of(letters)) == expected


@pytest.mark.parametrize(
    ("letters", "expected"),
    [
        ("xxxxxx", ["0:0-5", "1:0-5"]),
        ("x--xx-", ["0:0-2", "1:1<"]),  # a dotted eighth and the sixteenth that fills it, then an eighth
        ("xx-x--", ["0:0-2", "1:0>"]),
        ("x-xxx-", ["0:0-3", "1:1-2"]),
        ("x-x-x-", ["0:0-2"]),
        ("x---x-", []),
    ],
)
def test_beams_of_a_dotted_quarter(letters: str, expected: list[str]) -> None:
    assert beams(group_of(letters, 3, 8)) == expected


def test_a_note_without_a_beam_parts_those_beside_it() -> None:
    syncopated = group_of("xx-", 1, 4)
    assert [value.value.base for value in syncopated.strokes] == [8, 4]
    assert beam_runs(syncopated) == [(0, 0)], "an eighth with its flag"


def test_two_triplets_share_the_outer_beam_alone() -> None:
    assert beams(group_of("xxxxxx", accents=(0, 3))) == ["0:0-5", "1:0-2", "1:3-5"]
    assert beams(group_of("xxxxxx")) == ["0:0-5", "1:0-5"]


def test_eighths_share_a_beam_over_half_a_bar_of_four_and_over_no_other() -> None:
    assert beams(group_of("xxxxxxxx", 4)) == ["0:0-3"]
    assert beams(group_of("xxxxxx", 3)) == ["0:0-1"]
    assert beams(group_of("x-xxxxxx", 4)) == [], "a quarter first: then the second beat's alone"
