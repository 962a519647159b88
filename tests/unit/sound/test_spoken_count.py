"""Words measured as a phonetician would: where voicing begins, where the formants lie, where hiss is."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.sound.buses import PART_LABELS, SPOKEN_LEAD_S, ClickVoice, word_of_beat
from station.sound.spoken_count import word_sounds

RATE_HZ = 48_000
SOUNDS = word_sounds(RATE_HZ)
WORDS = list(SOUNDS)
Series = NDArray[np.floating]


def part(voice: ClickVoice, from_s: float, to_s: float) -> Series:
    return SOUNDS[voice][round(from_s * RATE_HZ) : round(to_s * RATE_HZ), 0].astype(np.float64)


def share(sound: Series, low_hz: float, high_hz: float) -> float:
    """Of the energy, how much lies between two frequencies."""
    power = np.abs(np.fft.rfft(sound * np.hanning(len(sound)))) ** 2
    freq_hz = np.fft.rfftfreq(len(sound), 1 / RATE_HZ)
    return float(power[(freq_hz >= low_hz) & (freq_hz < high_hz)].sum() / power.sum())


def peak_hz(sound: Series, low_hz: float, high_hz: float) -> float:
    """Where the spectrum, smoothed over the voice's harmonics, is highest between two frequencies."""
    power = np.abs(np.fft.rfft(sound * np.hanning(len(sound)), 1 << 15)) ** 2
    freq_hz = np.fft.rfftfreq(1 << 15, 1 / RATE_HZ)
    width = round(150 / freq_hz[1])
    smooth = np.convolve(power, np.ones(width), "same")
    inside = (freq_hz >= low_hz) & (freq_hz < high_hz)
    return float(freq_hz[inside][smooth[inside].argmax()])


def test_there_are_twelve_numbers_and_what_is_between() -> None:
    assert {ClickVoice.ONE, ClickVoice.TWELVE, ClickVoice.E, ClickVoice.AND, ClickVoice.A} <= set(WORDS)
    assert [word_of_beat(index, ClickVoice.BEAT).name for index in (0, 3, 11, 12)] == ["ONE", "FOUR", "TWELVE", "BEAT"]
    assert all(len(words) == parts - 1 for parts, words in PART_LABELS.items())


@pytest.mark.parametrize("voice", WORDS)
def test_a_word_is_short_in_range_and_ends_in_silence(voice: ClickVoice) -> None:
    sound = SOUNDS[voice]
    assert 0.15 < len(sound) / RATE_HZ < 0.36
    assert 0.5 < np.abs(sound).max() < 0.75
    assert np.abs(sound[-48:]).max() < 2e-3
    assert abs(float(sound.mean())) < 2e-3


@pytest.mark.parametrize("voice", WORDS)
def test_the_vowel_begins_on_the_beat(voice: ClickVoice) -> None:
    """Voicing (below 1 kHz) is at half its strength or more within 25 ms of the lead's end, at a tenth 45 ms before."""
    low = part(voice, 0.0, 0.2)
    spectrum = np.fft.rfft(low)
    spectrum[np.fft.rfftfreq(len(low), 1 / RATE_HZ) > 1000.0] = 0.0
    envelope = np.sqrt(np.convolve(np.fft.irfft(spectrum, len(low)) ** 2, np.ones(480) / 480, "same"))
    vowel = envelope[round((SPOKEN_LEAD_S + 0.02) * RATE_HZ) : round((SPOKEN_LEAD_S + 0.08) * RATE_HZ)].max()
    assert envelope[round((SPOKEN_LEAD_S + 0.025) * RATE_HZ)] > 0.5 * vowel
    assert envelope[round((SPOKEN_LEAD_S - 0.055) * RATE_HZ)] < 0.35 * vowel


# First and second formants of American vowels, men's means in Hz (Peterson & Barney 1952, table II).
@pytest.mark.parametrize(
    ("voice", "from_s", "first_hz", "second_hz"),
    [
        (ClickVoice.THREE, 0.12, 270, 2290),  # i
        (ClickVoice.SIX, 0.09, 390, 1990),  # ɪ
        (ClickVoice.TEN, 0.10, 530, 1840),  # ɛ
        (ClickVoice.AND, 0.08, 660, 1720),  # æ
        (ClickVoice.A, 0.10, 640, 1190),  # ʌ
        (ClickVoice.TWO, 0.12, 300, 870),  # u
    ],
)
def test_vowels_lie_where_a_phonetician_finds_them(
    voice: ClickVoice, from_s: float, first_hz: float, second_hz: float
) -> None:
    vowel = part(voice, from_s, from_s + 0.06)
    assert peak_hz(vowel, 150.0, (first_hz + second_hz) / 2) == pytest.approx(first_hz, abs=130)
    assert peak_hz(vowel, (first_hz + second_hz) / 2, second_hz + 500) == pytest.approx(second_hz, rel=0.15)


@pytest.mark.parametrize("voice", [ClickVoice.SIX, ClickVoice.SEVEN])
def test_an_s_hisses_before_the_vowel(voice: ClickVoice) -> None:
    assert share(part(voice, 0.01, 0.05), 4000.0, 8000.0) > 0.9
    assert share(part(voice, 0.09, 0.13), 4000.0, 8000.0) < 0.1


def picture(voice: ClickVoice) -> Series:
    """Levels in dB, no lower than −50, of 15 bands of 500 Hz in 15 stretches of 20 ms."""
    sound = np.zeros(round(0.3 * RATE_HZ))
    heard = part(voice, 0.0, 0.3)
    sound[: len(heard)] = heard
    power = np.abs(np.fft.rfft(sound.reshape(15, -1), axis=1)) ** 2
    bands = power[:, 1:151].reshape(15, 15, 10).sum(axis=2)
    return np.asarray(np.maximum(-50.0, 10.0 * np.log10(bands / bands.max() + 1e-12)))


def test_words_differ() -> None:
    pictures = [picture(voice) for voice in WORDS]
    for index, one in enumerate(pictures):
        for other in pictures[:index]:
            assert np.abs(one - other).mean() > 1.5  # dB, over the whole picture


@pytest.mark.parametrize("rate_hz", [44_100, 96_000])
def test_a_word_lasts_as_long_at_any_rate(rate_hz: int) -> None:
    for voice, sound in word_sounds(rate_hz).items():
        assert len(sound) / rate_hz == pytest.approx(len(SOUNDS[voice]) / RATE_HZ, abs=1e-3)
