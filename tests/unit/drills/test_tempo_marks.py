"""Tempo that changes in a grid: steps of a quarter of the beat, worked out by hand."""

import pytest

from station.drills.reading.lesson_file import parse_lesson
from station.music.tempo import TempoChange
from tests.unit.drills.reading import QUARTER, SIXTEENTH, WHOLE, faults


def tempos(text: str, head: str = "") -> list[tuple[int, float]]:
    """Tick and tempo of every change, rounded as MIDI keeps it."""
    reading = parse_lesson(f'title = "T"\n{head}\n{text}', "test.toml", "test")
    assert reading.faults == []
    assert reading.lesson
    return [(t.tick, t.us_per_quarter) for t in reading.lesson.score.tempo_map.tempos]


def us(bpm: float) -> int:
    return TempoChange.from_bpm(0, bpm).us_per_quarter


def line(start: int, count: int, first: float, step: float, ticks: int = SIXTEENTH) -> list[tuple[int, int]]:
    """`count` steps of `ticks` from tick `start`, the first at `first` bpm, each `step` bpm faster."""
    return [(start + i * ticks, us(first + i * step)) for i in range(count)]


def test_a_grid_gets_faster_by_quarters_of_its_beat() -> None:
    """One bar of 4/4 has 16 sixteenths: from 60 to 76 each is 1 bpm faster; 76 itself would be at its end."""
    text = '[[grid]]\ntempo_bpm = 60\ntempo_to_bpm = 76\nsnare = "oooo"\n[[grid]]\nsnare = "o"\n'
    assert tempos(text) == [*line(0, 16, 60, 1), (WHOLE, us(60))]  # the next grid: the tempo of the grid, not reached


def test_the_first_step_is_the_written_tempo() -> None:
    lesson = parse_lesson('title = "T"\ntempo_bpm = 90.5\n[grid]\ntempo_to_bpm = 40\nsnare = "o"', "t", "t").lesson
    assert lesson
    assert lesson.tempo_bpm == lesson.beats_a_minute == 90.5


def test_a_ramp_goes_over_all_repetitions() -> None:
    text = '[grid]\ntimes = 2\ntempo_bpm = 96\ntempo_to_bpm = 64\nsnare = "oooo"\n'
    assert tempos(text) == line(0, 32, 96, -1)


def test_the_beat_is_the_one_that_the_tempo_counts() -> None:
    """6/8 in dotted quarters: 8 steps of a quarter of 3/8 in a bar; from 40 to 48 dotted are 60 to 72 quarters."""
    text = '[grid]\ntempo_to_bpm = 48\nsnare = "o-- o--"\n'
    head = 'tempo_bpm = 40\nmeter = "6/8"\nbeat = "3/8"'
    assert tempos(text, head) == line(0, 8, 60, 1.5, 3 * QUARTER // 8)


def test_each_turn_of_the_form_begins_anew() -> None:
    text = 'form = "A, A"\n[[grid]]\nname = "A"\ntempo_bpm = 60\ntempo_to_bpm = 76\nsnare = "oooo"\n'
    assert tempos(text) == line(0, 16, 60, 1) + line(WHOLE, 16, 60, 1)


def test_a_ramp_goes_on_over_an_ending_without_a_tempo() -> None:
    """A, ending: two bars from 60 to 92 in 32 steps."""
    grids = '[[grid]]\ntempo_bpm = 60\ntempo_to_bpm = 92\nsnare = "oooo"\n[[grid]]\nending = 1\nsnare = "o"\n'
    assert tempos(grids) == line(0, 32, 60, 1)


def test_an_ending_may_have_a_tempo_of_its_own() -> None:
    """A (bar 1), ending (bar 2), A (bar 3): the ramp from 60 to 108 is half a bpm … 1 bpm a sixteenth over 48."""
    grids = """
[[grid]]
times = 2
tempo_bpm = 60
tempo_to_bpm = 108
snare = "oooo"
[[grid]]
ending = 1
tempo_bpm = 200
snare = "o"
"""
    assert tempos(grids) == [*line(0, 16, 60, 1), (WHOLE, us(200)), *line(2 * WHOLE, 16, 92, 1)]


# --- at ---------------------------------------------------------------------------------------------------------------


def test_a_tempo_at_a_bar_holds_until_its_repetition_ends() -> None:
    text = '[grid]\ntimes = 2\nat = [{bar = 2, tempo_bpm = 120}]\nsnare = "o | o"\n'
    assert tempos(text, "tempo_bpm = 60") == [(b * WHOLE, us(120 if b % 2 else 60)) for b in range(4)]


def test_a_ritardando_on_the_last_beats() -> None:
    """From beat 3 of bar 2 eight sixteenths are left: 80 to 64 is 2 bpm each."""
    text = '[[grid]]\nat = [{bar = 2, beat = 3, tempo_to_bpm = 64}]\nsnare = "o | o"\n[[grid]]\nsnare = "o"\n'
    expected = [(0, us(80)), *line(WHOLE + 2 * QUARTER, 8, 80, -2)[1:], (2 * WHOLE, us(80))]
    assert tempos(text, "tempo_bpm = 80") == expected


def test_a_ramp_at_a_bar_ends_at_the_next_tempo_and_goes_on_from_there() -> None:
    """Bar 1: 60 to 76; bar 2: at 100; bar 3: 100 to 84."""
    at = "[{bar = 3, tempo_to_bpm = 84}, {bar = 1, tempo_to_bpm = 76}, {bar = 2, tempo_bpm = 100}]"
    text = f'[grid]\nat = {at}\nsnare = "o | o | o"\n'
    assert tempos(text, "tempo_bpm = 60") == [
        *line(0, 16, 60, 1),
        (WHOLE, us(100)),
        *line(2 * WHOLE, 16, 100, -1)[1:],
    ]


def test_a_tempo_in_one_repetition_only() -> None:
    text = '[grid]\ntimes = 3\nat = [{bar = 1, time = 2, tempo_bpm = 90}]\nsnare = "o"\n'
    assert tempos(text, "tempo_bpm = 60") == [(0, us(60)), (WHOLE, us(90)), (2 * WHOLE, us(60))]


def test_a_tempo_on_the_ramp_of_its_grid() -> None:
    """60 to 76 over the bar; from beat 3, at 68, on to 84 evenly over the eight sixteenths that are left."""
    text = '[grid]\ntempo_to_bpm = 76\nat = [{bar = 1, beat = 3, tempo_to_bpm = 84}]\nsnare = "o"\n'
    assert tempos(text, "tempo_bpm = 60") == line(0, 8, 60, 1) + line(2 * QUARTER, 8, 68, 2)


def test_a_ramp_of_too_many_steps_is_refused() -> None:
    text = (
        'title = "T"\nmeter = "32/1"\nbeat = "1/32"\ntempo_bpm = 400\n[grid]\ntempo_to_bpm = 900\nsnare = "o | %99"\n'
    )
    (found,) = faults(text)
    assert "the tempo changes 4 times a beat; a lesson has at most 20000 changes" in found.text


@pytest.mark.parametrize(
    ("grid", "column", "words"),
    [
        ("tempo_to_bpm = 5", 16, "tempo_to_bpm: expected a number from 10 to 1000"),
        ("at = [{bar = 2, tempo_bpm = 90}]", 14, "the grid has 1 bar, found 2"),
        ("at = [{bar = 1, beat = 5, tempo_bpm = 90}]", 24, "bar 1 is a 4/4 bar of 4 beats, found 5"),
        ("at = [{bar = 1, time = 2, tempo_bpm = 90}]", 24, "the grid is played 1 time, found 2"),
        ('at = [{bar = 1, beat = 2, say = "x"}]', 24, "beat is for tempo_bpm and tempo_to_bpm"),
        ("at = [{bar = 1}]", 7, "nothing happens here; expected one of say, camera, style, tempo_bpm, tempo_to_bpm"),
        ("at = [{tempo_bpm = 90}]", 7, "bar is missing; expected the bar, such as bar = 2"),
        ("at = [{bar = 0, tempo_bpm = 90}]", 14, "expected a whole number from 1"),
        ("at = [{bar = 1, tempo = 90}]", 17, "no such key: tempo; did you mean tempo_bpm?"),
        ("at = [{bar = 1, tempo_bpm = 90}, {bar = 1, tempo_to_bpm = 9}]", 59, "expected a number from 10 to 1000"),
        ("at = [{bar = 1, tempo_bpm = 90}, {bar = 1, tempo_to_bpm = 90}]", 34, "a tempo stands on this beat already"),
        ('at = [{bar = 1, camera = "fet"}]', 26, "did you mean feet?"),
        ('at = [{bar = 1, style = "jaz"}]', 25, "did you mean jazz?"),
        ('at = "bar 1"', 6, 'expected a list such as [{bar = 2, say = "Ghosts low"}]'),
    ],
)
def test_faults_of_tempo_and_at(grid: str, column: int, words: str) -> None:
    found = faults(f'title = "T"\n[grid]\n{grid}\nsnare = "o---"\n')
    assert [f.line for f in found] == [3], found
    assert words in found[0].text
    assert found[0].column == column
