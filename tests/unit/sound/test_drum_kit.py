import pytest

from station.core.note_map import NoteMeaning
from station.core.pieces import Piece, Zone
from station.core.sound_names import SoundName
from station.sound.drum_kit import DrumKit, Layer, Sound, level_of
from tests.unit.sound.kits import RATE_HZ, constant, impulse, kit_of, sound_of

# MIDI velocity to level after Dannenberg's square law, in dB, worked out by hand: 40·log10(v/127).
LAW_DB = [(127, 0.0), (112, -2.18), (96, -4.86), (80, -8.03), (64, -11.90), (48, -16.90), (32, -23.94), (1, -84.15)]


@pytest.mark.parametrize(("velocity", "level_db"), LAW_DB)
def test_the_level_follows_the_square_law(velocity: int, level_db: float) -> None:
    assert level_of(velocity) == pytest.approx(10 ** (level_db / 20), rel=2e-3)


def test_a_velocity_plays_the_layer_that_reaches_it() -> None:
    soft, middle, hard = impulse(0.1), impulse(0.2), impulse(0.3)
    sound = Sound((Layer(40, (soft,)), Layer(90, (middle,)), Layer(127, (hard,))))
    assert sound.frames_for(1, 0) is soft
    assert sound.frames_for(40, 0) is soft
    assert sound.frames_for(40.5, 0) is middle
    assert sound.frames_for(90, 0) is middle
    assert sound.frames_for(91, 0) is hard
    assert sound.frames_for(127, 0) is hard


def test_between_two_velocities_of_a_layer_the_level_is_between_theirs() -> None:
    sound = Sound((Layer(90, (impulse(),)), Layer(127, (impulse(),))), tuple(v % 91 / 100 for v in range(128)))
    assert sound.level(80.25) == pytest.approx(0.8025)
    assert sound.level(90.5) == pytest.approx(0.9)  # the next layer is louder by itself
    assert sound.level(127.5) == sound.level(127)


def test_takes_are_played_in_turn() -> None:
    first, second, third = impulse(), impulse(), impulse()
    sound = sound_of(first, second, third)
    assert [sound.frames_for(100, count) for count in range(5)] == [first, second, third, first, second]


def test_layers_must_rise_and_reach_the_top() -> None:
    with pytest.raises(AssertionError):
        Sound((Layer(90, (impulse(),)), Layer(40, (impulse(),))))
    with pytest.raises(AssertionError):
        Sound((Layer(90, (impulse(),)),))


def test_what_a_kit_has_plays_itself() -> None:
    kit = kit_of(default=impulse())
    assert all(kit.playing(name) is name for name in SoundName)


@pytest.mark.parametrize(
    ("has", "asked", "heard"),
    [
        (SoundName.CRASH_1, NoteMeaning(Piece.CRASH_2, Zone.EDGE), SoundName.CRASH_1),
        (SoundName.CRASH_2, NoteMeaning(Piece.CRASH_1, Zone.EDGE), SoundName.CRASH_2),
        (SoundName.CRASH_1, NoteMeaning(Piece.SPLASH, Zone.EDGE), SoundName.CRASH_1),
        (SoundName.RIDE_BOW, NoteMeaning(Piece.RIDE, Zone.BELL), SoundName.RIDE_BOW),
        (SoundName.FLOOR_TOM_1, NoteMeaning(Piece.TOM_1), SoundName.FLOOR_TOM_1),
        (SoundName.HIHAT_OPEN, NoteMeaning(Piece.HIHAT, openness=0.5), SoundName.HIHAT_OPEN),
        (SoundName.CRASH_1, NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL), SoundName.HIHAT_CLOSED),
        (SoundName.CRASH_1, NoteMeaning(Piece.SNARE, Zone.RIM), SoundName.SNARE),
    ],
)
def test_a_missing_piece_is_played_by_its_substitute(has: SoundName, asked: NoteMeaning, heard: SoundName) -> None:
    kit = kit_of({has: impulse()})
    name, sound, _ = kit.choose(asked)
    assert name is heard
    assert sound is kit.sounds[heard]


def test_the_barest_kit_answers_every_stroke() -> None:
    kit = kit_of()
    for piece in Piece:
        for zone in Zone:
            assert kit.choose(NoteMeaning(piece, zone))[0] in kit.sounds


def test_a_kit_without_a_kick_is_no_kit() -> None:
    with pytest.raises(AssertionError, match="kick"):
        DrumKit("bare", RATE_HZ, {SoundName.SNARE: sound_of(impulse()), SoundName.HIHAT_CLOSED: sound_of(impulse())})


def test_memory_counts_shared_frames_once() -> None:
    shared = constant(0.1, 1000)
    kit = DrumKit(
        "shared",
        RATE_HZ,
        {
            SoundName.KICK: Sound((Layer(64, (shared,)), Layer(127, (shared, constant(0.2, 500))))),
            SoundName.SNARE: sound_of(shared),
            SoundName.HIHAT_CLOSED: sound_of(shared),
        },
    )
    assert kit.bytes_held == (1000 + 500) * 2 * 4
