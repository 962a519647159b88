"""Recordings made fit to be played: the stroke on frame 0, an end without a click, a bounded memory, an even level."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import numpy as np

from station.core.errors import BadInput
from station.core.sound_names import SoundName
from station.sound.drum_kit import DrumKit, Frames, Sound
from station.sound.samples.audio_file import read_audio
from station.sound.synth.layers import loudness
from station.sound.synth.synth_kits import synth_sound

MAX_TAKE_S = 12.0
"""Our choice: the longest crash that is still heard; what rings longer is faded out there."""
MAX_KIT_BYTES = 512 * 2**20
"""A kit's frames in memory: some 23 minutes of stereo at 48 kHz (our choice; large free kits take half of it)."""
ONSET_DB = -40.0
"""The stroke begins where the recording first comes so near its peak; recorders leave up to 30 ms of silence before."""
LEAD_S = 0.0005
"""So much before the onset is kept and faded in."""
FADE_OUT_S = 0.005
CUT_S = 1.0
"""The fade of a take that had to be cut at `MAX_TAKE_S`."""
WANTED_DB = -14.0
"""Loudness of a snare's hardest stroke: the synthesised kit's, so that the click keeps its place beside it."""
MAX_GAIN_DB = 24.0
"""No kit is raised or lowered further: what is softer still is noise."""

ESSENTIAL = (SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED)


class Recordings:
    """Reads a kit's sound files, all together within `MAX_KIT_BYTES`."""

    def __init__(self, kit: str, rate_hz: int, files: Mapping[str, Path | bytes]) -> None:
        self._kit = kit
        self._rate_hz = rate_hz
        self._files = files
        self._left = MAX_KIT_BYTES

    def load(self, name: str, pitch: float = 0.0) -> Frames:
        """The file called `name`, struck at frame 0, as an array of its own.

        `pitch` in semitones. Raises `BadInput` where the file is missing, no sound, or too much for the kit.
        """
        if name not in self._files:
            raise BadInput(self._kit, name, "there is no such file in the kit")
        whole = read_audio(self._files[name], f"{self._kit}: {name}", self._rate_hz, MAX_TAKE_S, pitch)
        frames = struck_at_zero(whole, self._rate_hz)
        self._left -= frames.nbytes
        if self._left < 0:
            limit = f"the kit is larger than {MAX_KIT_BYTES // 2**20} MB in memory; take out layers or takes"
            raise BadInput(self._kit, name, limit)
        return frames


def struck_at_zero(frames: Frames, rate_hz: int) -> Frames:
    """`frames` without the silence before the stroke, and with a soft end: float32 (n, 2), a copy."""
    size = np.abs(frames).max(axis=1)
    peak = float(size.max())
    onset = int(np.argmax(size >= peak * 10.0 ** (ONSET_DB / 20.0))) if peak > 0.0 else 0
    lead = min(onset, round(LEAD_S * rate_hz))
    longest = round(MAX_TAKE_S * rate_hz)
    kept = frames[onset - lead :][:longest].copy()
    kept[:lead] *= np.linspace(0.0, 1.0, lead, endpoint=False, dtype=np.float32)[:, None]
    fade = min(len(kept) - lead, round((CUT_S if len(frames) >= longest else FADE_OUT_S) * rate_hz))
    if fade > 1:
        kept[-fade:] *= np.linspace(1.0, 0.0, fade, dtype=np.float32)[:, None]
    return kept


def kit_of(name: str, rate_hz: int, sounds: Mapping[SoundName, Sound]) -> DrumKit:
    """A kit of recorded sounds at the station's own level, its missing essentials lent by the synthesised kit."""
    balance(sounds, rate_hz)
    lent = {missing: synth_sound(missing, rate_hz) for missing in ESSENTIAL if missing not in sounds}
    return DrumKit(name, rate_hz, MappingProxyType({**lent, **sounds}))


def balance(sounds: Mapping[SoundName, Sound], rate_hz: int) -> None:
    """Scale all sounds alike, in place, so that the snare's hardest stroke is as loud as the synthesised kit's.

    Without a snare the loudest sound stands for it.
    """
    chosen = [sounds[SoundName.SNARE]] if SoundName.SNARE in sounds else list(sounds.values())
    loudest = max(loudness_of(take, rate_hz) for sound in chosen for take in sound.layers[-1].takes)
    if loudest > 0.0:
        scale(_all_takes(sounds), gain_within(10.0 ** (WANTED_DB / 20.0) / loudest))


def scale(takes: Iterable[Frames], gain: float) -> None:
    """Multiply each of `takes` by `gain`, in place, once however often it occurs."""
    for frames in {id(frames): frames for frames in takes}.values():
        np.multiply(frames, np.float32(gain), out=frames)


def balance_of(pan: float) -> Frames:
    """The factors (2,) of left and right for `pan` −1 left … 1 right: the far side is lowered, the near one kept."""
    return np.array([min(1.0, 1.0 - pan), min(1.0, 1.0 + pan)], np.float32)


def gain_within(gain: float) -> float:
    """`gain` held within ± `MAX_GAIN_DB`."""
    limit = float(10.0 ** (MAX_GAIN_DB / 20.0))
    return min(limit, max(1.0 / limit, gain))


def even(layers: Sequence[Sequence[Frames]], rate_hz: int) -> None:
    """Bring all takes of a sound, soft layers to hard, to the loudness of the loudest of its hardest, in place."""
    wanted = max(loudness_of(take, rate_hz) for take in layers[-1])
    for take in (take for takes in layers for take in takes):
        now = loudness_of(take, rate_hz)
        if now > 0.0:
            scale([take], gain_within(wanted / now))


def loudness_of(take: Frames, rate_hz: int) -> float:
    """The greatest RMS over 30 ms of its first 0.3 s; a take that is shorter counts as followed by silence."""
    short = round(0.3 * rate_hz) - len(take)
    return loudness(np.concatenate([take, np.zeros((short, 2), np.float32)]) if short > 0 else take, rate_hz)


def _all_takes(sounds: Mapping[SoundName, Sound]) -> list[Frames]:
    return [take for sound in sounds.values() for layer in sound.layers for take in layer.takes]
