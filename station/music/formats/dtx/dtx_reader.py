"""Reading DTX charts.

Texts are UTF-8 or, mostly, Shift-JIS. Whatever is no command is a comment. Of `#RANDOM` the first way is taken.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import accumulate, islice

from station.core.errors import BadInput
from station.core.pieces import Limb
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.dtx.dtx_lanes import BAR_LENGTH, CRASH, LANES, LEFT_CRASH, LIMBS, TEMPO_HEX, TEMPO_NAMED
from station.music.score import Note, Score
from station.music.tempo import MAX_BPM, MeterChange, TempoChange, TempoMap

MOST_BYTES = 4 << 20
"""Our choice: the longest charts have some hundred kilobytes."""
_MOST_CHIPS = 40_000
"""Our choice, of strokes and of tempo changes: the longest charts have some ten thousand."""
_LONGEST_BAR = 32.0
"""In whole notes: a lesson's longest bar, 32/1, and more than any chart uses."""
_LEAST_BPM = 0.1
_WHOLE = 4 * PPQ
_UNITS = (4, 8, 16, 32, 64)
_FULL = 127
_USUAL = 80
"""The velocity of a chart that says no volumes: a normal stroke."""

_OBJECT = re.compile(r"#([0-9A-Z][0-9]{2})([0-9A-F]{2})[:\s]\s*([0-9A-Z_.\s]+)$", re.IGNORECASE)
_HEADER = re.compile(r"#(?:(BPM|VOLUME)([0-9A-Z]{2})|([A-Z]+))(?:[:\s]\s*(.*))?$", re.IGNORECASE)
_NUMBER = re.compile(r"[+-]?[0-9]{1,9}(?:\.[0-9]{0,9})?")
_BRANCHES = {"RANDOM", "SETRANDOM", "IF", "ENDIF", "ENDRANDOM"}


@dataclass(frozen=True, slots=True)
class _Chips:
    """One line of objects: `data` of `channel` in `bar`, from `line` of the file."""

    bar: int
    channel: int
    data: str
    line: int

    def places(self) -> Iterator[tuple[int, int, str]]:
        """Index, count and the two characters of every place that is no rest."""
        text = "".join(self.data.split()).replace("_", "")
        count = len(text) // 2
        for i in range(count):
            if (pair := text[2 * i : 2 * i + 2].upper()) != "00":
                yield i, count, pair


@dataclass(slots=True)
class _Chart:
    """The commands of a file."""

    source: str
    heads: dict[str, str] = field(default_factory=dict)
    volumes: dict[str, float] = field(default_factory=dict)
    tempos: dict[str, float] = field(default_factory=dict)
    chips: list[_Chips] = field(default_factory=list)
    lost: dict[str, None] = field(default_factory=dict)

    def fault(self, line: int, text: str) -> BadInput:
        return BadInput(self.source, f"line {line}", text)


def read_dtx(data: bytes, source: str) -> DrumPart:
    """The drums of a DTX chart; raises `BadInput` with the line."""
    chart = _commands(_text(data), source)
    starts = _bar_starts(chart)
    notes = list(islice(_notes(chart, starts), _MOST_CHIPS + 1))
    if len(notes) > _MOST_CHIPS:
        raise BadInput(source, "", f"more than {_MOST_CHIPS} drum chips, which no chart has")
    if not notes:
        raise BadInput(source, "", "no drum chip in it: channels 11 to 1C are empty")
    last = max(chips.bar for chips in chart.chips)
    score = Score.from_notes(_once(notes), _tempo_map(chart, starts), starts[last + 1], chart.heads.get("TITLE", ""))
    about = " ".join(chart.heads.get("COMMENT", "").split())
    return DrumPart(score, chart.heads.get("ARTIST", ""), about, lost=tuple(chart.lost))


def _text(data: bytes) -> str:
    for encoding in ("utf-16", "utf-8-sig") if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ("utf-8-sig",):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    return data.decode("cp932", "replace")


# --- lines ------------------------------------------------------------------------------------------------------------


def _commands(text: str, source: str) -> _Chart:
    chart, skipped = _Chart(source), 0
    for number, row in enumerate(text.splitlines(), 1):
        line = row.partition(";")[0].strip()
        if not line.startswith("#"):
            continue
        if found := _OBJECT.match(line):
            if not skipped:
                bar = int(found[1][0], 36) * 100 + int(found[1][1:])
                chart.chips.append(_Chips(bar, int(found[2], 16), found[3], number))
            continue
        if found := _HEADER.match(line):
            name, key, value = (found[1] or found[3]).upper(), (found[2] or "").upper(), (found[4] or "").strip()
            if name in _BRANCHES:
                skipped = _branch(name, value, skipped, chart)
            elif not skipped:
                _header(chart, (name, key), value, number)
    chart.chips = [c for c in chart.chips if c.channel in LANES or c.channel in (BAR_LENGTH, TEMPO_HEX, TEMPO_NAMED)]
    return chart


def _branch(name: str, value: str, skipped: int, chart: _Chart) -> int:
    """How many branches deep the lines that follow are skipped."""
    if name == "IF":
        chart.lost["what #RANDOM chooses by chance: the first way was taken"] = None
        return skipped + 1 if skipped or value.strip() != "1" else 0
    return max(skipped - 1, 0) if name == "ENDIF" else skipped


def _header(chart: _Chart, command: tuple[str, str], value: str, line: int) -> None:
    match command:
        case "BPM", "":
            chart.heads["BPM"] = str(_checked_bpm(chart, _number(chart, value, line), line))
        case "BASEBPM", _:
            chart.heads["BASEBPM"] = str(_number(chart, value, line))
        case "BPM", key:
            chart.tempos[key] = _number(chart, value, line)
        case "VOLUME", key:
            chart.volumes[key] = min(max(_number(chart, value, line), 0.0), 100.0)
        case ("TITLE" | "ARTIST" | "COMMENT") as name, _:
            chart.heads[name] = "".join(c if c.isprintable() else " " for c in value)


def _number(chart: _Chart, text: str, line: int) -> float:
    if not (found := _NUMBER.match(text)):
        raise chart.fault(line, f"expected a number, found {text[:20]!r}")
    return float(found[0])


def _checked_bpm(chart: _Chart, bpm: float, line: int) -> float:
    if not _LEAST_BPM <= bpm <= MAX_BPM:
        raise chart.fault(line, f"{bpm:g} beats a minute is no tempo")
    return bpm


# --- time -------------------------------------------------------------------------------------------------------------


def _bar_lengths(chart: _Chart) -> list[float]:
    """Length of each bar in whole notes, and of one bar more; a length holds until the next one."""
    said: dict[int, float] = {}
    for chips in chart.chips:
        if chips.channel == BAR_LENGTH:
            said[chips.bar] = _number(chart, chips.data.strip(), chips.line)
            if not 0 < said[chips.bar] <= _LONGEST_BAR:
                raise chart.fault(chips.line, f"a bar of {said[chips.bar]:g} whole notes")
    lengths, length = [], 1.0
    for bar in range(max((c.bar for c in chart.chips), default=0) + 1):
        length = said.get(bar, length)
        lengths.append(length)
    return lengths


def _bar_starts(chart: _Chart) -> list[int]:
    """The tick at which each bar begins, and that at which the last one ends."""
    return list(accumulate((_bar_ticks(length) for length in _bar_lengths(chart)), initial=0))


def _bar_ticks(length: float) -> int:
    meter = meter_of(length)
    return meter.bar_ticks


def meter_of(length: float) -> MeterChange:
    """The meter of a bar of `length` whole notes, in the largest unit that says it; to the nearest 64th."""
    for unit in _UNITS:
        beats = round(length * unit)
        if beats and abs(beats - length * unit) < 1e-4 * unit:
            return MeterChange(0, beats, unit)
    return MeterChange(0, max(round(length * _UNITS[-1]), 1), _UNITS[-1])


def _tempo_map(chart: _Chart, starts: list[int]) -> TempoMap:
    base = float(chart.heads.get("BASEBPM", "0"))
    first = _checked_bpm(chart, base + float(chart.heads.get("BPM", "120")), 1)
    tempos = [TempoChange.from_bpm(0, first)]
    for chips in chart.chips:
        for tick, pair in _ticked(chips, starts):
            if chips.channel == TEMPO_HEX:
                found = float(_hex(chart, pair, chips.line))
            elif chips.channel == TEMPO_NAMED and pair in chart.tempos:
                found = chart.tempos[pair]
            else:
                continue
            tempos.append(TempoChange.from_bpm(tick, _checked_bpm(chart, base + found, chips.line)))
        if len(tempos) > _MOST_CHIPS:
            raise chart.fault(chips.line, f"more than {_MOST_CHIPS} changes of tempo up to here")
    meters = [_at(start, length) for start, length in zip(starts, _bar_lengths(chart), strict=False)]
    return TempoMap.build(tempos, meters)


def _at(start: int, length: float) -> MeterChange:
    meter = meter_of(length)
    return MeterChange(start, meter.beats, meter.unit)


def _hex(chart: _Chart, pair: str, line: int) -> int:
    try:
        return int(pair, 16)
    except ValueError:
        raise chart.fault(line, f"expected a tempo of two hexadecimal digits, found {pair!r}") from None


def _ticked(chips: _Chips, starts: list[int]) -> Iterator[tuple[int, str]]:
    if chips.channel == BAR_LENGTH:
        return
    start, length = starts[chips.bar], starts[chips.bar + 1] - starts[chips.bar]
    for i, count, pair in chips.places():
        yield start + round(i * length / count), pair


# --- chips ------------------------------------------------------------------------------------------------------------


def _notes(chart: _Chart, starts: list[int]) -> Iterator[Note]:
    has_left_crash = any(c.channel == LEFT_CRASH for c in chart.chips)
    for chips in chart.chips:
        if chips.channel in LANES:
            lone_crash = chips.channel == CRASH and not has_left_crash
            strike = LANES[LEFT_CRASH if lone_crash else chips.channel]
            limb = LIMBS.get(chips.channel, Limb.UNKNOWN)
            for tick, pair in _ticked(chips, starts):
                yield Note(
                    tick,
                    strike.piece,
                    strike.zone,
                    _velocity(chart, pair),
                    strike.articulation,
                    limb=limb,
                    openness=strike.openness,
                )


def _velocity(chart: _Chart, pair: str) -> int:
    if not chart.volumes:
        return _USUAL
    return max(1, round(chart.volumes.get(pair, 100.0) * _FULL / 100))


def _once(notes: list[Note]) -> list[Note]:
    """Of chips that strike the same piece at one moment, the loudest."""
    loudest: dict[tuple[int, int, int], Note] = {}
    for note in sorted(notes, key=lambda n: n.velocity):
        loudest[note.tick, note.piece, note.limb] = note
    return list(loudest.values())
