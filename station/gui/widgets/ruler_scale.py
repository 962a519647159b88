"""Where a song's bars and beats lie on a ruler, and which bar lies under a point of it. Pixels, x to the right."""

from dataclasses import dataclass

from station.practice.demonstration.song_player import Song

LEAST_BEAT_PX, LEAST_NUMBER_PX = 9.0, 34.0
"""Beats nearer together are left out, and so are numbers; our choice."""


@dataclass(frozen=True, slots=True)
class RulerLine:
    """A line at `x`: a bar's with its `number` from 1, 0 where there is no room for it; a beat's has None."""

    x: float
    number: int | None


@dataclass(frozen=True, slots=True)
class RulerScale:
    """`song` on a ruler that begins at `left` and is `width` wide; `scale` window pixels a design pixel."""

    song: Song
    left: float
    width: float
    scale: float = 1.0

    def x_of(self, at_ns: int) -> float:
        """Where a song time lies."""
        return self.left + self.width * at_ns / max(self.song.length_ns, 1)

    def at_of(self, x: float) -> int:
        """The song time at `x`, held within the song."""
        share = min(max((x - self.left) / self.width, 0.0), 1.0)
        return round(share * self.song.length_ns)

    def bar_of(self, x: float) -> int:
        """The bar, from 0, under `x`: the first left of the ruler, the last right of it."""
        tick = min(self.song.tick_at(self.at_of(x)), self.song.end_tick - 1)
        return int(self.song.tempo_map.bars_at(tick))

    def lines(self) -> list[RulerLine]:
        """Every bar's line, numbers as dense as there is room, and the beats' where there is room, in order."""
        song, tempo_map = self.song, self.song.tempo_map
        starts = [self.x_of(song.bar_start_ns(bar)) for bar in range(song.bar_count)]
        bar_px = self.width / max(song.bar_count, 1)
        every = 1
        while bar_px * every < LEAST_NUMBER_PX * self.scale:
            every *= 2
        lines = [RulerLine(x, bar + 1 if bar % every == 0 else 0) for bar, x in enumerate(starts)]
        if bar_px < LEAST_BEAT_PX * self.scale * tempo_map.meters[0].beats:
            return lines
        beats = tempo_map.beats_between(0, song.end_tick)
        lines += [RulerLine(self.x_of(int(tempo_map.ns_at(tick))), None) for tick, index in beats if index > 0]
        return sorted(lines, key=lambda line: line.x)
