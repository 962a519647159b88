"""What cues sound like without a sound card: drums and click as the station plays them, frame by frame."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.engine.cue_queue import CueRun
from station.engine.sound_player import SoundPlayer
from station.music.score import Score
from station.practice.session.cues.click_pattern import PLAIN, click_cues
from station.practice.session.cues.stroke_cues import demonstration_cues
from station.sound.click_sounds import DEFAULT_TIMBRE, click_sounds
from station.sound.drum_kit import DrumKit, Frames
from station.sound.mixer import Mixer


@dataclass(frozen=True, slots=True)
class Sounds:
    """The drum kit that sounds, and the click; None for no click."""

    kit: DrumKit
    click: str | None = DEFAULT_TIMBRE


class Soundtrack:
    """Plays `cues` (n,) of `CUE_DTYPE`, whose times count from its start."""

    def __init__(self, cues: NDArray[np.void], sounds: Sounds) -> None:
        self.rate_hz = sounds.kit.rate_hz
        self._done = 0
        clicks = click_sounds(self.rate_hz, sounds.click or DEFAULT_TIMBRE)
        self._player = SoundPlayer(Mixer(sounds.kit, clicks))
        self._player.play(CueRun(cues), 0)

    @classmethod
    def of_score(cls, score: Score, start_s: float, sounds: Sounds) -> "Soundtrack":
        """Plays `score` from `start_s` of it on (negative: before its first bar)."""
        return cls(_cues(score, start_s, sounds.click is not None), sounds)

    def until(self, after_s: float) -> Frames:
        """The sound from where the last call ended to `after_s` seconds after the start: float32 (n, 2)."""
        frames = round(after_s * self.rate_hz) - self._done
        at_ns = self._done * NS_PER_S // self.rate_hz
        self._done += frames
        return self._player.render(frames, at_ns)


def _cues(score: Score, start_s: float, with_click: bool) -> NDArray[np.void]:
    """What is to sound from `start_s` on, counted from there."""
    cues = demonstration_cues(score)
    if with_click:
        cues = np.concatenate([cues, click_cues(score.tempo_map, score.end_tick, PLAIN)])
    cues["at_ns"] -= round(start_s * NS_PER_S)
    return cues[cues["at_ns"] >= 0]
