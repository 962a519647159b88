"""Links of GrooveScribe beside the MIDI that GrooveScribe makes of them.

Compared are time and drum of every note: the ticks that GrooveScribe's arithmetic gives for where our part has the
strokes (16 ticks a 32nd, 10.666 a 48th, the time since the last event cut to whole ticks, a tick before the first bar)
with the ticks in its file, to the tick, and the numbers in its file with the numbers of its own table for our strokes.
Left out of its file are the notes of its metronome (76 and 77 at velocity 120 or 25), out of our part the grace strokes
of flams and drags, which are one note there. Beside this, its files read as the same part as the links, stroke for
stroke.
"""

import csv
from collections import defaultdict
from fractions import Fraction
from math import floor

import mido
import numpy as np
import pytest

from station.core.pieces import Articulation, Dynamic, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.format_table import read_part
from station.music.formats.groovescribe.groove_formats import read_url
from station.music.score import Note
from tests.oracles.folder import ORACLES

pytestmark = pytest.mark.oracle

FOLDER = ORACLES / "charts" / "groovescribe"
MISNAMED = {"Samba": "builtin-Foot-Ostinatos-Samba.mid"}
"""The list gives this groove the file of another one, the jazz samba; its own is there too."""


def rows() -> list[object]:
    path = FOLDER / "grooves.tsv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file, delimiter="\t"))
    return [
        pytest.param(row["url_query"], MISNAMED.get(row["name"], row["golden_midi"]), id=row["name"]) for row in found
    ]


NUMBERS = {
    Piece.KICK: 35,
    Piece.HIHAT_PEDAL: 44,
    Piece.TOM_1: 48,
    Piece.FLOOR_TOM_1: 43,
    Piece.CRASH_1: 49,
    Piece.CHINA: 52,
    Piece.COWBELL: 105,
}


STRUCK = {Articulation.CROSS_STICK: 37, Articulation.BUZZ: 104}
GRACED = {Ornament.FLAM: 107, Ornament.DRAG: 103}
LOUDNESS = {Dynamic.NORMAL: 38, Dynamic.ACCENT: 22, Dynamic.GHOST: 21}


def number(note: Note) -> set[int]:
    """What GrooveScribe plays for a stroke (constants.js)."""
    if note.piece is Piece.SNARE:
        return {STRUCK.get(note.articulation) or GRACED.get(note.ornament) or LOUDNESS[note.dynamic]}
    if note.piece is Piece.HIHAT:
        return {46 if note.openness else 108 if note.dynamic is Dynamic.ACCENT else 42}
    if note.piece is Piece.RIDE:
        return {53 if note.zone is Zone.BELL else 51}
    return {76, 77} if note.piece is Piece.PERCUSSION else {NUMBERS[note.piece]}


def file_ticks(part: DrumPart, is_triplet: bool, clicks: set[int]) -> dict[int, int]:
    """GrooveScribe's tick for each tick of `part` where a note sounds or its metronome clicks."""
    per_quarter = Fraction(10_666, 1000) * 12 if is_triplet else Fraction(128)
    bar_ticks = part.score.tempo_map.meters[0].bar_ticks
    found, at = {}, 1
    for bar in range(part.score.bar_count):
        last = bar * bar_ticks
        events = clicks | {note.tick for note in part.score}
        for tick in sorted(t for t in events if bar * bar_ticks <= t < (bar + 1) * bar_ticks):
            at += floor(Fraction(tick - last, PPQ) * per_quarter)
            found[tick] = at
            last = tick
        at += floor(Fraction((bar + 1) * bar_ticks - last, PPQ) * per_quarter - 1)
    return found


@pytest.mark.parametrize(("query", "golden"), rows())
def test_a_link_plays_what_groovescribe_plays(query: str, golden: str) -> None:
    part = read_url(query)
    theirs: dict[int, list[int]] = defaultdict(list)
    clicks, at = set(), 0
    for message in mido.MidiFile(FOLDER / "golden" / golden).tracks[0]:
        at += message.time
        if message.type != "note_on" or not message.velocity:
            continue
        if message.note in (76, 77) and message.velocity != 85:
            clicks.add(round(Fraction(at - 1, 128) * PPQ))
        else:
            theirs[at].append(message.note)
    ticks = file_ticks(part, any(f"Div={d}" in query for d in (12, 24, 48)), clicks)
    ours: dict[int, list[set[int]]] = defaultdict(list)
    for note in part.score:
        if not note.lead_ms:
            ours[ticks[note.tick]].append(number(note))
    assert sorted(ours) == sorted(theirs)
    for tick, numbers in theirs.items():
        left = list(numbers)
        for meant in ours[tick]:
            left.remove(next(n for n in left if n in meant))
        assert left == []


@pytest.mark.parametrize(("query", "golden"), rows())
def test_groovescribes_own_midi_reads_as_its_link_does(query: str, golden: str) -> None:
    link, midi = read_url(query).score, read_part(FOLDER / "golden" / golden).score
    told_by_the_link_alone = {"limb", "swing_ticks"}
    for name in set(link.notes.dtype.names or ()) - told_by_the_link_alone:
        np.testing.assert_array_equal(link.notes[name], midi.notes[name], name)
    assert link.end_tick == midi.end_tick
    assert link.tempo_map == midi.tempo_map


def test_the_list_of_grooves_is_there() -> None:
    if not FOLDER.exists():
        pytest.skip(f"no {FOLDER}")
    assert len(rows()) == 24
