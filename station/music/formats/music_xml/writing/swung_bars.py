"""Which bars of a part are written straight under its swing, and where its strokes stand on paper then.

A reader plays every note that is in no tuplet by the swing in force. Where that would not give back what the part
plays, the bar is written as it is played, under the word straight.
"""

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from station.music.formats.music_xml.reading.strokes_reading import PlayedBar
from station.music.formats.music_xml.writing.bar_writing import SpelledBar, spelled_bar
from station.music.formats.music_xml.writing.direction_writing import SWING_TYPES
from station.music.formats.music_xml.writing.stroke_cells import StrokeCell, cells_of
from station.music.score import Note, Score
from station.music.swing import MAX_RATIO, MIN_RATIO, STRAIGHT, Swing
from station.music.tempo import MeterChange

_MOST_TRIES = 8
"""Rounds of turning bars straight, for one may change what is held into the next; then all are (our choice)."""
_CLOSE = 2
"""Ticks that a place may lie beside what is played."""


@dataclass(frozen=True, slots=True)
class BarFrame:
    """A bar of the score: ticks [start, end), its meter."""

    start: int
    end: int
    meter: MeterChange

    @property
    def length(self) -> int:
        """In ticks; less than the meter's where the next meter cuts it short."""
        return self.end - self.start


@dataclass(frozen=True, slots=True)
class WrittenVoices:
    """All bars of the hands and of the feet as they are written; `swings` says of each bar whether it swings."""

    frames: tuple[BarFrame, ...]
    voices: tuple[tuple[SpelledBar, ...], ...]
    swings: tuple[bool, ...]

    @property
    def heads(self) -> list[list[StrokeCell]]:
        """The note heads of each voice in order."""
        return [[cell for bar in voice for chord in bar.chords for cell in chord.struck] for voice in self.voices]


def bar_frames(score: Score) -> tuple[BarFrame, ...]:
    """The bars from tick 0 to the end of `score`."""
    tempo_map = score.tempo_map
    starts = [tempo_map.bar_start(bar) for bar in range(score.bar_count)]
    ends = [*starts[1:], max(score.end_tick, starts[-1] + 1)]
    return tuple(BarFrame(start, end, tempo_map.meter_at(start)) for start, end in zip(starts, ends, strict=True))


def can_be_said(swing: Swing) -> bool:
    """Whether MusicXML has this swing: of eighths or sixteenths."""
    return swing.ratio != STRAIGHT and swing.unit_ticks in SWING_TYPES and MIN_RATIO <= swing.ratio <= MAX_RATIO


def written_voices(score: Score, swing: Swing, voices: Sequence[frozenset[int]]) -> WrittenVoices:
    """The bars of each voice, a set of pieces, under `swing` where that says what is played."""
    frames = bar_frames(score)
    swings = [can_be_said(swing)] * len(frames)
    for _ in range(_MOST_TRIES):
        found = _written(score, swing, voices, frames, swings)
        wrong = _played_otherwise(found, swing) if any(swings) else set()
        if not wrong:
            return found
        swings = [is_swung and i not in wrong for i, is_swung in enumerate(swings)]
    return _written(score, swing, voices, frames, [False] * len(frames))


def _written(
    score: Score,
    swing: Swing,
    voices: Sequence[frozenset[int]],
    frames: Sequence[BarFrame],
    swings: Sequence[bool],
) -> WrittenVoices:
    bars = score.tempo_map.bars_at(score.notes["tick"]).tolist()
    notes = [_on_paper(note, bar, swing, frames, swings) for note, bar in zip(score, bars, strict=True)]
    spelled = tuple(
        _spelled(cells_of([note for note in notes if note.piece in pieces], score.end_tick), frames)
        for pieces in voices
    )
    return WrittenVoices(tuple(frames), spelled, tuple(swings))


def _spelled(cells: Sequence[StrokeCell], frames: Sequence[BarFrame]) -> tuple[SpelledBar, ...]:
    found: list[SpelledBar] = []
    held: list[StrokeCell] = []
    at = 0
    for frame in frames:
        inside = [cell for cell in held if (cell.end or 0) > frame.start]
        while at < len(cells) and cells[at].start < frame.end:
            inside.append(cells[at])
            at += 1
        found.append(spelled_bar(inside, frame.start, frame.length, frame.meter))
        held = [cell for cell in inside if cell.end is not None and cell.end > frame.end and cell.second is None]
    return tuple(found)


def _on_paper(note: Note, bar: int, swing: Swing, frames: Sequence[BarFrame], swings: Sequence[bool]) -> Note:
    """The note where it is written, its length with it; `swing_ticks` 0 where its bar is written as it is played."""
    bar = min(bar, len(frames) - 1)
    if not swing.stands_in_words:
        return note
    start = note.tick - (note.swing_ticks if swings[bar] else 0)

    def lasts(ticks: int) -> int:
        return straight_place(note.tick + ticks, swing, frames[bar:], swings[bar:]) - start if ticks else 0

    return replace(
        note,
        tick=start,
        swing_ticks=note.tick - start,
        duration_ticks=lasts(note.duration_ticks),
        choke_ticks=lasts(note.choke_ticks),
    )


def straight_place(tick: int, swing: Swing, frames: Iterable[BarFrame], swings: Iterable[bool]) -> int:
    """Where what is played at `tick` is written, in the bars from one before it on."""
    for frame, is_swung in zip(frames, swings, strict=True):
        if tick <= frame.end:
            return frame.start + _straight(tick - frame.start, swing, frame.meter) if is_swung else tick
    return tick


def _straight(played: int, swing: Swing, meter: MeterChange) -> int:
    """The inverse of `Swing.swung`, found by halving: it rises."""
    low, high = 0, meter.bar_ticks
    while low < high:
        middle = (low + high) // 2
        if swing.swung(middle, meter) < played:
            low = middle + 1
        else:
            high = middle
    return low


def _played_otherwise(found: WrittenVoices, swing: Swing) -> set[int]:
    """The swung bars in which a reader would play a stroke, or its end, elsewhere than the part does."""
    wrong: set[int] = set()
    starts = [frame.start for frame in found.frames]
    for voice in found.voices:
        for i, bar in enumerate(voice):
            for chord in bar.chords:
                for cell in chord.struck:
                    in_tuplet = chord.value.span.actual > 1
                    if found.swings[i] and not _starts_right(
                        found.frames[i], chord.value.start, cell, in_tuplet, swing
                    ):
                        wrong.add(i)
                    if cell.end is not None and cell.second is None:
                        last = bisect_left(starts, cell.end) - 1
                        if found.swings[last] and not _ends_right(found.frames[last], cell.end, in_tuplet, swing):
                            wrong.add(last)
    return wrong


def _starts_right(frame: BarFrame, start: Fraction, cell: StrokeCell, in_tuplet: bool, swing: Swing) -> bool:
    reader = PlayedBar(frame.meter, frame.start, ((0, swing),))
    strokes = [(cell.note, Fraction(0))]
    if cell.second is not None:
        strokes.append((cell.second, Fraction((cell.end or 0) - cell.start, 2)))
    return all(
        abs(reader.place(round(start + after), not in_tuplet)[0] - (note.tick + note.swing_ticks)) <= _CLOSE
        for note, after in strokes
    )


def _ends_right(frame: BarFrame, end: int, in_tuplet: bool, swing: Swing) -> bool:
    """Ends are written where a swing that stands in words moves them, and else where they are played."""
    straight = min(end - frame.start, frame.meter.bar_ticks)
    is_moved = abs(swing.swung(straight, frame.meter) - straight) > _CLOSE
    return not is_moved or in_tuplet is not swing.stands_in_words
