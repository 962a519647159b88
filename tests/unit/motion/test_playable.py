"""What no drummer can do; limits from HUMANS (hands 10 Hz single, doubles 50 ms, feet 11 Hz), gaps reckoned by hand."""

import pytest

from tests.unit.drills.reading import faults, read, text_of


@pytest.mark.parametrize(
    ("grid", "head", "line", "column", "words"),
    [
        ('hihat = "x---"\nsnare = "o---"\ntom_1 = "o---"', "", 6, 10, "3 hands needed at once: snare, hihat and tom_1"),
        ('hihat = "x---"\nsnare = "f---"', "", 4, 10, "3 hands needed at once: snare and hihat with its grace strokes"),
        (
            'hihat = "x---"\nsnare = "o---"\ntom_1 = "o---"\ntom_2 = "o---"',
            "",
            7,
            10,
            "4 hands needed at once: snare, hihat, tom_1 and tom_2",
        ),
        (
            'right_hand.snare = "o---"\nright_hand.ride = "x---"',
            "",
            5,
            20,
            "one right hand, two places: snare and ride",
        ),
        ('left_foot.kick = "o---"\nhihat_pedal = "x---"', "", 5, 16, "one left foot, two places"),
        ('hihat = "o---"\nhihat_pedal = "x---"', "", 4, 10, "struck open while the foot closes it"),
        ('hihat = "h---"\nhihat_pedal = "x---"', "", 4, 10, "struck open while the foot closes it"),
    ],
)
def test_impossible_moments(grid: str, head: str, line: int, column: int, words: str) -> None:
    (found,) = faults(text_of(grid, head or "tempo_bpm = 60"))
    assert (found.line, found.column) == (line, column), found
    assert words in found.text


def test_a_splash_leaves_the_hat_open() -> None:
    read('hihat = "o---"\nhihat_pedal = "o---"')


def test_three_voices_on_two_hands_and_feet() -> None:
    read('hihat = "x---"\nsnare = "o---"\nkick = "o---"\nhihat_pedal = "x---"')


@pytest.mark.parametrize(
    ("tempo", "playable"),
    [
        (100, True),  # sixteenths of one foot every 150 ms
        (180, False),  # every 83 ms: nine strokes in 667 ms
        (220, False),  # every 68 ms
    ],
)
def test_one_foot(tempo: int, playable: bool) -> None:
    found = faults(text_of('kick = "oooo oooo oooo oooo"', f"tempo_bpm = {tempo}"))
    assert (not found) is playable, found
    assert all("the right foot needs" in f.text for f in found)


@pytest.mark.parametrize(
    ("tempo", "playable"),
    [
        (90, True),  # double strokes every 83 ms
        (140, True),  # every 54 ms, each hand twice in 214 ms
        (180, False),  # every 42 ms
    ],
)
def test_double_strokes(tempo: int, playable: bool) -> None:
    grid = 'snare = "tttt tttt tttt tttt"\nsticking = "RLRL RLRL RLRL RLRL"'
    assert (not faults(text_of(grid, f"tempo_bpm = {tempo}"))) is playable


@pytest.mark.parametrize(("tempo", "playable"), [(200, True), (390, False)])
def test_two_hands_that_nobody_named(tempo: int, playable: bool) -> None:
    """Sixteenths: 75 ms apart at 200 bpm, 38 ms (26 a second) at 390; the fastest single strokes are 20 a second."""
    found = faults(text_of('snare = "oooo oooo oooo oooo"', f"tempo_bpm = {tempo}"))
    assert (not found) is playable
    assert all("the hands need" in f.text for f in found)


def test_the_target_tempo_counts() -> None:
    head = "tempo_bpm = 90\n[goals]\ntarget_tempo_bpm = 260"
    found = faults(text_of('kick = "oooo oooo oooo oooo"', head))
    assert any("too fast at the goal of 260: the right foot" in f.text for f in found)


def test_the_step_from_the_end_of_the_loop_to_its_start_counts() -> None:
    grid = 'kick = "(o---------------)--(---------------o)"'
    (found,) = faults(text_of(grid, "tempo_bpm = 60"))
    assert "as the loop starts again" in found.text
    assert (found.line, found.column) == (4, 10)
    read(grid.replace("o)", "-)"))


def test_a_grace_stroke_needs_its_time() -> None:
    """At 250 bpm sixteenths are 60 ms apart: a grace stroke 30 ms ahead follows its own hand's stroke by 30 ms."""
    grid = 'snare = "of-- ---- ---- ----"\nsticking = "LR-- ---- ---- ----"'
    found = faults(text_of(grid, "tempo_bpm = 250"))
    assert any("the left hand needs 2 strokes in 30 ms" in f.text for f in found)
    read(grid, "tempo_bpm = 100")
