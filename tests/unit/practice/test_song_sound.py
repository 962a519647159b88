"""What comes out of the loudspeaker while a song is practised: the band's strokes lie on the clicks, pass after pass.

The band is made here: a burst of noise on each beat of a tempo that wanders, a soft chord under it. Where a burst lies
in the sound that comes out is found by its energy alone, with nothing of the code under test.
"""

from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from station.drills.songs.song_lesson import read_song_lesson
from station.engine.cue_queue import CueRun
from station.engine.messages import Bus, Play, SetBacking
from station.engine.sound_player import SoundPlayer
from station.practice.session.backing_track import song_request
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.session import Session
from station.sound.track import load
from station.sound.track_file import prepare
from tests.fakes.impulse_kit import impulse_mixer
from tests.fakes.song_files import write_song

RATE_HZ = 48_000
BLOCK = 256
Sound = NDArray[np.float64]


def beats_s(seed: int, count: int = 33, wander: float = 0.01) -> Sound:
    """Beats of a band about 120 a minute that wanders, each beat by a share of SD `wander`; the first at 0.9 s."""
    steps = 0.5 * np.exp(np.cumsum(np.random.default_rng(seed).normal(0.0, wander, count - 1)))
    return np.round(0.9 + np.concatenate([[0.0], np.cumsum(steps)]), 4)


def write_band(path: Path, times_s: Sound) -> None:
    """The band's sound: bursts of 30 ms on the beats, and a chord 30 dB below them."""
    time_s = np.arange(round((times_s[-1] + 3.0) * RATE_HZ)) / RATE_HZ
    sound: Sound = 0.01 * np.sum([np.sin(2 * np.pi * hz * time_s) for hz in (220.0, 277.2, 329.6)], axis=0)
    burst = np.random.default_rng(7).normal(0.0, 0.3, round(0.03 * RATE_HZ))
    for at_s in times_s[:-1]:
        at = round(at_s * RATE_HZ)
        sound[at : at + len(burst)] += burst * np.exp(-np.arange(len(burst)) / 300)
    soundfile.write(path, sound.astype(np.float32), RATE_HZ)


def practised(folder: Path, share: float, bars: tuple[int, int], loops: int, seed: int = 1) -> Plan:
    times_s = beats_s(seed)
    song = read_song_lesson(write_song(folder, top=f"quarters_s = [{', '.join(map(str, times_s))}]"))
    write_band(folder / "band.wav", times_s)
    return plan_practice(song, PlanOptions(song.tempo_bpm * share, loops, bars))


def heard(plan: Plan, folder: Path, silent: Bus, card_ppm: float = 0.0) -> tuple[Sound, Sound]:
    """What comes out while `plan` is practised, one channel, and when each frame is heard after the first pass began.

    The card's clock is `card_ppm` parts in a million faster than the session's.
    """
    request = song_request(plan)
    assert request is not None
    _, backing, play = Session(plan, backing=prepare(request.track(plan, RATE_HZ), folder / "kept")).start()
    assert isinstance(backing, SetBacking)
    assert isinstance(play, Play)
    assert backing.track is not None
    player = SoundPlayer(impulse_mixer())
    player.set_level(silent, 0.0, 0.0)
    player.set_track(load(backing.track), backing.at_ns)
    player.play(CueRun(play.cues), 0)
    frame_ns = 1e9 / (RATE_HZ * (1.0 + card_ppm * 1e-6))
    blocks = range(0, round(plan.end_ns / frame_ns), BLOCK)
    sound: Sound = np.concatenate([player.render(BLOCK, round(first * frame_ns))[:, 0] for first in blocks]).astype(
        float
    )
    at_s = (np.arange(len(sound)) * frame_ns - plan.passes_start_ns) / 1e9
    return sound, at_s.astype(np.float64)


def bursts_s(sound: Sound, at_s: Sound, near_s: Sound) -> Sound:
    """When the burst near each time begins: where a tenth of the energy of ±60 ms has come."""
    energy, found = np.concatenate([[0.0], np.cumsum(np.diff(sound, prepend=0.0) ** 2)]), []
    for near in near_s:
        first, end = np.searchsorted(at_s, [near - 0.06, near + 0.06])
        share = (energy[first:end] - energy[first]) / (energy[end] - energy[first])
        found.append(at_s[first + int(np.searchsorted(share, 0.1))])
    return np.array(found)


@pytest.mark.parametrize(("share", "ppm"), [(0.6, 0.0), (1.0, 100.0), (1.3, -100.0)])
def test_the_band_lies_on_the_clicks_through_three_seams(tmp_path: Path, share: float, ppm: float) -> None:
    plan = practised(tmp_path, share, (3, 4), loops=4)
    clicks, clicks_at_s = heard(plan, tmp_path, silent=Bus.BACKING, card_ppm=ppm)
    clicks_s = clicks_at_s[(clicks > 0.01) & (clicks_at_s > -0.01)]
    assert len(clicks_s) == 32
    band, band_at_s = heard(plan, tmp_path, silent=Bus.CLICK, card_ppm=ppm)
    off_ms = 1e3 * (bursts_s(band, band_at_s, clicks_s) - clicks_s)
    assert np.abs(off_ms).max() < 10.0
    assert abs(off_ms[-8:].mean() - off_ms[:8].mean()) < 1.0, "the last pass lies as the first"


def test_fifty_passes_do_not_drift(tmp_path: Path) -> None:
    plan = practised(tmp_path, 1.0, (3, 3), loops=50)
    band, at_s = heard(plan, tmp_path, silent=Bus.CLICK)
    expected_s = plan.score.onset_s
    off_ms = 1e3 * (bursts_s(band, at_s, expected_s) - expected_s).reshape(50, 4).mean(axis=1)
    assert abs(off_ms[-1] - off_ms[0]) < 1.0


def test_without_drums_a_mix_has_the_strokes_of_its_part_turned_down(tmp_path: Path) -> None:
    """Its bursts, where the part strikes, fall by 6 dB and more; the chord between them stays as it is."""
    plan = practised(tmp_path, 1.0, (3, 4), loops=2)
    loud, soft = (
        load(prepare(request.track(plan, RATE_HZ), tmp_path / "kept")).pcm[:, 0].astype(float)
        for with_drums in (True, False)
        if (request := song_request(plan, with_drums)) is not None
    )
    band = plan.lesson.band
    assert band is not None
    begin_s = (
        band.start_s + float(plan.lesson.score.tempo_map.seconds_at(plan.lesson.score.tempo_map.bar_start(2))) - 1.0
    )
    beats = np.rint((beats_s(1)[8:16] - begin_s) * RATE_HZ).astype(int)
    struck, softened = ([track[b : b + 800] for b in beats] for track in (loud, soft))
    assert 20 * np.log10(np.std(struck) / np.std(softened)) > 6.0
    chord = [track[b + 18_000 : b + 21_000] for track in (loud, soft) for b in beats[:-1]]
    assert np.std(chord[:7]) == pytest.approx(np.std(chord[7:]), rel=0.05)
