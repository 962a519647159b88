"""Where a time axis bears its lines: at beats where there is room, else at bars, numbered as the score is."""

from station.core.units import NS_PER_S
from station.music.score import Score
from station.render.snapshot import BarNumbers

MOST_LINES = 48
"""More would be a hatch (our choice)."""


def music_ticks(score: Score, numbers: BarNumbers, low_s: float, high_s: float) -> tuple[list[float], list[str]]:
    """Seconds and words of the lines between `low_s` and `high_s`: bar numbers, beats such as 2.3, at most so many."""
    tempo_map, end = score.tempo_map, score.end_tick
    first = max(int(tempo_map.ticks_at_ns(round(low_s * NS_PER_S))), 0)
    last = min(int(tempo_map.ticks_at_ns(round(high_s * NS_PER_S))), end)
    beats = tempo_map.beats_between(first, min(last + 1, end)) if first < end else []
    bars = [(tick, 0) for tick, index in beats if index == 0]
    every = 1
    while len(bars) > MOST_LINES * every:
        every *= 2
    lines = beats if len(beats) <= MOST_LINES else bars[::every]
    words = []
    for tick, index in lines:
        bar = numbers.of(int(tempo_map.bars_at(tick)))
        words.append(f"{bar}.{index + 1}" if index else f"{bar}")
    return [float(s) for s in tempo_map.seconds_at([tick for tick, _ in lines])], words
