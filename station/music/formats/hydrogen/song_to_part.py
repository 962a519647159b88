"""A song of Hydrogen's as a part: what sounds when its columns are played once.

An instrument is the piece that its name, type or MIDI note means (`core.sound_naming`, as for Hydrogen's kits).
Velocity is 127 times Hydrogen's, cut to a whole number as its MIDI export cuts it. A note that silences a ringing
cymbal is its choke. Where a bar's size is no meter, its last beat is cut short.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.note_map import NoteMeaning
from station.core.pieces import CHOKEABLE, Articulation, Ornament, Piece, Zone
from station.core.sound_names import SoundName, strike_of_sound
from station.core.sound_naming import FAMILIES, are_chosen, sound_of_instrument
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.hydrogen.rock_kit import KIT, ROCK_KIT
from station.music.formats.hydrogen.song_contents import (
    ENTIRE_SAMPLE,
    FULL_VELOCITY,
    LEAD_LAG_TICKS,
    SCORE_TICKS,
    SIXTEENTH,
    SWING_TICKS,
    WHOLE_NOTE,
    HydrogenSong,
    Instrument,
    Pattern,
    PatternNote,
)
from station.music.formats.playing_order import MOST_BARS
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap

_MOST_STROKES = 40_000
"""Our choice: an hour of 11 a second; a small file may ask for any number by its columns."""
_UNITS = (4, 8, 16, 32)
_THREE_QUARTERS = WHOLE_NOTE * 3 // 4
_LONGEST_BAR = WHOLE_NOTE * 3 // 2
"""Ticks of 6/4, the longest bar that people count (our choice)."""
_KNOWN_KITS = (ROCK_KIT, "GMkit", "")
"""Kits whose instruments are in General MIDI's order."""
_FIRST_OTHER = 1 << 20
"""Ids above those of any kit."""


def part_of_song(song: HydrogenSong, source: str) -> DrumPart:
    """The part that `song` plays; raises `BadInput` of `source` for one of more strokes than any music has."""
    columns = _columns(song, source)
    starts = np.cumsum([0] + [_size(column) for column in columns]).tolist()
    band = _band(song.instruments)
    curve = np.array(sorted(song.automation), float).reshape(-1, 2)
    of_kind = {one.kind: one.id for one in reversed(song.instruments) if one.kind}
    notes, chance = [], 0
    for index, column in enumerate(columns):
        for pattern in column:
            for note in pattern.notes:
                if note.position < pattern.size and note.probability > 0:
                    played = replace(note, instrument=of_kind.get(note.kind, note.instrument)) if note.kind else note
                    notes.append(_Placed(starts[index] + note.position, _factor(curve, index, note, column), played))
                    chance += note.probability < 1
    swing = _swing(song.swing_factor)
    score = Score.from_notes(
        _without_layers(_strokes(notes, band, swing, song.swing_factor)),
        _tempo_map(song, columns, starts),
        starts[-1] * SCORE_TICKS,
        song.name,
    )
    lost = (*song.lost, *_lost(notes, band, chance))
    return DrumPart(score, song.author, song.about, None, swing, _sections(song.tags, len(columns)), lost=lost)


def kit_of_pattern(song: HydrogenSong, kit_name: str) -> HydrogenSong:
    """The pattern with the instruments that it may be for: GMRockKit's, and one for each type that this has not."""
    notes = song.patterns[0].notes
    others = sorted({note.kind for note in notes if note.kind} - {one.kind for one in KIT})
    kit = [Instrument(i, one.name, one.kind) for i, one in enumerate(KIT)]
    more = [Instrument(_FIRST_OTHER + i, kind, kind) for i, kind in enumerate(others)]
    is_guess = kit_name not in _KNOWN_KITS and any(not note.kind for note in notes)
    guess = f"the instruments of {kit_name[:40]!r} are not in a pattern; they are taken for those of {ROCK_KIT}"
    bars = _bars_of(song.patterns[0])
    return replace(
        song,
        patterns=bars,
        columns=tuple((bar.name,) for bar in bars),
        instruments=(*kit, *more),
        lost=(*song.lost, *([guess] if is_guess else ())),
    )


def _bars_of(pattern: Pattern) -> tuple[Pattern, ...]:
    """A pattern longer than 6/4 as one for each bar of 4/4 or 3/4 in it: it is the usual way to write several bars.

    Any other is one bar.
    """
    lengths = (WHOLE_NOTE, _THREE_QUARTERS) if pattern.size > _LONGEST_BAR else ()
    length = next((each for each in lengths if pattern.size % each == 0), pattern.size)
    notes: dict[int, list[PatternNote]] = {}
    for note in pattern.notes:
        bar, position = divmod(note.position, length)
        notes.setdefault(bar, []).append(replace(note, position=position))
    count = pattern.size // length
    return tuple(Pattern(f"{i}", length, pattern.denominator, tuple(notes.get(i, ()))) for i in range(count))


# --- columns ----------------------------------------------------------------------------------------------------------


def _columns(song: HydrogenSong, source: str) -> list[list[Pattern]]:
    """The patterns that sound in each column, those that virtual ones bring included."""
    by_name: dict[str, Pattern] = {}
    for pattern in song.patterns:
        by_name.setdefault(pattern.name, pattern)
    flat: dict[tuple[str, ...], list[Pattern]] = {}
    found, strokes = [], 0
    for names in song.columns or tuple((pattern.name,) for pattern in song.patterns[:1]):
        if names not in flat:
            flat[names] = [by_name[name] for name in _with_virtual(names, song.virtual) if name in by_name]
        found.append(flat[names])
        if len(found) > MOST_BARS:
            raise BadInput(source, "", f"plays more than {MOST_BARS:,} columns")
        strokes += 1 + sum(1 + len(pattern.notes) for pattern in flat[names])
        if strokes > _MOST_STROKES:
            raise BadInput(source, "", f"plays more than {_MOST_STROKES:,} notes")
    return found


def _with_virtual(names: Sequence[str], virtual: Mapping[str, tuple[str, ...]]) -> list[str]:
    found: dict[str, None] = {}
    waiting = list(reversed(names))
    while waiting:
        name = waiting.pop()
        if name not in found:
            found[name] = None
            waiting += reversed(virtual.get(name, ()))
    return list(found)


def _size(column: Sequence[Pattern]) -> int:
    return max((pattern.size for pattern in column), default=WHOLE_NOTE)


def _tempo_map(song: HydrogenSong, columns: Sequence[Sequence[Pattern]], starts: Sequence[int]) -> TempoMap:
    """The tempo and the meter of each column, whose bars begin with it."""
    tempos = [TempoChange.from_bpm(0, song.bpm)]
    tempos += [TempoChange.from_bpm(starts[bar] * SCORE_TICKS, bpm) for bar, bpm in song.tempos if bar < len(columns)]
    meters = []
    for start, column in zip(starts, columns, strict=False):
        longest = max(column, key=lambda pattern: pattern.size, default=Pattern("", WHOLE_NOTE, 4, ()))
        beats, unit = _meter(longest.size, longest.denominator)
        meters.append(MeterChange(start * SCORE_TICKS, beats, unit))
    return TempoMap.build(tempos, meters)


def _meter(size: int, denominator: int) -> tuple[int, int]:
    for unit in (denominator, *_UNITS):
        if unit & (unit - 1) == 0 and unit <= 64 and size * unit % WHOLE_NOTE == 0:
            return size * unit // WHOLE_NOTE, unit
    return -(-size * 4 // WHOLE_NOTE), 4


def _sections(tags: Sequence[tuple[int, str]], bars: int) -> tuple[PartSection, ...]:
    """A section from each tag to the next; one without a name ends that before it."""
    named = sorted({bar: name for bar, name in tags if bar < bars}.items())
    ends = [bar - 1 for bar, _ in named[1:]] + [bars - 1]
    return tuple(PartSection(name, bar, end) for (bar, name), end in zip(named, ends, strict=False) if name)


# --- strokes ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Placed:
    """A note at a tick of the song, and the factor on its velocity."""

    tick: int
    factor: float
    note: PatternNote


def _factor(curve: NDArray[np.float64], index: int, note: PatternNote, column: Sequence[Pattern]) -> float:
    """What the song's curve of velocities (points of column and factor, shape (n, 2)) says where the note is."""
    if not len(curve):
        return 1.0
    return float(np.interp(index + note.position / _size(column), curve[:, 0], curve[:, 1]))


def _swing(factor: float) -> Swing:
    """Hydrogen's swing, of sixteenths: the second one comes later by `factor` halves of its length."""
    if not factor:
        return Swing()
    late = Fraction(factor).limit_denominator(1000) * SWING_TICKS
    return Swing(float((SIXTEENTH + late) / (SIXTEENTH - late)), PPQ // 4)


def _band(instruments: Sequence[Instrument]) -> dict[int, tuple[Instrument, NoteMeaning | None]]:
    """What each instrument plays, by id; of those that are counted a second one of a number moves on to the next."""
    trusts_notes = are_chosen([one.midi_note for one in instruments])
    taken: set[SoundName] = set()
    band: dict[int, tuple[Instrument, NoteMeaning | None]] = {}
    for one in instruments:
        sound = sound_of_instrument(one.name, one.kind, one.midi_note if trusts_notes else None)
        family = next((each for each in FAMILIES if sound in each), ())
        if sound in taken:
            sound = next((name for name in family if name not in taken), sound)
        if sound is not None:
            taken.add(sound)
        band.setdefault(one.id, (one, None if sound is None else _strike(sound, one.name)))
    return band


def _strike(sound: SoundName, name: str) -> NoteMeaning:
    strike = strike_of_sound(sound)
    on_edge = strike.piece is Piece.HIHAT and "edge" in name.lower()
    on_bow = strike.piece in (Piece.CRASH_1, Piece.CRASH_2, Piece.SPLASH, Piece.CHINA) and "bow" in name.lower()
    return replace(strike, zone=Zone.EDGE) if on_edge else replace(strike, zone=Zone.BOW) if on_bow else strike


def _strokes(
    placed: Sequence[_Placed], band: Mapping[int, tuple[Instrument, NoteMeaning | None]], swing: Swing, factor: float
) -> list[Note]:
    """The notes that sound as strokes, in the order of their ticks; stop notes choke the last stroke of theirs."""
    found: list[Note] = []
    last: dict[int, int] = {}
    for each in sorted(placed, key=lambda one: (_sounds(one), not one.note.is_stop)):
        instrument, strike = band.get(each.note.instrument, (None, None))
        if instrument is not None and instrument.is_silent:
            continue
        late = factor * SWING_TICKS if each.note.position % (2 * SIXTEENTH) == SIXTEENTH else 0.0
        tick = max(round((_sounds(each) + late) * SCORE_TICKS), 0)
        if each.note.is_stop:
            index = last.get(each.note.instrument)
            if index is not None and found[index].piece in CHOKEABLE and not found[index].choke_ticks:
                found[index] = replace(found[index], choke_ticks=tick - found[index].tick)
            continue
        velocity = int(FULL_VELOCITY * each.note.velocity * each.factor)
        if velocity < 1:
            continue
        last[each.note.instrument] = len(found)
        note = _note(strike or NoteMeaning(Piece.PERCUSSION), tick, min(velocity, FULL_VELOCITY), each.note.length)
        written = round(late * SCORE_TICKS) if swing.stands_in_words else 0
        midi_note = 0 if instrument is None or instrument.midi_note is None else instrument.midi_note
        found.append(replace(note, swing_ticks=written, midi_note=midi_note))
    return found


def _sounds(placed: _Placed) -> float:
    """Where a note sounds, in Hydrogen's ticks, swing apart."""
    return placed.tick + LEAD_LAG_TICKS * placed.note.lead_lag


def _note(strike: NoteMeaning, tick: int, velocity: int, length: int) -> Note:
    is_buzz = strike.articulation is Articulation.BUZZ
    return Note(
        tick,
        strike.piece,
        strike.zone,
        velocity,
        strike.articulation,
        openness=strike.openness,
        ornament=Ornament.ROLL if is_buzz else Ornament.NONE,
        duration_ticks=length * SCORE_TICKS if is_buzz and length != ENTIRE_SAMPLE else 0,
    )


def _without_layers(notes: Sequence[Note]) -> list[Note]:
    """Of strokes at one tick that are the same strike (two kicks at once), the loudest."""
    best: dict[tuple[object, ...], Note] = {}
    for note in notes:
        key = (note.tick, note.piece, note.zone, note.articulation, note.openness)
        if key not in best or note.velocity > best[key].velocity:
            best[key] = note
    return list(best.values())


def _lost(
    placed: Sequence[_Placed], band: Mapping[int, tuple[Instrument, NoteMeaning | None]], chance: int
) -> Iterator[str]:
    silent, unknown = dict[str, int](), dict[str, int]()
    for each in placed:
        instrument, strike = band.get(each.note.instrument, (None, None))
        name = instrument.name if instrument is not None else f"number {each.note.instrument}"
        if instrument is not None and instrument.is_silent:
            silent[name] = silent.get(name, 0) + 1
        elif strike is None:
            unknown[name] = unknown.get(name, 0) + 1
    yield from (f"notes of the muted instrument {name!r}: {count}" for name, count in silent.items())
    yield from (f"notes of {name!r}, read as percussion: {count}" for name, count in unknown.items())
    if chance:
        yield f"notes that Hydrogen plays only now and then, read as always: {chance}"
