"""Writing DTX charts: a line a bar and channel, each cut as finely as its own strokes need."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import gcd
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.labels import piece_name
from station.core.pieces import HALF_OPEN, Limb, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.dtx.dtx_lanes import (
    BAR_LENGTH,
    CRASH,
    HAT_OPEN,
    LANE_OF,
    LANES,
    LEFT_BASS,
    STAND_INS,
    TEMPO_NAMED,
)
from station.music.formats.dtx.dtx_reader import MOST_BYTES, meter_of, read_dtx
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature, MusicFormat, WrittenFile
from station.music.score import Note, Score
from station.music.tempo import TempoChange

_FINEST = 1920
"""Places a bar at the most: 2, 3 and 5 divide it; what falls between two moves to the nearer one (our choice)."""
_MOST_BARS, _MOST_NAMES = 36 * 100, 36 * 36 - 1
"""What three places number, the first of them in base 36, and two places in base 36, 00 being none."""
_WHOLE = 4 * PPQ
_FULL = 127
_DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"

_KEEPS: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.TIMES: "in up to 1920 places a bar",
        Feature.PIECES: "those that have a lane",
        Feature.TEMPO: "",
        Feature.METERS: "as the length of a bar: 6/8 comes back as 3/4, and is told",
        Feature.FEET: "a kick by the left foot",
        Feature.TITLE: "but for semicolons",
        Feature.AUTHOR: "but for semicolons",
        Feature.ABOUT: "but for semicolons",
    }
)


@dataclass(frozen=True, slots=True, order=True)
class _Chip:
    """One stroke on a lane; `percent` of full volume."""

    bar: int
    lane: int
    tick: int
    percent: int


def write_dtx(part: DrumPart) -> WrittenFile:
    """The part as a DTX chart in UTF-8, its sounds named but not there.

    Raises `BadInput` for more than 3600 bars, 1295 tempos, and where no stroke has a lane.
    """
    score = part.score
    if score.bar_count > _MOST_BARS:
        raise BadInput(score.title or "part", "", f"DTX numbers no more than {_MOST_BARS} bars")
    lost = LostBars()
    chips = sorted(_chips(score, lost))
    if not chips:
        raise BadInput(score.title or "part", "", "DTX has no lane for any of its strokes")
    sounds = {sound: _base_36(i + 1) for i, sound in enumerate(sorted({(c.lane, c.percent) for c in chips}))}
    lines = [*_head(part, lost), *_sounds(sounds), *_lengths(score, lost), *_tempos(score, lost)]
    for (bar, lane), group in groupby(chips, key=lambda c: (c.bar, c.lane)):
        places = [(c.tick, sounds[c.lane, c.percent]) for c in group]
        lines.append(_objects(score, bar, lane, places, lost))
    if score.closing_rest_bars:
        lost.add(Feature.TIMES, "bars of rest at the end: a chart ends with the bar of its last chip")
    return WrittenFile("".join(f"{line}\r\n" for line in lines).encode(), lost.told())


# --- strokes ----------------------------------------------------------------------------------------------------------


def _chips(score: Score, lost: LostBars) -> Iterator[_Chip]:
    pieces, places = set(score.notes["piece"].tolist()), set[tuple[int, int]]()
    second_alone = Piece.CRASH_2 in pieces and Piece.CRASH_1 not in pieces
    for note in score:
        piece = STAND_INS.get(note.piece, note.piece)
        if note.lead_ms:
            lost.add(Feature.FLAMS, "grace strokes are left out")
        elif piece not in LANE_OF:
            for feature in (Feature.PIECES, Feature.TIMES):
                lost.add(feature, f"{piece_name(note.piece)} has no lane and is left out")
        else:
            if piece is not note.piece:
                _tell_of_piece(lost, note.piece, f"is written as {piece_name(piece)}")
            if piece is Piece.CRASH_2 and second_alone:
                _tell_of_piece(lost, piece, "is the only crash, and comes back as the first")
            bar = int(score.tempo_map.bars_at(note.tick))
            lane = _lane(note, piece, has_second=Piece.CRASH_2 in pieces)
            if (lane, note.tick) in places:
                lost.add(Feature.TIMES, "strokes of one lane at once are one", bar)
            places.add((lane, note.tick))
            yield _Chip(bar, lane, note.tick, round(note.velocity * 100 / _FULL))


def _lane(note: Note, piece: Piece, has_second: bool) -> int:
    if piece is Piece.HIHAT and (note.openness or 0.0) >= HALF_OPEN:
        return HAT_OPEN
    if piece is Piece.KICK and note.limb is Limb.LEFT_FOOT:
        return LEFT_BASS
    return CRASH if piece is Piece.CRASH_1 and not has_second else LANE_OF[piece]


def _tell_of_piece(lost: LostBars, piece: Piece, what: str) -> None:
    lost.add(Feature.PIECES, f"{piece_name(piece)} {what}")


# --- lines ------------------------------------------------------------------------------------------------------------


def _head(part: DrumPart, lost: LostBars) -> Iterator[str]:
    said = (
        ("TITLE", Feature.TITLE, part.score.title),
        ("ARTIST", Feature.AUTHOR, part.author),
        ("COMMENT", Feature.ABOUT, part.about),
    )
    for name, feature, text in said:
        if ";" in text:
            lost.add(feature, f"{feature.value}: a comma for each semicolon, which would begin a comment")
        if line := " ".join(text.replace(";", ",").split()):
            yield f"#{name}: {line}"
    yield f"#BPM: {_bpm(part.score.tempo_map.tempos[0])}"


def _sounds(sounds: Mapping[tuple[int, int], str]) -> Iterator[str]:
    for (lane, percent), name in sounds.items():
        yield f"#WAV{name}: {piece_name(LANES[lane].piece).replace(' ', '-')}.ogg"
        yield f"#VOLUME{name}: {percent}"


def _lengths(score: Score, lost: LostBars) -> Iterator[str]:
    before = 1.0
    for bar in range(score.bar_count):
        meter = score.tempo_map.meter_at(score.tempo_map.bar_start(bar))
        length = _bar_ticks(score, bar) / _WHOLE
        read = meter_of(length)
        if (read.beats, read.unit, ()) != (meter.beats, meter.unit, meter.groups):
            lost.add(Feature.METERS, f"{meter} comes back as {read}", bar)
        if length != before:
            yield f"#{_bar_name(bar)}{BAR_LENGTH:02X}: {length:.9g}"
        before = length


def _tempos(score: Score, lost: LostBars) -> Iterator[str]:
    """The changes of tempo, each with a name."""
    changes = score.tempo_map.tempos[1:]
    named = list(dict.fromkeys(t.us_per_quarter for t in changes))
    if len(named) > _MOST_NAMES:
        raise BadInput(score.title or "part", "", f"DTX names no more than {_MOST_NAMES} tempos")
    names = {us: _base_36(i + 1) for i, us in enumerate(named)}
    yield from (f"#BPM{names[us]}: {_bpm(TempoChange(0, us))}" for us in names)
    placed = [(int(score.tempo_map.bars_at(t.tick)), t.tick, names[t.us_per_quarter]) for t in changes]
    for bar, group in groupby(placed, key=lambda row: row[0]):
        yield _objects(score, bar, TEMPO_NAMED, [row[1:] for row in group], lost)


def _bpm(tempo: TempoChange) -> str:
    return f"{tempo.short_bpm():.9f}".rstrip("0").rstrip(".")


def _objects(score: Score, bar: int, lane: int, places: Sequence[tuple[int, str]], lost: LostBars) -> str:
    """One line of a bar, cut into the fewest places that hold `places`, the ticks and names of its chips."""
    start, length = score.tempo_map.bar_start(bar), _bar_ticks(score, bar)
    count = length // gcd(length, *(tick - start for tick, _ in places))
    if count > _FINEST:
        lost.add(Feature.TIMES, f"finer than {_FINEST} places; moved to the nearest", bar)
        count = _FINEST
    cells = ["00"] * count
    for tick, name in places:
        cells[min(round((tick - start) * count / length), count - 1)] = name
    return f"#{_bar_name(bar)}{lane:02X}: {''.join(cells)}"


def _bar_ticks(score: Score, bar: int) -> int:
    return score.tempo_map.bar_start(bar + 1) - score.tempo_map.bar_start(bar)


def _bar_name(bar: int) -> str:
    return f"{_DIGITS[bar // 100]}{bar % 100:02d}"


def _base_36(number: int) -> str:
    return _DIGITS[number // 36] + _DIGITS[number % 36]


DTX = MusicFormat("DTX", (".dtx",), read_dtx, lambda _: True, MOST_BYTES, write_dtx, _KEEPS)
