from station.bench.rows.window_rows import late_ms
from station.core.units import NS_PER_MS


def test_a_picture_is_late_after_the_last_stroke_of_its_velocity() -> None:
    """By hand: velocity 40 is struck at 0 and, a round later, at 20 s; 41 never reaches the screen."""
    sent = [(0, 40), (200 * NS_PER_MS, 41), (20_000 * NS_PER_MS, 40)]
    lit = [(25 * NS_PER_MS, 40), (20_040 * NS_PER_MS, 40)]
    assert late_ms(sent, lit).tolist() == [25.0, 40.0]


def test_strokes_that_nobody_sent_and_those_long_past_are_no_measure() -> None:
    assert late_ms([(0, 40)], [(30 * NS_PER_MS, 99), (700 * NS_PER_MS, 40)]).tolist() == []
