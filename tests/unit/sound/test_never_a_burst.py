"""Whatever is played at whatever rate, the sound stays finite, within full scale, and free of steps nobody struck."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.sound_names import SoundName
from station.sound.bus_levels import LEVEL_SLEW_S
from station.sound.buses import Bus, ClickVoice
from station.sound.click_sounds import click_sounds
from station.sound.drum_kit import DrumKit, Layer, Sound
from station.sound.mixer import CHOKE_S, STEAL_S, Mixer
from station.sound.synth.synth_kits import synth_kit
from station.sound.track import EDGE_S, Track

RATES_HZ = [44_100, 48_000, 88_200, 96_000]
Act = Callable[[Mixer], None]


def mixer_of(rate_hz: int, level: float, seconds: float = 1.0) -> Mixer:
    """Every sound is constant, so that a step in what is heard is a step of the mixer's own."""
    frames = np.full((round(seconds * rate_hz), 2), level, np.float32)
    sounds = {
        name: Sound((Layer(127, (frames,)),), mute_group=1 if "CRASH" in name.name else None) for name in SoundName
    }
    return Mixer(DrumKit("constant", rate_hz, sounds), click_sounds(rate_hz), 8)


strikes = st.builds(
    NoteMeaning,
    st.sampled_from(Piece),
    st.sampled_from(Zone),
    st.sampled_from(Articulation),
    st.none() | st.floats(0.0, 1.0),
)
buses = st.sampled_from([Bus.DEMONSTRATION, Bus.STUDENT])
acts: st.SearchStrategy[Act] = st.one_of(
    st.builds(
        lambda b, s, v, f: lambda m: m.trigger(b, s, v, f), buses, strikes, st.integers(1, 127), st.integers(0, 300)
    ),
    st.builds(lambda b, p, f: lambda m: m.choke(b, p, f), buses, st.sampled_from(Piece), st.integers(0, 300)),
    st.builds(lambda b, o: lambda m: m.pedal(b, o), buses, st.floats(0.0, 1.0)),
    st.builds(lambda v: lambda m: m.click(v), st.sampled_from(ClickVoice)),
    st.builds(lambda b, g, p: lambda m: m.set_level(b, g, p), st.sampled_from(Bus), st.floats(0, 1), st.floats(-1, 1)),
    st.builds(lambda p: lambda m: m.keep_track_at(p), st.integers(-10_000, 100_000)),
    st.builds(lambda: lambda m: m.stop_track()),
    st.builds(
        lambda start: (
            lambda m: m.play_track(Track(np.full((5000, 2), 32_767, np.int16), m.kit.rate_hz, start, (0, 5000)), 17)
        ),
        st.integers(0, 4999),
    ),
)


@settings(max_examples=60, deadline=None)
@given(
    rate_hz=st.sampled_from(RATES_HZ),
    level=st.sampled_from([0.3, 1.0, 40.0]),
    plan=st.lists(st.tuples(acts, st.integers(1, 700)), max_size=40),
)
def test_nothing_exceeds_full_scale(rate_hz: int, level: float, plan: list[tuple[Act, int]]) -> None:
    mixer = mixer_of(rate_hz, level)
    for act, frames in plan:
        act(mixer)
        block = mixer.render(frames)
        assert block.shape == (frames, 2)
        assert np.isfinite(block).all()
        assert np.abs(block).max() <= 1.0


def steps(mixer: Mixer, frames: int) -> float:
    """The largest difference between neighbours in what is heard next."""
    return float(np.abs(np.diff(mixer.render(frames), axis=0)).max())


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_what_ends_ends_without_a_click_in_the_same_time_at_any_rate(rate_hz: int) -> None:
    level = 0.2
    crash, splash = NoteMeaning(Piece.CRASH_1, Zone.EDGE), NoteMeaning(Piece.CRASH_2, Zone.EDGE)
    mixer = mixer_of(rate_hz, level, 5.0)
    mixer.trigger(Bus.STUDENT, crash, 127)
    mixer.render(rate_hz // 10)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1)
    assert steps(mixer, round(CHOKE_S * rate_hz)) <= 1.05 * level / (CHOKE_S * rate_hz)
    assert np.abs(mixer.render(10)).max() == pytest.approx(0.0, abs=1e-6)

    mixer.trigger(Bus.STUDENT, splash, 127)
    mixer.render(rate_hz // 10)
    mixer.set_level(Bus.STUDENT, 0.1)
    assert steps(mixer, rate_hz // 10) <= 1.05 * level / (LEVEL_SLEW_S * rate_hz)


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_a_stolen_voice_leaves_without_a_click(rate_hz: int) -> None:
    level = 0.02
    mixer = mixer_of(rate_hz, level, 5.0)
    for piece in (
        Piece.CRASH_1,
        Piece.RIDE,
        Piece.CHINA,
        Piece.SPLASH,
        Piece.TOM_1,
        Piece.TOM_2,
        Piece.TOM_3,
        Piece.KICK,
    ):
        mixer.trigger(Bus.STUDENT, NoteMeaning(piece, Zone.EDGE), 127)
        mixer.render(100)
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.SNARE), 1)
    assert steps(mixer, 4000) <= 1.05 * level / (STEAL_S * rate_hz) + level / 127**2


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_a_track_comes_and_goes_without_a_click(rate_hz: int) -> None:
    mixer = mixer_of(rate_hz, 0.1)
    full = Track(np.full((20_000, 2), 16_384, np.int16), rate_hz, start=100, loop=(0, 20_000))
    mixer.play_track(full)
    assert steps(mixer, 3000) <= 1.05 * 0.5 / (EDGE_S * rate_hz)
    mixer.stop_track()
    assert steps(mixer, 3000) <= 1.05 * 0.5 / (EDGE_S * rate_hz)


def test_a_mixer_that_is_listened_to_again_goes_on_with_nothing_old() -> None:
    """A card that is lost while a crash rings comes back into silence, not into the middle of the crash."""
    mixer = Mixer(synth_kit(48_000), click_sounds(48_000))
    for _ in range(40):  # some voices are stolen, some wait
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.CRASH_1), 127)
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.RIDE), 127)
    mixer.click(ClickVoice.ACCENT, at_frame=100)
    assert mixer.render(64).any()
    mixer.silence()
    assert not mixer.render(4800).any()
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.SNARE), 127)
    assert mixer.render(480).any()
