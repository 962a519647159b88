"""Songs on disk, made by hand: a part of quarter notes in four as a MIDI file, a file that stands for its sound."""

from pathlib import Path

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.smf.midi_part import MIDI
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.fakes.sound_files import stroke

BARS = 8


def write_part(folder: Path, bars: int = BARS, tempo_bpm: float = 120.0) -> Path:
    """A MIDI file: the kick on each beat, at the written tempo."""
    notes = [Note(beat * PPQ, Piece.KICK, velocity=100) for beat in range(4 * bars)]
    score = Score.from_notes(notes, TempoMap.constant(tempo_bpm), 4 * bars * PPQ)
    assert MIDI.write is not None
    path = folder / "part.mid"
    path.write_bytes(MIDI.write(DrumPart(score)).data)
    return path


def write_song(folder: Path, more: str = "", top: str = "") -> Path:
    """A song file with its part and its sound; `top` are further keys, `more` further tables."""
    write_part(folder)
    (folder / "band.wav").write_bytes(stroke())
    path = folder / "our-song.song"
    path.write_text(f'title = "Our song"\npart = "part.mid"\nsound = "band.wav"\n{top}\n{more}')
    return path
