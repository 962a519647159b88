"""The bar for the instant replay: the one that shows most by itself."""

from collections.abc import Sequence

from station.practice.battle.judging.improvisation_marks import ImprovisationMarks


def best_bar(marks: Sequence[ImprovisationMarks]) -> tuple[int, int] | None:
    """Which turn and which of its bars, from 0, has the most `bar_points`; of equals the later. None where none sounds.

    A bar's points are those of `WEIGHTS` without space: how evenly it lies about the click, its range in dB, how many
    of its beats are new, how far it takes up something earlier and changes it, how many voicings it has.
    """
    bars = [
        (points, turn, bar) for turn, turn_marks in enumerate(marks) for bar, points in enumerate(turn_marks.bar_points)
    ]
    points, turn, bar = max(bars, default=(0.0, 0, 0))
    return (turn, bar) if points > 0 else None
