"""The picture and the film of a sonified motion: what their pixels and their sound say."""

from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from station.core.sound_names import SoundName
from station.core.units import NS_PER_S
from station.render.files.video_file import VideoFormat
from station.render.flat_picture import flat_pictures
from station.render.palette import BRAND
from station.scenes.phase_film import RING_S, cues_of, sound_of, write_phase_film, write_phase_picture
from station.scenes.phase_view import PAGE, WalkingScene, trace_of
from station.scenes.soundtrack import Sounds, Soundtrack
from station.sound.drum_kit import DrumKit, Layer, Sound
from station.sync.sonification.sonified import Sonified, sonified
from station.sync.sonification.trigger_table import PRESETS
from station.sync.walking.trial import Trial, gait_model
from tests.fakes.impulse_kit import impulse
from tests.fakes.walker_files import write_walker

pytestmark = pytest.mark.gl

SIZE, FPS = (320, 180), 20
KIT = DrumKit("impulses", 48_000, {name: Sound((Layer(127, (impulse(),)),)) for name in SoundName})
WALK = PRESETS["walk"]


@pytest.fixture(scope="module")
def walk(tmp_path_factory: pytest.TempPathFactory) -> tuple[Sonified, WalkingScene]:
    trial = Trial.read(write_walker(tmp_path_factory.mktemp("walker"), cycles=3.0))
    told = sonified(gait_model(trial.signal), trial.signal, WALK)
    return told, WalkingScene.of(trial, trace_of(told, WALK, "phase", trial.steps))


def test_a_picture_has_the_disc_of_a_trigger_where_it_sounded(walk: tuple[Sonified, WalkingScene]) -> None:
    told, scene = walk
    kick = next(hit for hit in told.hits if hit.midi_note == 36)
    with flat_pictures((int(PAGE[0]), int(PAGE[1]))) as maker:
        still, axes = scene.still(maker.atlas, "walk")
        picture = maker.picture(still)
    row, column = round(axes.y_of_share(0.25)), round(axes.x(kick.at_ns / NS_PER_S))
    assert picture[row, column] == pytest.approx([255 * c for c in BRAND[:3]], abs=2)


def test_a_picture_is_written(walk: tuple[Sonified, WalkingScene], tmp_path: Path) -> None:
    write_phase_picture(walk[1], "walk", 1.0, SIZE, tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_a_film_lasts_as_long_as_the_motion_and_has_its_sound(
    walk: tuple[Sonified, WalkingScene], tmp_path: Path
) -> None:
    told, scene = walk
    soundtrack = Soundtrack(cues_of(told.hits, 0.0), Sounds(KIT, None))
    video = VideoFormat(SIZE, Fraction(FPS), soundtrack.rate_hz)
    shown: list[int] = []
    write_phase_film(scene, "walk", soundtrack, video, tmp_path / "a.mp4", shown.append)
    start_s, end_s = scene.trace.span_s
    with av.open(str(tmp_path / "a.mp4")) as file:
        pictures = [frame.to_ndarray(format="rgb24") for frame in file.decode(video=0)]
        assert len(file.streams.audio) == 1
    assert len(pictures) == len(shown) == round((end_s - start_s) * FPS)
    assert np.abs(pictures[20].astype(int) - pictures[30].astype(int)).max() > 50, "it moves"


def test_each_trigger_is_heard_at_its_time(walk: tuple[Sonified, WalkingScene]) -> None:
    told, scene = walk
    sound = sound_of(told.hits, scene.trace.span_s, Sounds(KIT, None))
    assert len(sound) == round((scene.trace.span_s[1] + RING_S) * KIT.rate_hz)
    heard_s = np.flatnonzero(np.abs(sound[:, 0]) > 0) / KIT.rate_hz
    assert heard_s == pytest.approx([hit.at_ns / NS_PER_S for hit in told.hits], abs=2 / KIT.rate_hz)
