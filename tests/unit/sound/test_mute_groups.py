import numpy as np

from station.core.note_map import NoteMeaning
from station.core.pieces import Piece, Zone
from station.core.sound_names import SoundName
from station.sound.buses import Bus, ClickVoice
from station.sound.drum_kit import DrumKit, Layer, Sound
from station.sound.mixer import MUTE_S, Mixer
from tests.unit.sound.kits import RATE_HZ, constant, impulse

CRASH = NoteMeaning(Piece.CRASH_1, Zone.EDGE)
SPLASH = NoteMeaning(Piece.SPLASH, Zone.EDGE)
SNARE = NoteMeaning(Piece.SNARE)
MUTED = round(MUTE_S * RATE_HZ)


def mixer() -> Mixer:
    """Crash and splash share a group; the crash is constant, so that what stops it shows."""
    plain = Sound((Layer(127, (impulse(0.0),)),))
    sounds = dict.fromkeys((SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED), plain)
    sounds[SoundName.CRASH_1] = Sound((Layer(127, (constant(0.25),)),), mute_group=4)
    sounds[SoundName.SPLASH] = Sound((Layer(127, (impulse(0.0),)),), mute_group=4)
    return Mixer(DrumKit("groups", RATE_HZ, sounds), {voice: impulse(0.0) for voice in ClickVoice})


def test_a_stroke_stops_its_group_in_a_straight_line() -> None:
    playing = mixer()
    playing.trigger(Bus.STUDENT, CRASH, 127)
    playing.trigger(Bus.STUDENT, SPLASH, 127, 1000)
    heard = playing.render(4000)[:, 0]
    assert np.all(heard[:1000] == 0.25)
    assert np.abs(np.diff(heard)).max() <= 0.25 / MUTED * 1.01
    assert np.all(heard[1000 + MUTED :] == 0.0)


def test_a_stroke_leaves_its_own_sound_and_other_groups_ringing() -> None:
    playing = mixer()
    playing.trigger(Bus.STUDENT, CRASH, 127)
    playing.trigger(Bus.STUDENT, SNARE, 127, 500)
    playing.trigger(Bus.STUDENT, CRASH, 127, 1000)
    assert np.all(playing.render(4000)[1000:, 0] == 0.5)


def test_a_stroke_leaves_the_other_bus_ringing() -> None:
    playing = mixer()
    playing.trigger(Bus.DEMONSTRATION, CRASH, 127)
    playing.trigger(Bus.STUDENT, SPLASH, 127, 1000)
    assert np.all(playing.render(4000)[:, 0] == 0.25)
