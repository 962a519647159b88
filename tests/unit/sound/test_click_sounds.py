import numpy as np
import pytest

from station.core.errors import BadInput
from station.sound.buses import ClickVoice
from station.sound.click_sounds import ATTACK_S, TIMBRES, click_sounds
from station.sound.drum_kit import Frames

RATES_HZ = (44_100, 48_000, 96_000)
# Equal temperament at a' = 440 Hz: D7, G6, C6 (published tables).
PITCH_HZ = {ClickVoice.ACCENT: 2349.3, ClickVoice.BEAT: 1568.0, ClickVoice.SUBDIVISION: 1046.5}


def blips(rate_hz: int, timbre: str = "bar") -> list[Frames]:
    sounds = click_sounds(rate_hz, timbre)
    return [sounds[voice] for voice in PITCH_HZ]


@pytest.mark.parametrize("rate_hz", RATES_HZ)
@pytest.mark.parametrize("voice", list(PITCH_HZ))
def test_each_click_has_its_pitch(voice: ClickVoice, rate_hz: int) -> None:
    mono = click_sounds(rate_hz)[voice][:, 0]
    spectrum = np.abs(np.fft.rfft(mono, 1 << 17))
    peak_hz = float(spectrum.argmax()) * rate_hz / (1 << 17)
    assert peak_hz == pytest.approx(PITCH_HZ[voice], rel=0.01)
    assert peak_hz >= 1000.0


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_a_click_begins_at_once_and_is_short(rate_hz: int) -> None:
    for sound in blips(rate_hz):
        size = np.abs(sound[:, 0])
        assert size[: round(2 * ATTACK_S * rate_hz)].max() > 0.7 * size.max()
        assert size[round(0.06 * rate_hz) :].max() < 0.03 * size.max()
        assert size[0] == 0.0
        assert size[-1] == 0.0
        assert sound[:, 0].tolist() == sound[:, 1].tolist()


def test_the_accent_is_the_loudest_and_the_subdivision_the_softest() -> None:
    clicks = click_sounds(48_000)
    energy = {voice: float(np.sum(np.square(clicks[voice]))) for voice in PITCH_HZ}
    assert energy[ClickVoice.ACCENT] > energy[ClickVoice.BEAT] > 2.0 * energy[ClickVoice.SUBDIVISION]
    assert max(float(np.abs(sound).max()) for sound in clicks.values()) <= 0.7
    assert abs(float(np.mean(clicks[ClickVoice.BEAT]))) < 1e-3


@pytest.mark.parametrize("timbre", list(TIMBRES))
def test_every_timbre_has_three_weights_that_are_heard_apart(timbre: str) -> None:
    accent, beat, subdivision = (float(np.sum(np.square(sound))) for sound in blips(48_000, timbre))
    assert accent > 0.9 * beat > 1.5 * subdivision
    pitches = [float(np.abs(np.fft.rfft(sound[:, 0], 1 << 16)).argmax()) for sound in blips(48_000, timbre)[:2]]
    assert pitches[0] > 1.2 * pitches[1]  # a third at least
    assert all(np.abs(sound).max() <= 0.7 and sound[-1, 0] == 0.0 for sound in blips(48_000, timbre))


def test_an_unknown_timbre_is_refused_by_name() -> None:
    with pytest.raises(BadInput, match="honk: no such click; there are bar"):
        click_sounds(48_000, "honk")
