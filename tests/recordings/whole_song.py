"""A song of our own, written by mido: sections in other metres and tempi, a track for each drum, a bass besides."""

import itertools

import mido

DIVISION = 192
SECTIONS = ((8, 4, 4, 500_000), (4, 3, 4, 431_655), (4, 7, 8, 375_000), (8, 4, 4, 612_244))
"""Bars, beats, unit of a beat, microseconds a quarter."""
DRUMS = {36: (0, 5), 38: (2, 6), 42: (0, 1, 2, 3, 4, 5, 6, 7), 49: (0,)}
"""The eighths of a bar on which a number of General MIDI is struck."""
EIGHTH = DIVISION // 2

Timed = list[tuple[int, mido.Message | mido.MetaMessage]]


def whole_song(form: int) -> mido.MidiFile:
    """The song as a file of format 0 or 1."""
    parts = [_conductor(), *(_drum(number) for number in DRUMS), _bass()]
    tracks = parts if form == 1 else [list(itertools.chain(*parts))]
    return mido.MidiFile(type=form, ticks_per_beat=DIVISION, tracks=[_track(part) for part in tracks])


def _track(part: Timed) -> mido.MidiTrack:
    track, now = mido.MidiTrack(), 0
    for tick, message in sorted(part, key=lambda timed: timed[0]):
        track.append(message.copy(time=tick - now))
        now = tick
    return track


def _bars() -> list[tuple[int, int]]:
    """(tick, eighths) of every bar."""
    eighths = [beats * 8 // unit for count, beats, unit, _ in SECTIONS for _ in range(count)]
    return list(zip(itertools.accumulate((EIGHTH * n for n in eighths), initial=0), eighths, strict=False))


def _conductor() -> Timed:
    """Name, metres and tempi."""
    first_bars = itertools.accumulate((section[0] for section in SECTIONS[:-1]), initial=0)
    found: Timed = [(0, mido.MetaMessage("track_name", name="A whole song"))]
    for bar, (_, beats, unit, us_per_quarter) in zip(first_bars, SECTIONS, strict=True):
        tick = _bars()[bar][0]
        found.append((tick, mido.MetaMessage("time_signature", numerator=beats, denominator=unit)))
        found.append((tick, mido.MetaMessage("set_tempo", tempo=us_per_quarter)))
    return found


def _struck(tick: int, channel: int, number: int, velocity: int) -> Timed:
    on = mido.Message("note_on", channel=channel, note=number, velocity=velocity)
    return [(tick, on), (tick + EIGHTH - 1, mido.Message("note_off", channel=channel, note=number))]


def _drum(number: int) -> Timed:
    """Strokes that grow louder over the song, some a tick or two late."""
    ticks = [tick + EIGHTH * at + at % 3 for tick, eighths in _bars() for at in DRUMS[number] if at < eighths]
    strokes = (_struck(tick, 9, number, 40 + i * 80 // len(ticks)) for i, tick in enumerate(ticks))
    return list(itertools.chain(*strokes))


def _bass() -> Timed:
    """A note a bar on another channel, in whose numbers some drums have theirs."""
    notes: Timed = [(0, mido.Message("program_change", channel=1, program=33))]
    for i, (tick, _) in enumerate(_bars()):
        notes += [*_struck(tick, 1, 28 + i % 12, 90), (tick, mido.Message("pitchwheel", channel=1, pitch=100 * i))]
    return notes
