"""`notes.mid` of Rock Band, Clone Hero and YARG to a `DrumChart`.

The track `PART DRUMS` has a chart of four difficulties in its note numbers, markers over all of them, and the motions
of the game's drummer. Yellow, blue and green are cymbals unless a tom marker spans them. Tempo and meter are the
file's, sections stand in the track `EVENTS`.
"""

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.pieces import Dynamic, Limb, Piece
from station.music.formats.clone_hero.drum_chart import (
    ChartNote,
    Difficulty,
    DrumChart,
    Grab,
    Lane,
    Motion,
    Span,
    held_by,
    merged,
)
from station.music.formats.clone_hero.mix_events import flips_of
from station.music.formats.smf.chunk_reader import parse_midi
from station.music.formats.smf.contents import MidiFile, MidiTrack

_TRACKS = ("PART DRUMS", "PART DRUM", "PART DRUMS_2X", "PART REAL_DRUMS_PS")
"""The first of these that has notes is read."""
_EVENTS = "EVENTS"
_DYNAMICS = "ENABLE_CHART_DYNAMICS"
_FULL_VELOCITY, _GHOST_VELOCITY = 127, 1
_MOST_METER_BEATS, _SHORTEST_UNIT = 64, 128

_LOWEST = MappingProxyType({Difficulty.EXPERT: 96, Difficulty.HARD: 84, Difficulty.MEDIUM: 72, Difficulty.EASY: 60})
"""The kick of each difficulty; the lanes follow."""
_SECOND_KICK, _FLAM = 95, 109
_TOMS = MappingProxyType({Lane.YELLOW: 110, Lane.BLUE: 111, Lane.ORANGE_GREEN: 112})
_ROLL, _DOUBLE_ROLL = 126, 127
_HARD_ROLL_VELOCITIES = range(41, 51)
"""A roll lane that is not for Expert alone."""

_OPEN_HAT = 25
_GRABS = MappingProxyType({40: Piece.CRASH_1, 41: Piece.CRASH_2})
_LEFT, _RIGHT = Limb.LEFT_HAND, Limb.RIGHT_HAND
MOTIONS: Mapping[int, tuple[Piece, Limb]] = MappingProxyType(
    {
        26: (Piece.SNARE, _LEFT),
        27: (Piece.SNARE, _RIGHT),
        28: (Piece.SNARE, _LEFT),
        29: (Piece.SNARE, _RIGHT),
        30: (Piece.HIHAT, _LEFT),
        31: (Piece.HIHAT, _RIGHT),
        34: (Piece.CRASH_1, _LEFT),
        35: (Piece.CRASH_1, _LEFT),
        36: (Piece.CRASH_1, _RIGHT),
        37: (Piece.CRASH_1, _RIGHT),
        38: (Piece.CRASH_2, _RIGHT),
        39: (Piece.CRASH_2, _RIGHT),
        42: (Piece.RIDE, _RIGHT),
        43: (Piece.RIDE, _LEFT),
        44: (Piece.CRASH_2, _LEFT),
        45: (Piece.CRASH_2, _LEFT),
        46: (Piece.TOM_1, _LEFT),
        47: (Piece.TOM_1, _RIGHT),
        48: (Piece.TOM_2, _LEFT),
        49: (Piece.TOM_2, _RIGHT),
        50: (Piece.FLOOR_TOM_1, _LEFT),
        51: (Piece.FLOOR_TOM_1, _RIGHT),
    }
)
"""Animation notes: which piece and which hand. 26, 27, 34, 36, 38 and 44 are hard strokes, the one after each (28, 29
for the snare) soft ones; how hard the game's drummer swings is not how loud the note is, and is left aside."""


def is_notes_midi(data: bytes) -> bool:
    """Whether a MIDI file has a track for the games' drums."""
    return data[:4] == b"MThd" and any(name.encode() in data for name in _TRACKS)


def read_notes_midi(data: bytes, source: str) -> DrumChart:
    """The drums of a `notes.mid`; raises `BadInput`."""
    midi = parse_midi(data, source)
    track = _drum_track(midi, source)
    difficulty = _fullest(track, source)
    notes = tuple(_notes(track, difficulty))
    sequence = midi.sequences[0]
    for meter in sequence.meters:
        if meter.beats > _MOST_METER_BEATS or meter.unit > _SHORTEST_UNIT:
            raise BadInput(source, f"tick {meter.tick}", f"a meter of {meter.beats}/{meter.unit}")
    texts = [(text.tick, text.text) for text in track.texts]
    has_five_lanes = any(n.lane is Lane.FIFTH for n in notes) and not _spans(track, tuple(_TOMS.values()))
    return DrumChart(
        midi.division.ticks,
        notes,
        tuple((t.tick, t.us_per_quarter) for t in sequence.tempos),
        tuple((m.tick, m.beats, m.unit) for m in sequence.meters),
        tuple(_sections(midi)),
        has_five_lanes,
        () if has_five_lanes else flips_of(texts, difficulty, track.end_tick),
        _rolls(track, difficulty, _ROLL),
        tuple(_motions(track)),
        _spans(track, (_OPEN_HAT,)),
        tuple(_grabs(track)),
        midi.title,
        end=_end(midi),
        lost=tuple(_lost(track, difficulty, notes)),
        double_rolls=_rolls(track, difficulty, _DOUBLE_ROLL),
    )


def _drum_track(midi: MidiFile, source: str) -> MidiTrack:
    if midi.division.us is not None:
        raise BadInput(source, "", "time in frames, where a game's chart has quarter notes")
    named = [track for name in _TRACKS for track in midi.tracks if track.name == name and len(track.notes)]
    if not named:
        raise BadInput(source, "", f"no notes in a track named {_TRACKS[0]}")
    return named[0]


def _fullest(track: MidiTrack, source: str) -> Difficulty:
    numbers = set(track.notes["number"].tolist())
    for difficulty in reversed(Difficulty):
        lowest = _LOWEST[difficulty]
        if numbers & set(range(lowest, lowest + len(Lane))):
            return difficulty
    raise BadInput(source, "", "its drum track has no notes of any difficulty")


def _notes(track: MidiTrack, difficulty: Difficulty) -> Iterator[ChartNote]:
    has_dynamics = any(text.text.strip("[] ").upper() == _DYNAMICS for text in track.texts)
    toms = {lane: _spans(track, (number,)) for lane, number in _TOMS.items()}
    flams = _spans(track, (_FLAM,))
    lowest = _LOWEST[difficulty]
    columns = (track.notes[name].tolist() for name in ("tick", "number", "velocity"))
    for tick, number, velocity in zip(*columns, strict=True):
        if number == _SECOND_KICK and difficulty is Difficulty.EXPERT:
            yield ChartNote(tick, Lane.KICK, is_second_kick=True)
        elif lowest <= number < lowest + len(Lane):
            lane = Lane(number - lowest)
            dynamic = _dynamic(velocity) if has_dynamics else Dynamic.NORMAL
            is_cymbal = lane in toms and not held_by(tick, toms[lane])
            yield ChartNote(tick, lane, is_cymbal, dynamic, lane is not Lane.KICK and held_by(tick, flams))


def _dynamic(velocity: int) -> Dynamic:
    return {_FULL_VELOCITY: Dynamic.ACCENT, _GHOST_VELOCITY: Dynamic.GHOST}.get(velocity, Dynamic.NORMAL)


def _rows(track: MidiTrack, numbers: Sequence[int]) -> Iterator[tuple[int, int, int, int]]:
    """Tick, number, velocity and length of the notes of `numbers`."""
    columns = (track.notes[name].tolist() for name in ("tick", "number", "velocity", "duration_ticks"))
    return (row for row in zip(*columns, strict=True) if row[1] in numbers)


def _spans(track: MidiTrack, numbers: Sequence[int]) -> tuple[Span, ...]:
    return merged(Span(tick, tick + max(length, 0)) for tick, _, _, length in _rows(track, tuple(numbers)))


def _rolls(track: MidiTrack, difficulty: Difficulty, marker: int) -> tuple[Span, ...]:
    """The roll lanes of a difficulty: Expert has all, Hard those whose velocity says so."""
    return tuple(
        Span(tick, tick + length)
        for tick, _, velocity, length in _rows(track, (marker,))
        if length > 0
        and (difficulty is Difficulty.EXPERT or (difficulty is Difficulty.HARD and velocity in _HARD_ROLL_VELOCITIES))
    )


def _motions(track: MidiTrack) -> Iterator[Motion]:
    return (Motion(tick, *MOTIONS[number]) for tick, number, _, _ in _rows(track, tuple(MOTIONS)))


def _grabs(track: MidiTrack) -> Iterator[Grab]:
    return (Grab(tick, _GRABS[number], max(length, 0)) for tick, number, _, length in _rows(track, tuple(_GRABS)))


def _global_texts(midi: MidiFile) -> Iterator[tuple[int, str]]:
    for track in midi.tracks:
        if track.name == _EVENTS:
            yield from ((text.tick, text.text.strip().removeprefix("[").removesuffix("]")) for text in track.texts)


def _sections(midi: MidiFile) -> Iterator[tuple[int, str]]:
    for tick, text in _global_texts(midi):
        for begin in ("section", "prc"):
            if text.startswith((f"{begin}_", f"{begin} ")):
                yield tick, text[len(begin) + 1 :].replace("_", " ").strip()


def _end(midi: MidiFile) -> int:
    return max((tick for tick, text in _global_texts(midi) if text == "end"), default=0)


def _lost(track: MidiTrack, difficulty: Difficulty, notes: tuple[ChartNote, ...]) -> Iterator[str]:
    if difficulty is not Difficulty.EXPERT:
        yield f"no notes for Expert: this is {difficulty.name.title()}"
    has_fifth = any(n.lane is Lane.FIFTH for n in notes)
    if not has_fifth and any(n.is_cymbal for n in notes) and not _spans(track, tuple(_TOMS.values())):
        yield "no tom is marked: yellow, blue and green are all cymbals, as such charts have them"
