"""Which stroke is heard on which frame, with a kit of impulses; the onsets are counted by hand from the tempo."""

from math import ceil

import numpy as np

from station.scenes.soundtrack import Sounds, Soundtrack
from station.sound.drum_kit import DrumKit
from tests.fakes.impulse_kit import LEVEL, impulse_mixer
from tests.unit.render.scores import rock

RATE_HZ = 48_000
EIGHTH = RATE_HZ // 4  # at 120 bpm
KIT: DrumKit = impulse_mixer(RATE_HZ).kit


def onsets(soundtrack: Soundtrack, ends_s: list[float]) -> list[int]:
    sound = np.concatenate([soundtrack.until(end_s) for end_s in ends_s])
    assert len(sound) == round(ends_s[-1] * RATE_HZ)
    return np.flatnonzero(np.abs(sound[:, 0]) > LEVEL / 50).tolist()


def test_every_stroke_falls_on_its_frame_however_the_sound_is_asked_for() -> None:
    expected = [RATE_HZ + k * EIGHTH for k in range(8)]
    for fps in (1, 24, 29.97, 60):
        ends = [k / fps for k in range(1, ceil(3.1 * fps) + 1)]
        assert onsets(Soundtrack.of_score(rock(), -1.0, Sounds(KIT, None)), ends) == expected


def test_from_the_middle_on_what_was_before_is_silent() -> None:
    assert onsets(Soundtrack.of_score(rock(2), 1.625, Sounds(KIT, None)), [0.5]) == [EIGHTH // 2, EIGHTH // 2 + EIGHTH]


def test_a_click_sounds_on_every_beat_of_the_score_and_not_before_it() -> None:
    """A click of the station's lasts longer than a frame: the frames between the strokes are its."""
    plain = Soundtrack.of_score(rock(), -1.0, Sounds(KIT, None)).until(3.5)
    clicked = Soundtrack.of_score(rock(), -1.0, Sounds(KIT)).until(3.5)
    difference = np.abs(clicked - plain)[:, 0]
    assert difference[:RATE_HZ].max() == 0
    level = difference.reshape(-1, EIGHTH // 12).max(axis=1)  # pieces of 1/12 of an eighth: 21 ms
    beats = [k for k in range(len(level)) if level[k] > 0.02 and level[k - 1] < 0.005]
    assert [12 * k / 12 * EIGHTH / 12 / RATE_HZ for k in beats] == [1.0, 1.5, 2.0, 2.5]
