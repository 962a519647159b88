"""What a part has that a format has no word for; expected features are those that the part below is made with."""

from station.core.pieces import Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.music_format import Feature, Loss, MusicFormat, WrittenFile
from station.music.formats.part_features import features_of, without_a_word
from station.music.formats.smf.midi_part import MIDI
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.tempo import TempoMap

TEMPO = TempoMap.constant(120)


def part_of(*notes: Note, author: str = "") -> DrumPart:
    return DrumPart(Score.from_notes(notes, TEMPO), author)


def test_plain_strokes_have_nothing_to_lose() -> None:
    assert features_of(part_of(Note(0, Piece.SNARE), Note(PPQ, Piece.HIHAT, Zone.BOW))) == ()


def test_what_a_part_has_is_named_in_the_order_of_the_tables() -> None:
    bell = Note(PPQ, Piece.RIDE, Zone.BELL, velocity=100, limb=Limb.RIGHT_HAND)
    flam = with_graces(Note(0, Piece.SNARE, ornament=Ornament.FLAM, limb=Limb.RIGHT_HAND))
    ghost = Note(2 * PPQ, Piece.SNARE, velocity=32, dynamic=Dynamic.GHOST)
    kick = Note(2 * PPQ, Piece.KICK, limb=Limb.LEFT_FOOT)
    part = DrumPart(Score.from_notes([*flam, bell, ghost, kick], TEMPO), "A", sections=(PartSection("Intro", 0, 0),))
    assert features_of(part) == (
        Feature.VELOCITIES,
        Feature.DYNAMICS,
        Feature.ZONES,
        Feature.FLAMS,
        Feature.STICKING,
        Feature.FEET,
        Feature.AUTHOR,
        Feature.SECTIONS,
    )


def test_midi_has_no_word_for_hands_and_what_is_told_already_is_not_told_twice() -> None:
    part = part_of(Note(0, Piece.SNARE, limb=Limb.LEFT_HAND), author="A")
    assert isinstance(MIDI, MusicFormat)
    assert without_a_word(MIDI, part, WrittenFile(b"")) == (Feature.STICKING, Feature.AUTHOR)
    assert without_a_word(MIDI, part, WrittenFile(b"", (Loss(Feature.STICKING, "no hands"),))) == (Feature.AUTHOR,)
