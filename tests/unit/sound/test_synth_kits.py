"""The default kit, measured as a recording would be: by spectra, envelopes and levels, never by its own recipes."""

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.sound_names import HIHAT_STEPS, SoundName
from station.sound.buses import Bus
from station.sound.drum_kit import DrumKit, Frames
from station.sound.mixer import Mixer
from station.sound.synth.layers import make_sound
from station.sound.synth.synth_kits import RECIPES, synth_kit
from tests.unit.sound.kits import RATE_HZ

MADE = list(RECIPES)
TOMS = [n for n in SoundName if "TOM" in n.name and not n.name.endswith("RIM")]
CYMBALS = [n for n in MADE if n.name.startswith(("CRASH", "RIDE", "SPLASH", "CHINA", "HIHAT"))]
DRUMS = [SoundName.KICK, SoundName.SNARE, SoundName.SNARE_RIM_SHOT, *TOMS]


def takes(kit: DrumKit, name: SoundName) -> list[Frames]:
    return [take for layer in kit.sounds[name].layers for take in layer.takes]


def hardest(kit: DrumKit, name: SoundName) -> Frames:
    return kit.sounds[name].layers[-1].takes[0]


def softest(kit: DrumKit, name: SoundName) -> Frames:
    return kit.sounds[name].layers[0].takes[0]


Series = NDArray[np.floating]


def mono(sound: Frames) -> Series:
    return 0.5 * (sound[:, 0].astype(np.float64) + sound[:, 1])


def spectrum(sound: Frames, rate_hz: int = RATE_HZ) -> tuple[Series, Series]:
    """Frequencies in Hz and power."""
    size = 1 << 18
    return np.fft.rfftfreq(size, 1 / rate_hz), np.abs(np.fft.rfft(mono(sound), size)) ** 2


def centroid_hz(sound: Frames, rate_hz: int = RATE_HZ) -> float:
    freq_hz, power = spectrum(sound, rate_hz)
    return float(np.sum(freq_hz * power) / np.sum(power))


def share(sound: Frames, low_hz: float, high_hz: float) -> float:
    freq_hz, power = spectrum(sound)
    return float(power[(freq_hz >= low_hz) & (freq_hz < high_hz)].sum() / power.sum())


def decay_s(sound: Frames, by_db: float, rate_hz: int = RATE_HZ) -> float:
    """When the energy still to come has fallen by `by_db` (Schroeder's backward integration)."""
    energy = np.cumsum(np.square(mono(sound))[::-1])[::-1]
    return float(np.argmax(energy < energy[0] * 10 ** (-by_db / 10))) / rate_hz


def rms_db(sound: Frames) -> float:
    """The greatest RMS of any 50 ms, in dB."""
    size = RATE_HZ // 20
    power = np.cumsum(np.concatenate([[0.0], np.square(np.asarray(sound, np.float64)).mean(axis=1)]))
    windows = power[size:] - power[:-size] if len(power) > size else power[-1:]
    return float(10 * np.log10(windows.max() / size))


def test_it_has_every_sound_but_the_second_ride(kit: DrumKit) -> None:
    assert set(SoundName) - set(kit.sounds) == {SoundName.RIDE_2}
    assert kit.playing(SoundName.RIDE_2) is SoundName.RIDE_BOW


@pytest.mark.parametrize("name", MADE)
def test_layers_and_takes(kit: DrumKit, name: SoundName) -> None:
    layers = kit.sounds[name].layers
    assert len(layers) >= (6 if name in DRUMS else 3)
    assert all(len(layer.takes) >= 2 for layer in layers)


@pytest.mark.parametrize("name", MADE)
def test_a_stroke_sounds_at_once_and_never_too_loud(kit: DrumKit, name: SoundName) -> None:
    for sound in takes(kit, name):
        size = np.abs(sound).max(axis=1)
        begin = size[: RATE_HZ // 20].max()
        assert size[: RATE_HZ * 3 // 1000].max() >= 0.5 * begin  # half of its peak within 3 ms
        assert size[: RATE_HZ // 2000].max() >= 0.02 * begin  # heard within half a millisecond
        assert size.max() < 1.0


@pytest.mark.parametrize("name", MADE)
def test_a_sound_ends_in_silence_without_a_click_and_has_no_dc(kit: DrumKit, name: SoundName) -> None:
    for sound in takes(kit, name):
        peak = float(np.abs(sound).max())
        assert np.abs(sound[-1]).max() == pytest.approx(0.0, abs=1e-6)
        assert np.abs(sound[-RATE_HZ // 200 :]).max() < 1e-3 * peak  # the last 5 ms lie 60 dB down
        assert np.abs(sound.astype(np.float64).mean(axis=0)).max() < 1e-3 * peak
        assert np.isfinite(sound).all()


# The table of the project's research notes: level of a MIDI velocity in dB.
@pytest.mark.parametrize(
    ("velocity", "level_db"), [(112, -2.2), (96, -4.9), (80, -8.0), (64, -11.9), (48, -16.9), (32, -23.9)]
)
@pytest.mark.parametrize("piece", [Piece.KICK, Piece.SNARE, Piece.TOM_1, Piece.RIDE, Piece.CRASH_1])
def test_the_level_follows_the_velocity(kit: DrumKit, piece: Piece, velocity: int, level_db: float) -> None:
    levels = []
    for struck in (127, velocity):
        mixer = Mixer(kit, {})
        mixer.trigger(Bus.STUDENT, NoteMeaning(piece), struck)
        levels.append(rms_db(mixer.render(RATE_HZ // 2)))
    assert levels[1] - levels[0] == pytest.approx(level_db, abs=1.0)


@pytest.mark.parametrize("name", MADE)
def test_takes_are_alike_in_level_and_differ_in_sound(kit: DrumKit, name: SoundName) -> None:
    for layer in kit.sounds[name].layers:
        first, second = layer.takes[:2]
        assert rms_db(first) == pytest.approx(rms_db(second), abs=1.5)
        length = min(len(first), len(second), RATE_HZ // 10)
        difference = np.sum(np.square(first[:length] - second[:length])) / np.sum(np.square(first[:length]))
        assert difference > 0.003  # −25 dB: not the same recording twice


@pytest.mark.parametrize("name", [*DRUMS, *CYMBALS])
def test_harder_is_brighter(kit: DrumKit, name: SoundName) -> None:
    for take in range(2):
        bright_hz = [centroid_hz(layer.takes[take]) for layer in kit.sounds[name].layers]
        assert bright_hz == sorted(bright_hz)
        assert bright_hz[-1] > 1.05 * bright_hz[0]


def test_the_kit_stands_in_order_of_brightness(kit: DrumKit) -> None:
    order = [SoundName.KICK, SoundName.TOM_1, SoundName.SNARE, SoundName.RIDE_BOW, SoundName.HIHAT_CLOSED]
    bright_hz = [centroid_hz(hardest(kit, name)) for name in order]
    assert all(lower * 1.2 < higher for lower, higher in itertools.pairwise(bright_hz))


def test_the_toms_are_tuned_downwards(kit: DrumKit) -> None:
    pitches_hz = []
    for name in TOMS:
        freq_hz, power = spectrum(hardest(kit, name)[RATE_HZ // 10 :])
        pitches_hz.append(float(freq_hz[power.argmax()]))
    steps = [12 * np.log2(high / low) for high, low in itertools.pairwise(pitches_hz)]
    assert all(2.5 < step < 4.0 for step in steps)  # about a minor third each
    assert 150 < pitches_hz[0] < 220
    assert 60 < pitches_hz[-1] < 80


def test_lower_toms_ring_longer(kit: DrumKit) -> None:
    rings_s = [decay_s(hardest(kit, name), 40) for name in TOMS]
    assert rings_s == sorted(rings_s)
    assert 0.4 < rings_s[0] < rings_s[-1] < 1.6


def test_the_kick_is_low_and_has_a_beater(kit: DrumKit) -> None:
    kick = hardest(kit, SoundName.KICK)
    assert share(kick, 35, 130) > 0.8
    assert decay_s(kick, 40) < 0.5
    begin = kick[: RATE_HZ // 100]
    assert share(begin, 1500, 9000) > 5 * share(kick[RATE_HZ // 20 :], 1500, 9000)


def test_the_kicks_pitch_falls(kit: DrumKit) -> None:
    kick = mono(hardest(kit, SoundName.KICK))
    crossings = np.flatnonzero(np.diff(np.signbit(np.convolve(kick, np.ones(96) / 96, "same")))) / RATE_HZ
    halves_s = np.diff(crossings)
    assert np.median(halves_s[:3]) < 0.8 * np.median(halves_s[5:15])


def test_the_snare_has_head_and_wires(kit: DrumKit) -> None:
    snare = hardest(kit, SoundName.SNARE)
    assert share(snare, 150, 250) > 0.25
    assert share(snare, 1000, 12000) > 0.15
    late = snare[RATE_HZ // 10 :]
    assert share(late, 1000, 12000) > 0.1  # the wires ring on
    assert 0.1 < decay_s(snare, 30) < 0.4


def test_the_snares_ways_of_being_struck_differ(kit: DrumKit) -> None:
    snare, rim_shot = hardest(kit, SoundName.SNARE), hardest(kit, SoundName.SNARE_RIM_SHOT)
    cross_stick, buzz = hardest(kit, SoundName.SNARE_CROSS_STICK), hardest(kit, SoundName.SNARE_BUZZ)
    assert share(rim_shot, 400, 2500) > 1.5 * share(snare, 400, 2500)  # hoop and shell ring
    assert decay_s(cross_stick, 30) < 0.7 * decay_s(snare, 30)
    assert share(cross_stick, 350, 5000) > 0.75  # wood
    assert decay_s(buzz, 10) > 2.0 * decay_s(snare, 10)


def test_the_hihat_rings_the_longer_the_further_it_is_open(kit: DrumKit) -> None:
    rings_s = [decay_s(hardest(kit, name), 30) for name in HIHAT_STEPS]
    assert all(1.3 * tighter < wider for tighter, wider in itertools.pairwise(rings_s))
    assert rings_s[0] < 0.15
    assert rings_s[-1] > 0.7
    assert decay_s(hardest(kit, SoundName.HIHAT_CHICK), 30) < 0.15
    assert decay_s(hardest(kit, SoundName.HIHAT_FOOT_SPLASH), 30) > 0.4


# Orders of magnitude of acoustic cymbals: time for the energy to come to fall by 30 dB.
@pytest.mark.parametrize(
    ("name", "low_s", "high_s"),
    [
        (SoundName.CRASH_1, 0.8, 2.5),
        (SoundName.CRASH_2, 0.9, 2.8),
        (SoundName.SPLASH, 0.2, 0.8),
        (SoundName.CHINA, 0.4, 1.2),
        (SoundName.RIDE_BOW, 0.8, 2.2),
        (SoundName.RIDE_BELL, 0.7, 2.0),
        (SoundName.RIDE_EDGE, 1.0, 3.0),
    ],
)
def test_cymbals_ring_as_long_as_cymbals_do(kit: DrumKit, name: SoundName, low_s: float, high_s: float) -> None:
    assert low_s < decay_s(hardest(kit, name), 30) < high_s


def test_the_bell_is_a_tone_and_the_bow_is_not(kit: DrumKit) -> None:
    def tonality_db(sound: Frames) -> float:
        """The strongest sixth of an octave between 500 Hz and 9 kHz against the mean of all."""
        freq_hz, power = spectrum(sound)
        edges_hz = 500 * 2 ** (np.arange(26) / 6)
        bands = [power[(freq_hz >= a) & (freq_hz < b)].sum() for a, b in itertools.pairwise(edges_hz)]
        return float(10 * np.log10(max(bands) / np.mean(bands)))

    bow, bell = hardest(kit, SoundName.RIDE_BOW), hardest(kit, SoundName.RIDE_BELL)
    assert tonality_db(bell) > tonality_db(bow) + 3.0
    assert share(bell, 2000, 5000) > 2.0 * share(bow, 2000, 5000)  # where it cuts through
    assert rms_db(bell) > rms_db(bow) + 2.0


def test_no_cymbal_repeats_itself_as_a_harmonic_tone_does(kit: DrumKit) -> None:
    for name in (SoundName.CRASH_1, SoundName.RIDE_BOW, SoundName.HIHAT_OPEN, SoundName.CHINA):
        sound = mono(hardest(kit, name))[RATE_HZ // 20 : RATE_HZ // 20 + 8192]
        power = np.abs(np.fft.rfft(sound, 16384)) ** 2
        correlation = np.fft.irfft(power)[:4096]
        assert correlation[48:].max() < 0.5 * correlation[0]  # no period between 1 ms and 85 ms


def balance_db(sound: Frames) -> float:
    energy = np.sum(np.square(sound.astype(np.float64)), axis=0)
    return float(10 * np.log10(energy[1] / energy[0]))


def test_the_kit_stands_as_the_drummer_sits(kit: DrumKit) -> None:
    for left in (SoundName.HIHAT_CLOSED, SoundName.HIHAT_OPEN, SoundName.CRASH_1, SoundName.TOM_1):
        assert balance_db(hardest(kit, left)) < -2.0
    for right in (SoundName.RIDE_BOW, SoundName.CRASH_2, SoundName.FLOOR_TOM_1, SoundName.CHINA):
        assert balance_db(hardest(kit, right)) > 2.0
    for middle in (SoundName.KICK, SoundName.SNARE):
        assert abs(balance_db(hardest(kit, middle))) < 2.5
    toms_db = [balance_db(hardest(kit, name)) for name in TOMS]
    assert toms_db == sorted(toms_db)


def test_stereo_sums_to_mono_without_a_hole(kit: DrumKit) -> None:
    for name in MADE:
        sound = hardest(kit, name).astype(np.float64)
        correlation = np.sum(sound[:, 0] * sound[:, 1]) / np.sqrt(np.prod(np.sum(np.square(sound), axis=0)))
        assert correlation > 0.3


def test_a_choked_crash_is_gone_in_sixty_milliseconds(kit: DrumKit) -> None:
    mixer = Mixer(kit, {})
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.CRASH_1, Zone.EDGE), 127)
    mixer.render(RATE_HZ // 2)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1)
    choked = mixer.render(RATE_HZ // 5)
    assert np.abs(choked[: RATE_HZ // 100]).max() > 0.02
    assert not choked[RATE_HZ * 60 // 1000 :].any()


def test_the_foot_cuts_the_open_hihat(kit: DrumKit) -> None:
    mixer = Mixer(kit, {})
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=1.0), 127)
    mixer.render(RATE_HZ // 5)
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0), 40)
    with_chick = mixer.render(RATE_HZ // 2)
    assert np.abs(with_chick[RATE_HZ // 4 :]).max() < 1e-3


def test_the_same_seed_gives_the_same_sound() -> None:
    first, again = (make_sound(RECIPES[SoundName.SNARE], RATE_HZ, seed=5) for _ in range(2))
    other = make_sound(RECIPES[SoundName.SNARE], RATE_HZ, seed=6)
    pairs = [
        (a, b, c)
        for one, two, three in zip(first.layers, again.layers, other.layers, strict=True)
        for a, b, c in zip(one.takes, two.takes, three.takes, strict=True)
    ]
    assert all(np.array_equal(a, b) for a, b, _ in pairs)
    assert not any(len(a) == len(c) and np.allclose(a, c) for a, _, c in pairs)


@pytest.mark.parametrize("rate_hz", [44_100, 96_000])
@pytest.mark.parametrize(
    "name", [SoundName.KICK, SoundName.SNARE, SoundName.TOM_3, SoundName.HIHAT_CLOSED, SoundName.SPLASH]
)
def test_another_sample_rate_sounds_alike(kit: DrumKit, name: SoundName, rate_hz: int) -> None:
    other = make_sound(RECIPES[name], rate_hz, seed=1).layers[-1].takes[0]
    own = hardest(kit, name)
    assert centroid_hz(other, rate_hz) == pytest.approx(centroid_hz(own), rel=0.25)
    assert decay_s(other, 30, rate_hz) == pytest.approx(decay_s(own, 30), rel=0.3)
    assert len(other) / rate_hz == pytest.approx(len(own) / RATE_HZ, rel=0.2)


def test_a_kit_is_made_once_and_keeps_to_its_memory(kit: DrumKit) -> None:
    assert synth_kit(RATE_HZ) is kit
    assert kit.bytes_held < 130e6


def test_a_loud_chord_of_the_whole_kit_stays_in_range(kit: DrumKit) -> None:
    mixer = Mixer(kit, {})
    for piece in Piece:
        mixer.trigger(Bus.STUDENT, NoteMeaning(piece), 127)
    assert np.abs(mixer.render(RATE_HZ // 2)).max() <= 1.0


def test_a_groove_stays_below_the_limiter(kit: DrumKit) -> None:
    mixer = Mixer(kit, {})
    step = RATE_HZ // 8
    for beat in range(8):
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.HIHAT, Zone.BOW, openness=0.0), 85, beat * step)
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.SNARE if beat % 4 == 2 else Piece.KICK), 100, beat * step)
    assert np.abs(mixer.render(8 * step)).max() < 0.8
