"""Recipes of the drums: kick, snare and its articulations, rack and floor toms.

Tones are the modes of heads (two coupled heads and the air between give ratios near 1, 1.5, 2, 2.4, 2.9 where damped
drums are tuned; Rossing, Science of Percussion Instruments, ch. 2–4) and of hoops; noise is stick, beater and wires.
Energies and decays: our choice, within what recordings of acoustic kits show. Panned as the drummer sits.
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.sound_names import SoundName
from station.sound.synth.recipe import Glide, Noise, Recipe, Row, Tone

SHELL_LAYERS = (20, 40, 60, 80, 100, 127)
RIM_LAYERS = (50, 90, 127)

_KICK = Recipe(
    rows=(
        Tone(54.0, -1.0, 0.52),
        Tone(86.0, -9.0, 0.26),
        Tone(128.0, -13.0, 0.16),
        Tone(205.0, -19.0, 0.12),
        Tone(320.0, -24.0, 0.10),
        Noise(300.0, 1000.0, -28.0, 0.09),
        Noise(1500.0, 4000.0, -22.0, 0.030, soft_db=-3.0),  # the beater
        Noise(4000.0, 8000.0, -27.0, 0.025, soft_db=-4.0),
        Noise(1500.0, 6000.0, -44.0, 0.25, attack_s=0.008),  # the snare's wires answer
    ),
    loudness_db=-10.0,
    layers=SHELL_LAYERS,
    glide=Glide(ratio=1.0, tau_s=0.016),
    tilt_db=3.0,
    room_db=-18.0,
)

_HEAD: tuple[Row, ...] = (
    Tone(186.0, -3.0, 0.26),
    Tone(332.0, -12.0, 0.24),
    Tone(424.0, -15.0, 0.22),
    Tone(561.0, -17.0, 0.20),
    Tone(738.0, -19.0, 0.16),
    Tone(955.0, -21.0, 0.13),
)
_WIRES: tuple[Row, ...] = (
    Noise(500.0, 1000.0, -14.0, 0.34, soft_db=2.0, attack_s=0.001),
    Noise(1000.0, 2000.0, -10.5, 0.42, soft_db=2.0, attack_s=0.001),
    Noise(2000.0, 4000.0, -9.0, 0.42, soft_db=2.5, attack_s=0.001),
    Noise(4000.0, 8000.0, -9.5, 0.38, soft_db=2.5, attack_s=0.001),
    Noise(8000.0, 14000.0, -13.5, 0.32, soft_db=2.0, attack_s=0.001),
)
_STICK: tuple[Row, ...] = (
    Noise(600.0, 2500.0, -15.0, 0.025),
    Noise(2500.0, 9000.0, -13.5, 0.018, soft_db=-4.0),
)

_SNARE = Recipe(
    rows=(*_HEAD, *_WIRES, *_STICK),
    loudness_db=-14.0,
    layers=SHELL_LAYERS,
    glide=Glide(ratio=0.10, tau_s=0.015),
    tilt_db=2.0,
    pan=-0.05,
    width=0.2,
    room_db=-11.0,
)

_RIM_SHOT = Recipe(
    rows=(
        Tone(190.0, -6.0, 0.26),
        Tone(338.0, -9.0, 0.34),
        Tone(441.0, -8.0, 0.42),
        Tone(792.0, -8.5, 0.38),
        Tone(1164.0, -9.5, 0.30),
        Tone(1731.0, -11.0, 0.24),
        Tone(2610.0, -14.0, 0.16),
        *_WIRES,
        Noise(800.0, 3000.0, -10.0, 0.028),
        Noise(3000.0, 10000.0, -11.0, 0.020, soft_db=-2.0),
    ),
    loudness_db=-14.5,
    layers=SHELL_LAYERS,
    glide=Glide(ratio=0.06, tau_s=0.012),
    tilt_db=1.5,
    pan=-0.05,
    width=0.2,
    room_db=-10.0,
)

_CROSS_STICK = Recipe(
    rows=(
        Tone(188.0, -13.0, 0.16),
        Tone(412.0, -7.0, 0.17),
        Tone(836.0, -8.5, 0.14),
        Tone(1268.0, -7.0, 0.12),
        Tone(1790.0, -8.5, 0.11),
        Tone(2660.0, -10.0, 0.09),
        Tone(4130.0, -13.0, 0.07),
        Noise(1500.0, 8000.0, -10.0, 0.025),
        Noise(1500.0, 7000.0, -24.0, 0.25, attack_s=0.004),
    ),
    loudness_db=-20.5,
    layers=RIM_LAYERS,
    tilt_db=1.5,
    pan=-0.05,
    width=0.1,
    room_db=-11.0,
)

_BUZZ = Recipe(
    rows=(*_HEAD, *_WIRES, *_STICK),
    loudness_db=-18.0,
    layers=(50, 90, 127),
    glide=Glide(ratio=0.04, tau_s=0.015),
    tilt_db=2.0,
    pan=-0.05,
    width=0.2,
    room_db=-11.0,
    # A stick pressed into the head bounces ever faster and softer.
    echoes=((0.034, 0.80), (0.063, 0.66), (0.088, 0.55), (0.110, 0.45), (0.129, 0.37), (0.146, 0.29), (0.161, 0.22)),
)


def _tom(pitch_hz: float, t60_s: float, pan: float) -> Recipe:
    """A tom whose fundamental is `pitch_hz` and rings for `t60_s`."""
    return Recipe(
        rows=(
            Tone(pitch_hz, -1.5, t60_s),
            Tone(1.012 * pitch_hz, -10.0, 0.8 * t60_s),  # the other head, a little apart: it beats
            Tone(1.52 * pitch_hz, -8.0, 0.42 * t60_s),
            Tone(1.98 * pitch_hz, -12.0, 0.36 * t60_s),
            Tone(2.44 * pitch_hz, -16.0, 0.28 * t60_s),
            Tone(2.91 * pitch_hz, -18.0, 0.24 * t60_s),
            Tone(3.62 * pitch_hz, -21.0, 0.18 * t60_s),
            Noise(400.0, 1600.0, -19.0, 0.07),
            Noise(1600.0, 6000.0, -21.0, 0.030, soft_db=-4.0),
            Noise(5000.0, 13000.0, -31.0, 0.050, soft_db=-4.0),
            Noise(1500.0, 6000.0, -36.0, 0.45, attack_s=0.008),  # the snare's wires answer
        ),
        loudness_db=-13.5,
        layers=SHELL_LAYERS,
        glide=Glide(ratio=0.10, tau_s=0.045),
        tilt_db=4.0,
        pan=pan,
        width=0.15,
        room_db=-13.0,
    )


def _tom_rim(pitch_hz: float, pan: float) -> Recipe:
    """A tom's rim shot: the hoop and the stick over a little of the head."""
    hoop_hz = 420.0 * (pitch_hz / 120.0) ** 0.5
    return Recipe(
        rows=(
            Tone(pitch_hz, -6.0, 0.45),
            Tone(1.52 * pitch_hz, -10.0, 0.30),
            Tone(hoop_hz, -8.0, 0.22),
            Tone(2.14 * hoop_hz, -9.0, 0.18),
            Tone(3.46 * hoop_hz, -10.0, 0.14),
            Tone(5.12 * hoop_hz, -12.0, 0.10),
            Noise(1500.0, 8000.0, -11.0, 0.028),
        ),
        loudness_db=-18.5,
        layers=RIM_LAYERS,
        tilt_db=1.5,
        pan=pan,
        width=0.1,
        room_db=-12.0,
    )


_TOMS = (
    (SoundName.TOM_1, SoundName.TOM_1_RIM, 176.0, 1.10, -0.25),
    (SoundName.TOM_2, SoundName.TOM_2_RIM, 147.0, 1.25, -0.05),
    (SoundName.TOM_3, SoundName.TOM_3_RIM, 124.0, 1.40, 0.12),
    (SoundName.TOM_4, SoundName.TOM_4_RIM, 105.0, 1.55, 0.25),
    (SoundName.FLOOR_TOM_1, SoundName.FLOOR_TOM_1_RIM, 86.0, 1.75, 0.40),
    (SoundName.FLOOR_TOM_2, SoundName.FLOOR_TOM_2_RIM, 69.0, 1.90, 0.50),
)
"""Head, rim, fundamental in Hz, T60 in s, pan: a minor third apart, from a 10-inch tom to an 18-inch floor tom."""

RECIPES: Mapping[SoundName, Recipe] = MappingProxyType(
    {
        SoundName.KICK: _KICK,
        SoundName.SNARE: _SNARE,
        SoundName.SNARE_RIM_SHOT: _RIM_SHOT,
        SoundName.SNARE_CROSS_STICK: _CROSS_STICK,
        SoundName.SNARE_BUZZ: _BUZZ,
        **{head: _tom(pitch_hz, t60_s, pan) for head, _, pitch_hz, t60_s, pan in _TOMS},
        **{rim: _tom_rim(pitch_hz, pan) for _, rim, pitch_hz, _, pan in _TOMS},
    }
)
