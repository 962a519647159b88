"""A part as a GrooveScribe link: the coarsest division that has a cell for every stroke, a letter for each.

There is no link at all for a part of more than ten bars, of several meters, or with strokes that no division has.
What a letter does not say is told with its bars: of each stroke the nearest letter is written.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from station.core.disk.utf8 import one_line
from station.core.errors import BadInput
from station.core.pieces import Articulation, Limb
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.groovescribe.groove_letters import HANDS, LETTERS
from station.music.formats.groovescribe.groove_nearest import SENTENCES, nearest_letter
from station.music.formats.groovescribe.groove_query import (
    DIVISIONS,
    LEAST_TEMPO,
    MOST_BARS,
    MOST_BEATS,
    MOST_SWING,
    MOST_TEMPO,
    UNITS,
    Groove,
    groove_url,
)
from station.music.formats.groovescribe.groove_reader import part_of_groove, swing_of
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature, Loss, WrittenFile
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange

KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "4 to 48 cells a whole note, one meter, at most ten bars",
        Feature.PIECES: "two toms, one crash, one ride; one cymbal at a time",
        Feature.TEMPO: "one, 20 to 400, in whole numbers",
        Feature.METERS: "one",
        Feature.SWING: "of eighths, sixteenths or 32nds, in whole percent to 3:1",
        Feature.DYNAMICS: "ghosts and accents of the snare, accents of the closed hi-hat",
        Feature.CROSS_STICKS: "",
        Feature.OPENNESS: "open or closed",
        Feature.FLAMS: "of the snare, as loud as a plain stroke",
        Feature.DRAGS: "of the snare, as loud as a plain stroke",
        Feature.BUZZES: "of the snare, to the hands' next stroke in the beat",
        Feature.STICKING: "where one hand strikes at a time",
        Feature.TITLE: "",
        Feature.AUTHOR: "",
        Feature.ABOUT: "",
    }
)

_HAND_LETTERS = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L"}
_REST = "-"
_FIRST = "csbrmXxoONnfdgb"
"""Of two letters on one line the first of these is written: a crash before a ride, that before the hi-hat."""
_SAME_RATIO = 1e-9
"""Below any difference that a file writes."""


def write_groove(part: DrumPart) -> WrittenFile:
    """The link as UTF-8 text, a line; raises `BadInput` where a groove has no place for the part."""
    groove, lost = groove_of(part)
    return WrittenFile((groove_url(groove) + "\n").encode(), lost)


def groove_of(part: DrumPart) -> tuple[Groove, tuple[Loss, ...]]:
    """The groove that is nearest to `part`, and what it has not; raises `BadInput`."""
    losses = LostBars()
    bars = _bars(part)
    score, division, percent = _timed(part, losses)
    meter = score.tempo_map.meters[0]
    groove = Groove(
        meter=replace(meter, groups=()),
        division=division,
        bars=bars,
        tempo=_tempo(score, losses),
        swing=percent,
        title=one_line(score.title),
        author=one_line(part.author),
        comments=one_line(part.about),
    )
    lines, stickings = _lines(score, groove, losses)
    if part.sections:
        losses.add(Feature.SECTIONS, "a groove has no names of sections")
    if score.loudness:
        losses.add(Feature.LOUDNESS, "a groove has no loudness marks")
    if meter.groups:
        losses.add(Feature.METER_GROUPS, f"a groove's meter is {meter.beats}/{meter.unit} without groups")
    written = replace(groove, lines=lines, stickings=stickings)
    _check_lengths(part.score, written, losses)
    return written, losses.told()


# --- the frame --------------------------------------------------------------------------------------------------------


def _bars(part: DrumPart) -> int:
    tempo_map, end = part.score.tempo_map, part.score.end_tick
    meters = tempo_map.section(0, max(end, 1)).meters
    if len(meters) > 1:
        bar = int(tempo_map.bars_at(meters[1].tick)) + 1
        raise BadInput(_name(part), f"bar {bar}", f"a groove has one meter; {meters[1]} follows {meters[0]} here")
    if meters[0].unit not in UNITS or meters[0].beats > MOST_BEATS:
        raise BadInput(_name(part), "", f"GrooveScribe has no meter of {meters[0]}")
    bars = -(-end // meters[0].bar_ticks)
    if not 1 <= bars <= MOST_BARS:
        raise BadInput(_name(part), "", f"a groove has 1 to {MOST_BARS} bars; this part has {bars}")
    return bars


def _name(part: DrumPart) -> str:
    return part.score.title or "part"


def _timed(part: DrumPart, losses: LostBars) -> tuple[Score, int, int]:
    """The strokes on the cells of a division, that division, and the percent of its swing."""
    ratio, unit = part.swing.ratio, part.swing.unit_ticks
    if not part.swing.stands_in_words:
        score = part.score
        if score.notes["swing_ticks"].any():  # of some sections alone
            score = score.as_written
            for feature in (Feature.SWING, Feature.TIMES):
                losses.add(feature, "swing of some bars is left out: a groove has one swing throughout")
        return score, _division(part, score), 0
    score = part.score.as_written
    percent = min(round(100 * (ratio - 1) / (ratio + 1)), MOST_SWING)
    swung = Groove(meter=score.tempo_map.meters[0], division=4 * PPQ // unit, swing=percent)
    if not swung.swings or 4 * PPQ % unit or not _fits(score, swung.meter, swung.division):
        for feature in (Feature.SWING, Feature.TIMES):
            losses.add(feature, f"swing of {ratio:g}:1 is left out: GrooveScribe swings the finest cells alone")
        return score, _division(part, score), 0
    said = swing_of(percent, unit)
    if abs(said.ratio - ratio) > _SAME_RATIO:
        for feature in (Feature.SWING, Feature.TIMES):
            losses.add(feature, f"swing of {ratio:g}:1 becomes {said.ratio:.4g}:1")
    return score, swung.division, percent


def _division(part: DrumPart, score: Score) -> int:
    """The coarsest division with a cell for every stroke; raises `BadInput` with the bar of a stroke without one."""
    meter, ticks = score.tempo_map.meters[0], score.notes["tick"]
    for division in DIVISIONS:
        if _fits(score, meter, division):
            return division
    spare = [ticks % (4 * PPQ // division) > 0 for division in (32, 48)]
    alone = np.flatnonzero(spare[0] & spare[1])
    bar = int(score.tempo_map.bars_at(int(ticks[alone[0] if len(alone) else 0]))) + 1
    fault = "strokes here are on no cell of 1/32 or of triplets" if len(alone) else "32nds and triplets in one groove"
    raise BadInput(_name(part), f"bar {bar}", f"{fault}, which GrooveScribe has no division for")


def _fits(score: Score, meter: MeterChange, division: int) -> bool:
    whole_bar = meter.beats * division % meter.unit == 0
    return whole_bar and not (score.notes["tick"] % (4 * PPQ // division)).any()


def _tempo(score: Score, losses: LostBars) -> int:
    bpm = score.tempo_map.bpm_at(0)
    used = min(max(round(bpm), LEAST_TEMPO), MOST_TEMPO)
    if score.tempo_map.tempos[0] != TempoChange.from_bpm(0, used):
        losses.add(Feature.TEMPO, f"{bpm:.4g} quarters a minute become {used}")
    for change in score.tempo_map.tempos[1:]:
        if change.tick < score.end_tick:
            losses.add(
                Feature.TEMPO,
                "a groove has one tempo; its change is left out",
                int(score.tempo_map.bars_at(change.tick)),
            )
    return used


# --- the letters ------------------------------------------------------------------------------------------------------


def _lines(score: Score, groove: Groove, losses: LostBars) -> tuple[dict[str, str], str]:
    """The letters of all lines that have any (H, S and K always), and the stickings."""
    size = groove.cells_per_bar * groove.bars
    lines = {name: [_REST] * size for name in LETTERS}
    hands: dict[int, list[Limb]] = {}
    for note in score:
        if note.lead_ms > 0:
            continue
        cell, bar = note.tick // groove.cell_ticks, note.tick // groove.meter.bar_ticks
        name, letter = nearest_letter(note, bar, losses)
        lines[name][cell] = _joined(name, lines[name][cell], letter, note, bar, losses)
        if name in HANDS:
            hands.setdefault(cell, []).append(note.limb)
    written = {name: "".join(line) for name, line in lines.items() if name in "HSK" or any(c != _REST for c in line)}
    return written, _stickings(hands, groove, losses)


def _joined(name: str, there: str, letter: str, note: Note, bar: int, losses: LostBars) -> str:
    """What a cell of a line says when `letter` comes to what is `there`."""
    if there in (_REST, letter):
        return letter
    if {there, letter} <= set("oxX") and name == "K":
        return "X"
    for feature in (Feature.PIECES, Feature.TIMES):
        losses.add(feature, f"of two strokes at once on the line {name} one is left out", bar)
    return min(there, letter, key=_FIRST.index)


def _stickings(hands: Mapping[int, list[Limb]], groove: Groove, losses: LostBars) -> str:
    """A letter a cell where one hand strikes; "" where no hand is said at all."""
    letters = [_REST] * (groove.cells_per_bar * groove.bars)
    for cell, limbs in hands.items():
        said = [limb for limb in limbs if limb in _HAND_LETTERS]
        if len(limbs) == 1 and said:
            letters[cell] = _HAND_LETTERS[said[0]]
        elif said:
            letters[cell] = "B" if len(said) > 1 else _REST
            losses.add(Feature.STICKING, "which hand plays which of two strokes", cell // groove.cells_per_bar)
    return "".join(letters) if any(letter != _REST for letter in letters) else ""


def _check_lengths(score: Score, written: Groove, losses: LostBars) -> None:
    """Tells the bars where strokes come back at another time, and buzzes with another length."""
    back = part_of_groove(written).score
    for feature, places in (
        (Feature.TIMES, (_times(score), _times(back))),
        (Feature.BUZZES, (_buzzes(score), _buzzes(back))),
    ):
        for tick, *_ in sorted(places[0] - places[1]):
            losses.add(feature, SENTENCES[feature], tick // written.meter.bar_ticks)


def _times(score: Score) -> set[tuple[int, ...]]:
    return {(tick,) for tick in score.notes["tick"][~score.is_grace].tolist()}


def _buzzes(score: Score) -> set[tuple[int, ...]]:
    rows = score.notes[score.notes["articulation"] == Articulation.BUZZ]
    return set(zip(rows["tick"].tolist(), rows["duration_ticks"].tolist(), strict=True))
