"""Which voices make room for others, and how: all sounds are constant, so that a sum tells which of them ring."""

import numpy as np
import pytest

from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.sound_names import TIP_TIMBRE, SoundName
from station.sound.buses import Bus, ClickVoice
from station.sound.drum_kit import DrumKit, Frames, Layer, Sound
from station.sound.mixer import (
    CHOKE_S,
    CLOSE_S,
    HALF_OPEN_RING_S,
    MAX_VOICES,
    RETIRE_S,
    SAME_PIECE_VOICES,
    STEAL_S,
    Mixer,
)
from tests.unit.sound.kits import RATE_HZ, constant, mixer_of, sound_of

CRASH = NoteMeaning(Piece.CRASH_1, Zone.EDGE)
LEVEL = 0.01
LONG = 5 * RATE_HZ
PIECES = [piece for piece in Piece if piece not in (Piece.HIHAT, Piece.HIHAT_PEDAL, Piece.COWBELL)]


def frames_in(seconds: float) -> int:
    return round(seconds * RATE_HZ)


def steady(level: float = LEVEL) -> Mixer:
    """Every sound lasts, at `level` for velocity 127."""
    return mixer_of(default=constant(level, LONG))


def heard(mixer: Mixer) -> float:
    return float(mixer.render(1)[0, 0])


def struck(mixer: Mixer, *velocities: int, strike: NoteMeaning = CRASH, apart: int = 100) -> None:
    for velocity in velocities:
        mixer.trigger(Bus.STUDENT, strike, velocity)
        mixer.render(apart)


def level_of(velocity: int) -> float:
    return LEVEL * (velocity / 127) ** 2


# --- of one piece ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("velocities", [(40, *[120] * 4, 20), (120, *[40] * 4, 90), (20, 120, 60, 60, 60, 60)])
def test_the_oldest_of_a_piece_goes_however_loud_it_is(velocities: tuple[int, ...]) -> None:
    assert len(velocities) == SAME_PIECE_VOICES
    mixer = steady()
    struck(mixer, *velocities, 70)
    mixer.render(frames_in(RETIRE_S))
    assert heard(mixer) == pytest.approx(sum(map(level_of, (*velocities[1:], 70))), rel=1e-4)


def test_it_goes_in_a_straight_line() -> None:
    mixer = steady()
    struck(mixer, *[127] * SAME_PIECE_VOICES)
    mixer.trigger(Bus.STUDENT, CRASH, 127)
    falling = mixer.render(frames_in(RETIRE_S))[:, 0] - SAME_PIECE_VOICES * LEVEL
    assert falling == pytest.approx(np.linspace(LEVEL, 0.0, len(falling), endpoint=False), abs=1e-6)


def test_a_quick_roll_keeps_to_its_share_once_the_oldest_have_faded() -> None:
    mixer = steady()
    struck(mixer, *[127] * 3 * SAME_PIECE_VOICES)
    mixer.render(frames_in(RETIRE_S))
    assert heard(mixer) == pytest.approx(SAME_PIECE_VOICES * LEVEL, rel=1e-4)


def test_a_roll_leaves_the_piece_ringing_on_the_other_bus() -> None:
    mixer = steady()
    struck(mixer, *[127] * SAME_PIECE_VOICES)
    mixer.trigger(Bus.DEMONSTRATION, CRASH, 127)
    mixer.render(frames_in(RETIRE_S) + 1)
    assert mixer.ringing == SAME_PIECE_VOICES + 1


def test_clicks_are_of_no_piece() -> None:
    plain = sound_of(constant(0.0, 10))
    sounds = dict.fromkeys((SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED), plain)
    mixer = Mixer(DrumKit("clicks", RATE_HZ, sounds), {voice: constant(LEVEL, LONG) for voice in ClickVoice})
    for _ in range(2 * SAME_PIECE_VOICES):
        mixer.click(ClickVoice.ACCENT)
        mixer.render(100)
    mixer.render(frames_in(RETIRE_S))
    assert mixer.ringing == 2 * SAME_PIECE_VOICES


# --- of all ----------------------------------------------------------------------------------------------------------


def full(soft: int = 20, level: float = LEVEL) -> Mixer:
    """Every voice rings at 127 but for the ride's, which was struck `soft`."""
    mixer = steady(level)
    others = [piece for piece in PIECES if piece is not Piece.RIDE]
    for index in range(MAX_VOICES - 1):
        mixer.trigger(Bus.STUDENT, NoteMeaning(others[index % len(others)]), 127)
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.RIDE), soft)
    mixer.render(300)
    assert mixer.ringing == MAX_VOICES
    return mixer


def test_the_one_that_was_struck_softest_is_the_quietest() -> None:
    mixer = full()
    struck(mixer, 40, strike=NoteMeaning(Piece.COWBELL), apart=frames_in(STEAL_S))
    assert heard(mixer) == pytest.approx((MAX_VOICES - 1) * LEVEL + level_of(40), rel=1e-4)


def test_a_stroke_that_has_yet_to_sound_is_not_taken_for_the_quiet_one_whose_place_it_has() -> None:
    mixer = full()
    for _ in range(2):
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.COWBELL), 127)
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.COWBELL), 100)
    mixer.render(frames_in(STEAL_S))
    assert heard(mixer) == pytest.approx((MAX_VOICES - 1) * LEVEL + level_of(100), rel=1e-4)


def test_two_that_are_stolen_at_once_both_fade() -> None:
    mixer = full(soft=127)
    before = heard(mixer)
    for _ in range(2):
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.COWBELL), 1)
    fading = mixer.render(frames_in(STEAL_S))[:, 0]
    assert np.abs(np.diff(fading, prepend=before)).max() <= 2.1 * LEVEL / frames_in(STEAL_S)
    assert heard(mixer) == pytest.approx(before - 2 * LEVEL, rel=1e-3)


# --- the hi-hat, and the layer that plays ----------------------------------------------------------------------------


def open_hat() -> Mixer:
    mixer = steady()
    struck(mixer, 127, strike=NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=1.0))
    return mixer


def test_a_chick_closes_the_hat_however_open_the_pedal_still_says_it_is() -> None:
    mixer = open_hat()
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.6), 127)
    mixer.render(frames_in(CLOSE_S) + 1)
    assert mixer.ringing == 1


@pytest.mark.parametrize(("openness", "ring_s"), [(0.0, 0.04), (0.25, 0.255), (0.5, 0.9), (0.75, 0.9)])
def test_how_long_a_closing_hat_rings(openness: float, ring_s: float) -> None:
    """0.04 s closed, 0.9 s half open; between with the square: 0.04 + 0.86·0.5² = 0.255 at a quarter."""
    assert (CLOSE_S, HALF_OPEN_RING_S) == (0.04, 0.9)
    mixer = open_hat()
    mixer.pedal(Bus.STUDENT, openness)
    falling = mixer.render(frames_in(ring_s))[:, 0]
    assert falling[-1] == pytest.approx(LEVEL / frames_in(ring_s), rel=0.01)
    assert heard(mixer) == 0.0


def test_a_soft_stroke_takes_as_long_to_choke_as_a_hard_one() -> None:
    mixer = steady()
    struck(mixer, 90)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1)
    count = frames_in(CHOKE_S)
    assert mixer.render(count)[:, 0] == pytest.approx(level_of(90) * (1 - np.arange(count) / count), abs=1e-7)
    assert mixer.ringing == 0


def test_a_choke_cuts_short_what_fades_slowly() -> None:
    mixer = open_hat()
    mixer.pedal(Bus.STUDENT, 0.5)
    mixer.render(100)
    mixer.choke(Bus.STUDENT, Piece.HIHAT)
    mixer.render(frames_in(CHOKE_S))
    assert mixer.ringing == 0


def test_what_would_end_before_its_fade_fades_until_then() -> None:
    """A quarter of the fade's length is left: it ends at three quarters of its level."""
    count = frames_in(CHOKE_S)
    mixer = mixer_of({SoundName.CRASH_1: constant(LEVEL, 100 + count // 4)})
    struck(mixer, 127)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1)
    falling = mixer.render(count)[:, 0]
    assert falling[: count // 4] == pytest.approx(LEVEL * (1 - np.arange(count // 4) / count), abs=1e-7)
    assert not falling[count // 4 :].any()


def layered() -> Mixer:
    def layer(to_velocity: int, level: float) -> Layer:
        frames: Frames = constant(level, 100)
        return Layer(to_velocity, (frames,))

    snare = Sound((layer(60, 0.1), layer(127, 0.2)), tuple([1.0] * 128))
    return Mixer(DrumKit("layers", RATE_HZ, dict.fromkeys(SoundName, snare)), {})


@pytest.mark.parametrize(("velocity", "level"), [(60, 0.1), (60.9, 0.1), (61, 0.2)])
def test_the_whole_velocity_chooses_the_layer(velocity: float, level: float) -> None:
    mixer = layered()
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.SNARE), velocity)
    assert heard(mixer) == pytest.approx(level)


def test_the_stick_s_tip_on_a_cymbal_sounds_as_a_softer_stroke_does() -> None:
    mixer = layered()
    hardest_soft = int(60 / TIP_TIMBRE)
    for velocity, level in ((hardest_soft, 0.1), (hardest_soft + 1, 0.2), (1, 0.1)):
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.CRASH_1, Zone.BOW), velocity)
        assert heard(mixer) == pytest.approx(level)
        mixer.render(200)
