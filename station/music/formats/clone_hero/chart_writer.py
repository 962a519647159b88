"""A drum part as a `.chart` with pro drums for Expert.

Ticks are exact: the file's resolution is the coarsest that has a tick for every stroke. Pieces that a chart has no lane
for go to the nearest, or are left out where the game has nothing like them; all of that is told. A kick of the left
foot is the second kick, a buzz roll a roll lane over one note.
"""

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from station.core.disk.utf8 import one_line
from station.core.errors import BadInput
from station.core.labels import piece_name
from station.core.pieces import DRUMS, Articulation, Dynamic, Limb, Ornament, word
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.clone_hero.chart_text import (
    ACCENT_MARK,
    CYMBAL_MARK,
    FLAM_MARK,
    GHOST_MARK,
    MOST_METER_BEATS,
    ROLL_LANE,
    SECOND_KICK,
    US_TIMES_MILLI_BPM,
)
from station.music.formats.clone_hero.drum_chart import Lane
from station.music.formats.clone_hero.drum_lanes import LANE_OF, NEAR_LANE_OF
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature, WrittenFile
from station.music.score import Note, Score

KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "",
        Feature.PIECES: "kick, snare, hi-hat, ride, crash, high, mid and floor tom",
        Feature.TEMPO: "to 1/1000 of a beat a minute",
        Feature.METERS: "",
        Feature.DYNAMICS: "not of the kick",
        Feature.FLAMS: "on the snare and the toms",
        Feature.BUZZES: "on the snare and the toms",
        Feature.FEET: "of the kick",
        Feature.TITLE: "",
        Feature.AUTHOR: "",
        Feature.SECTIONS: "where one follows the other to the end",
    }
)

_RESOLUTIONS = (192, 480, 960, 1920, 3840, 26_880, PPQ)
"""Ticks a quarter note, coarsest first: Moonscraper's, the game's usual 480, finer ones, and our own."""
_OF_A_STROKE = (Feature.TIMES, Feature.PIECES, Feature.DYNAMICS, Feature.FLAMS, Feature.BUZZES, Feature.FEET)
"""What is lost of a stroke that is left out."""
_MARKS = {Dynamic.ACCENT: ACCENT_MARK, Dynamic.GHOST: GHOST_MARK}


def write_chart(part: DrumPart) -> WrittenFile:
    """The part as the text of a `.chart`; raises `BadInput` where no stroke has a lane."""
    lost = LostBars()
    score = part.score
    resolution = _resolution(score)
    per_tick = PPQ // resolution
    blocks = {
        "Song": _song(part, resolution),
        "SyncTrack": list(_sync(score, per_tick, lost)),
        "Events": list(_events(part, per_tick, lost)),
        "ExpertDrums": list(_track(score, per_tick, lost)),
    }
    if not any(" = N " in line for line in blocks["ExpertDrums"]):
        raise BadInput(score.title or "part", "", "the games have no lane for any of its strokes")
    lines = [line for name, body in blocks.items() for line in (f"[{name}]", "{", *(f"  {b}" for b in body), "}")]
    return WrittenFile(("\r\n".join(lines) + "\r\n").encode(), lost.told())


def _resolution(score: Score) -> int:
    """The coarsest resolution with a tick for everything; every one of them divides `PPQ`."""
    rows = score.notes
    ticks = {*rows["tick"].tolist(), *(rows["tick"] + rows["duration_ticks"]).tolist(), score.end_tick}
    ticks |= {t.tick for t in score.tempo_map.tempos} | {m.tick for m in score.tempo_map.meters}
    return next(r for r in _RESOLUTIONS if all(tick % (PPQ // r) == 0 for tick in ticks))


def _song(part: DrumPart, resolution: int) -> list[str]:
    return [
        f'Name = "{one_line(part.score.title)}"',
        f'Artist = "{one_line(part.author)}"',
        f"Resolution = {resolution}",
    ]


def _sync(score: Score, per_tick: int, lost: LostBars) -> Iterator[str]:
    for meter in score.tempo_map.meters:
        bar = int(score.tempo_map.bars_at(meter.tick))
        if meter.unit & (meter.unit - 1) or meter.beats > MOST_METER_BEATS:
            lost.add(Feature.METERS, f"a chart cannot say {meter}", bar)
            continue
        if meter.groups:
            lost.add(Feature.METER_GROUPS, "a chart's meters have no groups", bar)
        yield f"{meter.tick // per_tick} = TS {meter.beats} {meter.unit.bit_length() - 1}"
    for tempo in score.tempo_map.tempos:
        milli_bpm = max(round(US_TIMES_MILLI_BPM / tempo.us_per_quarter), 1)
        if round(US_TIMES_MILLI_BPM / milli_bpm) != tempo.us_per_quarter:
            bar = int(score.tempo_map.bars_at(tempo.tick))
            lost.add(Feature.TEMPO, f"a chart has {milli_bpm / 1000:g} as the nearest tempo", bar)
        yield f"{tempo.tick // per_tick} = B {milli_bpm}"


def _events(part: DrumPart, per_tick: int, lost: LostBars) -> Iterator[str]:
    tempo_map = part.score.tempo_map
    ends = [*(s.first_bar for s in part.sections[1:]), part.score.bar_count]
    for section, end in zip(part.sections, ends, strict=False):
        name = one_line(section.name)
        if section.last_bar + 1 != end:
            lost.add(
                Feature.SECTIONS, f"of no section from here on; in the file {name!r} goes on", section.last_bar + 1
            )
        yield f'{tempo_map.bar_start(section.first_bar) // per_tick} = E "section {name}"'
    yield f'{part.score.end_tick // per_tick} = E "end"'


# --- the track -------------------------------------------------------------------------------------------------------


def _track(score: Score, per_tick: int, lost: LostBars) -> Iterator[str]:
    strokes = [note for note in score if not note.lead_ms]
    taken: dict[tuple[int, Lane, bool], Note] = {}
    for note in strokes:
        place = _placed(score, note, lost)
        if place is None:
            continue
        lane, is_cymbal = place
        is_second = lane is Lane.KICK and note.limb is Limb.LEFT_FOOT
        if (note.tick, lane, is_second) in taken:
            _left_out(score, note, "a chart has one note of a colour at a time", lost)
            continue
        taken[note.tick, lane, is_second] = note
        for number in _numbers(score, note, lane, is_cymbal, lost):
            yield f"{note.tick // per_tick} = N {number} 0"
    yield from _tick_marks(score, taken, per_tick, lost)


def _placed(score: Score, note: Note, lost: LostBars) -> tuple[Lane, bool] | None:
    """The lane of `note` and whether it is a cymbal there; None where a chart has no place for it."""
    if note.piece in LANE_OF:
        return LANE_OF[note.piece]
    if note.piece in NEAR_LANE_OF:
        bar = int(score.tempo_map.bars_at(note.tick))
        lost.add(Feature.PIECES, f"a chart has no {piece_name(note.piece)}: it goes to the nearest lane", bar)
        return NEAR_LANE_OF[note.piece]
    _left_out(score, note, f"a chart has no {piece_name(note.piece)}", lost)
    return None


def _left_out(score: Score, note: Note, text: str, lost: LostBars) -> None:
    bar = int(score.tempo_map.bars_at(note.tick))
    for feature in _OF_A_STROKE:
        lost.add(feature, f"{text}: {piece_name(note.piece)} is left out", bar)


def _numbers(score: Score, note: Note, lane: Lane, is_cymbal: bool, lost: LostBars) -> Iterator[int]:
    """The numbers of the note and of the marks that are its own."""
    yield SECOND_KICK if lane is Lane.KICK and note.limb is Limb.LEFT_FOOT else int(lane)
    if is_cymbal:
        yield lane + CYMBAL_MARK
    if note.dynamic in _MARKS and lane is not Lane.KICK:
        yield lane + _MARKS[note.dynamic]
    elif note.dynamic in _MARKS:
        bar = int(score.tempo_map.bars_at(note.tick))
        lost.add(Feature.DYNAMICS, f"a chart's kick has no {word(note.dynamic)}", bar)


def _tick_marks(
    score: Score, taken: Mapping[tuple[int, Lane, bool], Note], per_tick: int, lost: LostBars
) -> Iterator[str]:
    """Flams and roll lanes, which a chart marks on a tick for all that stands there."""
    by_tick: dict[int, dict[Lane, Note]] = {}
    for (tick, lane, _), note in taken.items():
        if lane is not Lane.KICK:
            by_tick.setdefault(tick, {})[lane] = note
    ticks = sorted(by_tick)
    roll_end = 0
    for at, tick in enumerate(ticks):
        bar = int(score.tempo_map.bars_at(tick))
        notes = by_tick[tick]
        flams = [n for n in notes.values() if n.ornament is Ornament.FLAM]
        drums = [n for n in notes.values() if n.piece in DRUMS and n.articulation is not Articulation.BUZZ]
        if flams and len(flams) == len(drums) and all(n in drums for n in flams):
            yield f"{tick // per_tick} = N {FLAM_MARK} 0"
        elif flams:
            lost.add(Feature.FLAMS, "a chart marks all drums of a moment as flams or none", bar)
        for lane, note in notes.items():
            if note.articulation is not Articulation.BUZZ:
                continue
            later = (by_tick[t] for t in _until(ticks, at, tick + note.duration_ticks))
            if note.piece not in DRUMS or len(notes) > 1 or tick < roll_end or any(lane in other for other in later):
                lost.add(Feature.BUZZES, "a chart rolls one hand's note alone", bar)
                continue
            roll_end = tick + note.duration_ticks
            yield f"{tick // per_tick} = S {ROLL_LANE} {note.duration_ticks // per_tick}"


def _until(ticks: Sequence[int], at: int, end: int) -> Iterator[int]:
    """The ticks after the one at index `at` and before `end`."""
    for tick in ticks[at + 1 :]:
        if tick >= end:
            return
        yield tick
