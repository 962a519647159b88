"""What nobody can play, and the tempo at which they could: gaps and tempi worked out by hand.

One hand plays six strokes in a row at 10.5 Hz at most and three at 12.5, one foot six at 11.55 and three at 13.75
(`motion/feasibility/limb_speeds`): sixteenths, four a beat, up to 157.5 bpm with one hand and 173.25 with one foot.
"""

import pytest

from station.drills.reading.lesson_file import parse_lesson
from station.motion.kit.kit import DEFAULT_KIT, load_kit
from station.motion.sticking.limbs import assign_limbs
from tests.unit.drills.reading import faults, read, text_of

RIGHT = 'snare = "oooo oooo oooo oooo"\nsticking = "RRRR RRRR RRRR RRRR"'
KICK = 'kick = "oooo oooo oooo oooo"'


def words(grid: str, head: str) -> list[str]:
    return [fault.text for fault in faults(text_of(grid, head))]


def test_the_tempo_is_told_at_which_it_can_be_played() -> None:
    """At 220 bpm sixteenths are 68.2 ms apart: three last 136 ms and need 160; at 157 six are 478 and need 476."""
    assert words(RIGHT, "tempo_bpm = 220") == [
        "too fast at 220: the right hand needs 3 strokes in 136 ms; people need 160; playable up to 157 bpm"
    ]
    read(RIGHT, "tempo_bpm = 157")
    assert words(RIGHT, "tempo_bpm = 158")


def test_what_only_the_goal_makes_too_fast_says_so() -> None:
    head = "tempo_bpm = 100\n[goals]\ntarget_tempo_bpm = 180"
    assert words(KICK, head) == [
        "too fast at the goal of 180: the right foot needs 6 strokes in 417 ms; people need 433; playable up to 173 bpm"
    ]
    read(KICK, head.replace("180", "173"))


def test_what_the_written_tempo_asks_is_not_told_of_the_goal_again() -> None:
    assert len(words(KICK, "tempo_bpm = 180\n[goals]\ntarget_tempo_bpm = 200")) == 1


def test_the_tempo_is_counted_in_the_beat_of_the_grid() -> None:
    """173.25 quarters are 115.5 dotted quarters."""
    head = 'meter = "6/8"\nbeat = "3/8"\ntempo_bpm = 130'
    (found,) = words('kick = "oooooo oooooo"', head)
    assert found.startswith("too fast at 130: the right foot needs ")
    assert found.endswith("; playable up to 115 bpm")


def test_the_tempo_is_that_of_the_grid() -> None:
    text = f'title = "T"\ntempo_bpm = 60\n[[grid]]\nsnare = "o"\n[[grid]]\ntempo_bpm = 240\n{KICK}\n'
    (found,) = faults(text)
    assert found.text.startswith("too fast at 240: ")
    assert found.text.endswith("playable up to 173 bpm")


def test_grace_strokes_keep_their_milliseconds_at_every_tempo() -> None:
    """The left hand plays, then the grace stroke 30 ms before the next sixteenth: 15/bpm s − 30 ms ≥ 45 ms: 200 bpm."""
    grid = 'snare = "of-- ---- ---- ----"\nsticking = "LR-- ---- ---- ----"'
    (found,) = words(grid, "tempo_bpm = 250")
    assert found == "too fast at 250: the left hand needs 2 strokes in 30 ms; people need 45; playable up to 200 bpm"
    read(grid, "tempo_bpm = 200")


def test_slow_tempi_are_told_in_tenths() -> None:
    """Kicks, 64 a quarter: six of them last 4.6875/bpm s; 433 ms at 10.83 bpm."""
    grid = 'kick = "(' + "o" * 64 + ')---"'
    (found,) = words(grid, "tempo_bpm = 30")
    assert found.endswith("playable up to 10.8 bpm")


def test_a_drag_that_no_tempo_mends_names_none() -> None:
    grid = 'snare = "d---"\nsticking = "R---"'
    (found,) = words(grid, "[graces]\ndrag_ms = 25")
    assert found == "the left hand needs 2 strokes in 25 ms; people need 45 at any tempo"
    read(grid, "[graces]\ndrag_ms = 45")


def test_three_hands_name_no_tempo() -> None:
    (found,) = words('hihat = "x---"\nsnare = "o---"\ntom_1 = "o---"', "tempo_bpm = 200")
    assert found == "3 hands needed at once: snare, hihat and tom_1"


def test_the_loop_starts_again() -> None:
    """The last of 16 cells of beat 4 and the first of beat 1 are a sixteenth of a beat apart: 62.5 ms at 60 bpm."""
    grid = 'kick = "(o---------------)--(---------------o)"'
    (found,) = words(grid, "tempo_bpm = 60")
    expected = "the right foot needs 2 strokes in 62 ms; people need 70 as the loop starts again; playable up to 53 bpm"
    assert found == f"too fast at 60: {expected}"


@pytest.mark.parametrize(("grid", "tempo"), [(RIGHT, 157), (KICK, 173)])
def test_the_drummer_on_a_kit_agrees(grid: str, tempo: int) -> None:
    """What a lesson may ask, the drummer is not warned of, and one beat a minute more they both refuse."""
    kit, lesson = load_kit(DEFAULT_KIT), read(grid, f"tempo_bpm = {tempo}")
    assert assign_limbs(lesson.score, kit).warnings == ()
    (warning,) = assign_limbs(lesson.score.at_speed((tempo + 1) / tempo), kit).warnings
    assert "strokes a second of one" in warning
    assert words(grid, f"tempo_bpm = {tempo + 1}")


@pytest.mark.parametrize(
    ("tempo", "target", "count"),
    [(80, 80, 0), (80, 80.5, 0), (80, 79, 1), (80.5, 80, 1)],
)
def test_a_goal_below_the_tempo_is_refused(tempo: float, target: float, count: int) -> None:
    text = f'title = "T"\ntempo_bpm = {tempo}\n[goals]\ntarget_tempo_bpm = {target}\n[grid]\nsnare = "o"\n'
    found = parse_lesson(text, "t", "t").faults
    assert len(found) == count
    for fault in found:
        assert (fault.line, fault.column) == (4, 20)
        assert fault.text == (
            f"goals.target_tempo_bpm: {target:g} is below the tempo, {tempo:g}; expected that or more, "
            "or a slower tempo_bpm"
        )
