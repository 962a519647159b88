"""A part as a song of Hydrogen's: a column a bar, a pattern for each bar that is unlike the others.

A stroke lies at a tick, or at the next with a lead, so that Hydrogen plays it where the part has it. Swung sixteenths
are written straight with the swing factor, any other swing where it sounds. Instruments are named as in Hydrogen's own
kit. Grace strokes are notes of their own, before their stroke by their time.
"""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil
from types import MappingProxyType

import numpy as np

from station.core.disk.utf8 import one_line
from station.core.errors import BadInput
from station.core.pieces import CHOKEABLE, Articulation, Ornament
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.hydrogen.instrument_strikes import InstrumentStrike, instrument_for, instrument_of
from station.music.formats.hydrogen.rock_kit import KIT, kit_id
from station.music.formats.hydrogen.song_contents import (
    ENTIRE_SAMPLE,
    FULL_VELOCITY,
    LEAD_LAG_TICKS,
    LEAST_BPM,
    MOST_BPM,
    SCORE_TICKS,
    SIXTEENTH,
    SWING_TICKS,
    HydrogenSong,
    Pattern,
    PatternNote,
)
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature, Loss
from station.music.score import Note, Score
from station.music.swing import STRAIGHT

SONG_KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "a 48th of a quarter note, and a lead for the rest; grace strokes are strokes like others",
        Feature.PIECES: "",
        Feature.TEMPO: "from 10 to 400, changes where a bar begins",
        Feature.METERS: "",
        Feature.SWING: "of sixteenths, to 3:1; other swing is written where it sounds",
        Feature.VELOCITIES: "",
        Feature.ZONES: "the ride's bell and edge, the hi-hat's edge, the other cymbals' bow, rims of toms",
        Feature.CROSS_STICKS: "",
        Feature.RIM_SHOTS: "",
        Feature.OPENNESS: "in quarters",
        Feature.FOOT_SPLASHES: "",
        Feature.BUZZES: "of the snare",
        Feature.CHOKES: "",
        Feature.TITLE: "",
        Feature.AUTHOR: "",
        Feature.ABOUT: "",
        Feature.SECTIONS: "",
    }
)
PATTERN_KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: SONG_KEEPS[Feature.TIMES].partition(";")[0],
        Feature.PIECES: "those of Hydrogen's own kit",
        Feature.VELOCITIES: "",
        Feature.ZONES: "the ride's bell",
        Feature.CROSS_STICKS: "",
        Feature.RIM_SHOTS: "",
        Feature.OPENNESS: "closed, half open and open",
        Feature.CHOKES: "",
        Feature.TITLE: "",
        Feature.AUTHOR: "",
        Feature.ABOUT: "",
    }
)

_HALF_STEP = 0.5
"""Added to a velocity, so that Hydrogen, which cuts it, finds the same again."""
_UNHEARD = 0.05
"""The ticks by which a stroke may lag: half a millisecond at 120 quarters a minute (our choice)."""


@dataclass(frozen=True, slots=True)
class _Event:
    """A note at a tick of the song, in score ticks."""

    tick: int
    strike: InstrumentStrike
    velocity: int
    length: int = ENTIRE_SAMPLE
    is_stop: bool = False


def song_of_part(part: DrumPart) -> tuple[HydrogenSong, tuple[Loss, ...]]:
    """The song that plays `part`, and what it has not; raises `BadInput` for a bar that no pattern is as long as."""
    losses = LostBars()
    starts = _bar_starts(part)
    score, factor = _straight(part, starts, losses)
    events = _events(score, losses)
    strikes = sorted({event.strike for event in events}, key=lambda one: (kit_id(one.sound), one.name))
    ids = {strike: i for i, strike in enumerate(strikes)}
    patterns, columns = _patterns(_by_bar(events, starts, ids), starts, score)
    if any(meter.groups for meter in score.tempo_map.meters):
        losses.add(Feature.METER_GROUPS, "Hydrogen has no groups of meters")
    song = HydrogenSong(
        *(one_line(part.score.title), one_line(part.author), one_line(part.about)),
        *(_bpm(score.tempo_map.tempos[0].short_bpm(), 0, losses), factor),
        tuple(instrument_of(i, strike) for strike, i in ids.items()),
        patterns,
        columns,
        tempos=tuple(_tempos(score, starts, losses).items()),
        tags=_tags(part, len(columns)),
    )
    return song, losses.told()


def pattern_of_part(part: DrumPart) -> tuple[HydrogenSong, tuple[Loss, ...]]:
    """All bars of `part` as one pattern for Hydrogen's own kit, and what it has not."""
    losses = LostBars()
    score, starts = part.score, _bar_starts(part)
    events = _events(score, losses, for_kit=True)
    ids = {InstrumentStrike(one.sound): i for i, one in enumerate(KIT)}
    if len({(event.tick, event.strike, event.is_stop) for event in events}) < len(events):
        losses.add(Feature.TIMES, "strokes at once that share an instrument of Hydrogen's kit")
    notes = _by_bar(events, [0, starts[-1]], ids)[0]
    name = one_line(score.title) or "Pattern"
    pattern = Pattern(name, starts[-1] // SCORE_TICKS, score.tempo_map.meters[0].unit, notes)
    about = (one_line(part.author), one_line(part.about))
    return HydrogenSong(name, *about, patterns=(pattern,), columns=((name,),)), losses.told()


# --- the frame --------------------------------------------------------------------------------------------------------


def _bar_starts(part: DrumPart) -> list[int]:
    """Where the bars begin, and where the last one ends; all are on Hydrogen's ticks."""
    score = part.score
    starts = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count)] + [max(score.end_tick, SCORE_TICKS)]
    for bar, tick in enumerate(starts[1:]):
        if tick % SCORE_TICKS:
            meter = score.tempo_map.meter_at(starts[bar])
            fault = f"Hydrogen has no bar of {meter}: its shortest note is a 48th of a quarter"
            raise BadInput(score.title or "part", f"bar {bar + 1}", fault)
    return starts


def _straight(part: DrumPart, starts: Sequence[int], losses: LostBars) -> tuple[Score, float]:
    """The strokes where Hydrogen writes them, and its swing factor; where it swings otherwise, as they sound and 0."""
    ratio, rows = part.swing.ratio, part.score.notes
    if ratio == STRAIGHT:
        if rows["swing_ticks"].any():
            losses.add(Feature.SWING, "swing of some bars is written where it sounds")
        return part.score, 0.0
    factor = SIXTEENTH / SWING_TICKS * (ratio - 1) / (ratio + 1)
    straight = rows["tick"] - rows["swing_ticks"]
    inside = straight - np.array(starts)[np.searchsorted(starts, straight, side="right") - 1]
    late = np.where(inside % (2 * SIXTEENTH * SCORE_TICKS) == SIXTEENTH * SCORE_TICKS, SWING_TICKS * factor, 0.0)
    is_so = (np.abs(straight + late * SCORE_TICKS - rows["tick"]) <= 1).all()
    if part.swing.unit_ticks == PPQ // 4 and part.swing.stands_in_words and factor <= 1 and is_so:
        return part.score.as_written, factor
    losses.add(Feature.SWING, f"swing of {ratio:g}:1 is written where it sounds: Hydrogen swings sixteenths alone")
    return part.score, 0.0


def _bpm(bpm: float, bar: int, losses: LostBars) -> float:
    used = min(max(bpm, LEAST_BPM), MOST_BPM)
    if used != bpm:
        losses.add(Feature.TEMPO, f"Hydrogen plays {LEAST_BPM:g} to {MOST_BPM:g} quarters a minute", bar)
    return used


def _tempos(score: Score, starts: Sequence[int], losses: LostBars) -> dict[int, float]:
    """The tempos by the bars with which they begin."""
    found = {}
    for change in score.tempo_map.tempos[1:]:
        if change.tick >= score.end_tick:
            break
        bar = int(np.argmin(np.abs(np.array(starts[:-1]) - change.tick)))
        if starts[bar] != change.tick:
            losses.add(Feature.TEMPO, "a tempo that changes within a bar changes with the nearest", bar)
        found[bar] = _bpm(change.short_bpm(), bar, losses)
    return found


def _tags(part: DrumPart, bars: int) -> tuple[tuple[int, str], ...]:
    """The names of the sections where they begin, and an empty one where a section ends and none follows."""
    names = {section.last_bar + 1: "" for section in part.sections if section.last_bar + 1 < bars}
    names |= {section.first_bar: one_line(section.name) for section in part.sections}
    return tuple(sorted(names.items()))


def _patterns(
    bars: Sequence[tuple[PatternNote, ...]], starts: Sequence[int], score: Score
) -> tuple[tuple[Pattern, ...], tuple[tuple[str, ...], ...]]:
    """A pattern for each bar that is unlike the others, and the columns that play them."""
    known: dict[tuple[int, int, tuple[PatternNote, ...]], Pattern] = {}
    columns = []
    for bar, notes in enumerate(bars):
        size = (starts[bar + 1] - starts[bar]) // SCORE_TICKS
        unit = score.tempo_map.meter_at(starts[bar]).unit
        pattern = known.setdefault((size, unit, notes), Pattern(f"Bar {bar + 1}", size, unit, notes))
        columns.append((pattern.name,))
    return tuple(known.values()), tuple(columns)


# --- strokes ----------------------------------------------------------------------------------------------------------


def _events(score: Score, losses: LostBars, for_kit: bool = False) -> list[_Event]:
    """All notes; `for_kit` with the instruments of Hydrogen's kit alone and, for want of a tempo, no grace strokes."""
    found = []
    onsets_ns = score.on_the_grid.onset_ns.tolist()
    for note, bar, onset_ns in zip(score, score.bar.tolist(), onsets_ns, strict=True):
        tick = note.tick
        if note.lead_ms > 0:
            tick = int(score.tempo_map.ticks_at_ns(onset_ns))
            if for_kit or tick < 0:
                feature = Feature.FLAMS if note.ornament is Ornament.FLAM else Feature.DRAGS
                losses.add(feature, "grace strokes that a pattern has no tempo for, or before the song begins", bar)
                continue
        strike = instrument_for(note, bar, losses, for_kit)
        length = _length(note, bar, losses) if note.articulation is Articulation.BUZZ else ENTIRE_SAMPLE
        found.append(_Event(tick, strike, note.velocity, length))
        if note.choke_ticks:
            stop = note.tick + note.choke_ticks
            if note.piece in CHOKEABLE and stop <= score.end_tick:
                found.append(_Event(stop, strike, note.velocity, is_stop=True))
            else:
                losses.add(Feature.CHOKES, "chokes after the end, or of what does not ring", bar)
    return found


def _length(note: Note, bar: int, losses: LostBars) -> int:
    length, rest = divmod(note.duration_ticks, SCORE_TICKS)
    if rest or not length:
        losses.add(Feature.BUZZES, "buzzes that last no whole 48th of a quarter", bar)
    return length or ENTIRE_SAMPLE


def _position(inside: float) -> int:
    """The tick for a stroke `inside` ticks after its bar's start, from which it leads, for lags are not always played.

    (h2cli 1.2 leaves them out.) Off the beat it is no place that swing would delay.
    """
    position = ceil(inside - _UNHEARD)
    return position - (position % (2 * SIXTEENTH) == SIXTEENTH and abs(position - inside) > _UNHEARD)


def _by_bar(
    events: Sequence[_Event], starts: Sequence[int], ids: Mapping[InstrumentStrike, int]
) -> list[tuple[PatternNote, ...]]:
    """The notes of each bar, in the order of their places."""
    bars: list[list[PatternNote]] = [[] for _ in starts[1:]]
    for event in events:
        bar = min(max(bisect_right(starts, event.tick) - 1, 0), len(bars) - 1)
        size = (starts[bar + 1] - starts[bar]) // SCORE_TICKS
        inside = (event.tick - starts[bar]) / SCORE_TICKS
        position = min(max(_position(inside), 0), size - 1)
        bars[bar].append(
            PatternNote(
                position,
                ids[event.strike],
                min((event.velocity + _HALF_STEP) / FULL_VELOCITY, 1.0),
                (inside - position) / LEAD_LAG_TICKS,
                length=event.length,
                is_stop=event.is_stop,
            )
        )
    return [tuple(sorted(bar, key=lambda note: (note.position + note.lead_lag, note.instrument))) for bar in bars]
