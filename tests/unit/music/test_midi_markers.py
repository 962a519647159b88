"""Sections of MIDI files: markers as bytes by RP-001 (meta event 06), and back from our own files."""

import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.music_format import Feature
from station.music.formats.smf.midi_part import MIDI, read_midi_part
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.fakes.smf_bytes import event, header, meta, track

BAR = 4 * 96
MARKER = 0x06


def song(*marks: tuple[int, str], bars: int = 8) -> bytes:
    """A snare on 1 of each bar of 4/4, 96 ticks a quarter; `marks` (tick, text) in a track of their own."""
    snares = b"".join(event(BAR if bar else 0, 0x99, 38, 100) for bar in range(bars))
    now, texts = 0, b""
    for tick, text in marks:
        texts += meta(tick - now, MARKER, text.encode())
        now = tick
    return header(form=1, tracks=2) + track(texts) + track(snares)


def test_a_marker_begins_a_section_that_lasts_to_the_next() -> None:
    part = read_midi_part(song((0, "Verse"), (4 * BAR, "Chorus")), "song.mid")
    assert part.sections == (PartSection("Verse", 0, 3), PartSection("Chorus", 4, 7))


def test_a_marker_beside_a_bar_line_means_that_bar() -> None:
    """A performer drops a marker a little early or late."""
    part = read_midi_part(song((2 * BAR - 20, "Verse"), (6 * BAR + 30, "Chorus")), "song.mid")
    assert part.sections == (PartSection("Verse", 2, 5), PartSection("Chorus", 6, 7))


def test_a_marker_after_the_last_stroke_is_no_section() -> None:
    assert read_midi_part(song((0, "Verse"), (20 * BAR, "End")), "song.mid").sections == (PartSection("Verse", 0, 7),)


@pytest.mark.parametrize(
    "sections",
    [(("Verse", 0, 3), ("Chorus", 4, 7)), (("Verse", 1, 2), ("Refrain – étude", 5, 5)), (("A", 0, 1), ("A", 2, 7))],
)
def test_sections_come_back_from_our_own_file(sections: tuple[tuple[str, int, int], ...]) -> None:
    notes = [Note(4 * bar * PPQ, Piece.SNARE) for bar in range(8)]
    part = DrumPart(
        Score.from_notes(notes, TempoMap.constant(120), 32 * PPQ), sections=tuple(PartSection(*s) for s in sections)
    )
    assert MIDI.write
    written = MIDI.write(part)
    assert written.lost == ()
    assert read_midi_part(written.data, "song.mid").sections == part.sections


def test_a_part_that_is_moved_tells_that_of_its_sections() -> None:
    flam = [Note(0, Piece.SNARE, lead_ms=30.0), Note(0, Piece.SNARE)]
    part = DrumPart(Score.from_notes(flam, TempoMap.constant(120), 4 * PPQ), sections=(PartSection("A", 0, 0),))
    assert MIDI.write
    assert Feature.SECTIONS in {loss.feature for loss in MIDI.write(part).lost}
