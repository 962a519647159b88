"""What stands between the notes of a bar: tempo, swing, loudness, names of sections."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from xml.etree.ElementTree import Element

from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.music_xml.writing.element_writing import child, number_text, xml_text
from station.music.loudness_marks import GROW
from station.music.swing import STRAIGHT, Swing
from station.music.tempo import TempoChange
from station.music.tempo_words import TempoWord, tempo_words

_BEATS = {
    Fraction(4 * PPQ, 2**k) * (3 if dots else 2) / 2: (name, dots)
    for k, name in enumerate(("whole", "half", "quarter", "eighth", "16th", "32nd"))
    for dots in (0, 1)
}
SWING_TYPES = {PPQ // 2: "eighth", PPQ // 4: "16th"}
_FINEST_RATIO = 1000


@dataclass(frozen=True, slots=True)
class Direction:
    """Something at `tick` of the part; `add` puts its element into a measure, `offset` divisions after the place."""

    tick: int
    add: Callable[[Element, str], None]


def has_beat(beat_ticks: int) -> bool:
    """Whether a metronome mark can say this beat."""
    return Fraction(beat_ticks) in _BEATS


def tempo_text(us_per_quarter: int) -> str:
    """Quarter notes a minute, so exact that the same microseconds come back."""
    return f"{TempoChange(0, us_per_quarter).short_bpm():.10f}".rstrip("0").rstrip(".")


def directions_of(part: DrumPart, swings: Sequence[tuple[int, Swing]]) -> list[Direction]:
    """All directions by their ticks; `swings` (tick, the swing from there on)."""
    found = [*_tempos(part), *_loudness(part), *_sections(part), *(_swing(tick, swing) for tick, swing in swings)]
    return sorted(found, key=lambda direction: direction.tick)


def _added(measure: Element, offset: str, placement: str) -> tuple[Element, Callable[[], Element]]:
    """A new direction, and what closes it: its offset."""
    direction = child(measure, "direction", placement=placement)

    def close() -> Element:
        if offset != "0":
            child(direction, "offset", offset, sound="yes")
        return direction

    return direction, close


# --- tempo ------------------------------------------------------------------------------------------------------------


def _tempos(part: DrumPart) -> Iterator[Direction]:
    tempo_map = part.score.tempo_map
    words = {word.tick: word for word in tempo_words(tempo_map)}
    changes = {change.tick: change for change in tempo_map.tempos if change.tick < max(part.score.end_tick, 1)}
    for tick, word in words.items():
        if word.until is not None and tick not in changes and tick < part.score.end_tick:
            yield _ramp(word)
    for tick, change in changes.items():
        at_once = tick == 0 or (tick in words and words[tick].until is None)
        yield _tempo(change, part.beat_ticks, at_once, words.get(tick))


def _ramp(word: TempoWord) -> Direction:
    def add(measure: Element, offset: str) -> None:
        direction, close = _added(measure, offset, "above")
        child(child(direction, "direction-type"), "words", "accel." if word.way > 0 else "rit.")
        close()

    return Direction(word.tick, add)


def _tempo(change: TempoChange, beat_ticks: int, is_shown: bool, word: TempoWord | None) -> Direction:
    text = tempo_text(change.us_per_quarter)

    def add(measure: Element, offset: str) -> None:
        if not is_shown and (word is None or word.until is None):
            sound = child(measure, "sound", tempo=text)
            if offset != "0":
                child(sound, "offset", offset)
            return
        direction, close = _added(measure, offset, "above")
        kind = child(direction, "direction-type")
        if is_shown:
            _add_metronome(kind, change, beat_ticks)
        elif word is not None:
            child(kind, "words", "accel." if word.way > 0 else "rit.")
        child(close(), "sound", tempo=text)

    return Direction(change.tick, add)


def _add_metronome(kind: Element, change: TempoChange, beat_ticks: int) -> None:
    beat = Fraction(beat_ticks) if has_beat(beat_ticks) else Fraction(PPQ)
    name, dots = _BEATS[beat]
    metronome = child(kind, "metronome", parentheses="no")
    child(metronome, "beat-unit", name)
    for _ in range(dots):
        child(metronome, "beat-unit-dot")
    a_minute = change.tempo_bpm * PPQ / float(beat)
    child(metronome, "per-minute", number_text(Fraction(round(100 * a_minute), 100)))


# --- swing, loudness, sections ----------------------------------------------------------------------------------------


def _swing(tick: int, swing: Swing) -> Direction:
    def add(measure: Element, offset: str) -> None:
        direction, close = _added(measure, offset, "above")
        words = "Straight" if swing.ratio == STRAIGHT else "Swing"
        child(child(direction, "direction-type"), "words", words)
        element = child(child(close(), "sound"), "swing")
        if swing.ratio == STRAIGHT:
            child(element, "straight")
            return
        ratio = Fraction(swing.ratio).limit_denominator(_FINEST_RATIO)
        child(element, "first", ratio.numerator)
        child(element, "second", ratio.denominator)
        child(element, "swing-type", SWING_TYPES[swing.unit_ticks])

    return Direction(tick, add)


def _loudness(part: DrumPart) -> Iterator[Direction]:
    marks, end = part.score.loudness, part.score.end_tick
    for i, mark in enumerate(marks):
        if i and marks[i - 1].is_hairpin:
            yield _wedge(mark.tick, "stop")
        if mark.is_hairpin:
            yield _wedge(mark.tick, "crescendo" if mark.sign == GROW else "diminuendo")
        else:
            yield _mark(mark.tick, mark.sign)
    if marks and marks[-1].is_hairpin:
        yield _wedge(end, "stop")


def _wedge(tick: int, kind: str) -> Direction:
    def add(measure: Element, offset: str) -> None:
        direction, close = _added(measure, offset, "below")
        child(child(direction, "direction-type"), "wedge", type=kind)
        close()

    return Direction(tick, add)


def _mark(tick: int, sign: str) -> Direction:
    def add(measure: Element, offset: str) -> None:
        direction, close = _added(measure, offset, "below")
        child(child(child(direction, "direction-type"), "dynamics"), sign)
        close()

    return Direction(tick, add)


def _sections(part: DrumPart) -> Iterator[Direction]:
    for section in part.sections:
        yield _rehearsal(part.score.tempo_map.bar_start(section.first_bar), section.name)


def _rehearsal(tick: int, name: str) -> Direction:
    def add(measure: Element, offset: str) -> None:
        direction, close = _added(measure, offset, "above")
        child(child(direction, "direction-type"), "rehearsal", xml_text(name))
        close()

    return Direction(tick, add)
