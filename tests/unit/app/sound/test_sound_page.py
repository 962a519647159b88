"""What is set on the page is what sounds: the engine is the station's own, and its sound is measured frame by frame.

Every sound of the kit and every click is one frame of `LEVEL`. Expected levels are LEVEL × what was set × (v/127)², the
law of velocities (Dannenberg 2006); expected times are frames of 48 kHz, reckoned by hand from tempo and swing.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from station.app.actions.action import Show
from station.app.actions.practice_actions import Begin, EndSession
from station.app.actions.sound_actions import (
    ChooseClick,
    ChooseDrums,
    HearClick,
    HearDrums,
    MuteChannel,
    OutputChoice,
    SetChannel,
    SetClickPattern,
    SetHeard,
    SoloChannel,
    SoundOwnStrokes,
    StopHearing,
    UseOutput,
)
from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.sessions.launch import Launch
from station.core.errors import DeviceError
from station.core.pieces import Articulation, Piece, Zone
from station.core.settings import load_settings
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.engine import Engine
from station.engine.levels_option import ChannelLevel
from station.engine.messages import Command, KeyHit, Notice, Play, Ready, SetSounds, SoundsSet
from station.music.swing import Swing
from station.practice.session.cues.click_pattern import ClickPattern
from station.practice.session.plan import PlanOptions, plan_practice
from station.sound.drum_kit import Frames
from tests.fakes.impulse_kit import LEVEL, impulse_mixer
from tests.fakes.stations import Line, room, store_with

RATE_HZ, BLOCK = 48_000, 480
BLOCK_NS = BLOCK * NS_PER_S // RATE_HZ
ACCENT, BEAT, PART = ((v / 127) ** 2 for v in (110, 90, 70))
BEAT_FRAMES = 36_000
"""A quarter of rock-1, at 80."""


class NoWork:
    """Work of which nothing comes."""

    def __init__(self, do: Callable[..., object], *words: object) -> None:
        pass

    def result(self) -> Any:  # noqa: ANN401 - whatever the work would give
        return None

    def end(self) -> None:
        pass


class Sounding(Line):
    """An engine whose sound can be looked at; it reads sounds at once."""

    def __init__(self) -> None:
        super().__init__()
        self.engine = Engine(impulse_mixer())
        self.now_ns = 0
        self.missing: set[str] = set()

    def send(self, command: Command) -> None:
        super().send(command)
        self.engine.handle(command)
        if isinstance(command, SetSounds):
            fault = f"{command.drums}: no such drum kit" if command.drums in self.missing else None
            self.says.append(SoundsSet(command.drums, command.click, fault))

    def sound(self, station: Controller, seconds: float) -> Frames:
        """What sounds from now on, while the station goes on: (n, 2)."""
        blocks = []
        for _ in range(round(seconds * RATE_HZ / BLOCK)):
            blocks.append(self.engine.render(BLOCK, self.now_ns))
            self.now_ns += BLOCK_NS
            self.says += self.engine.advance(self.now_ns)
            station.update(self.now_ns)
        return np.concatenate(blocks)


def station_with(folder: Path, **chosen: object) -> tuple[Controller, Sounding]:
    line = Sounding()
    launch = Launch(plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0)))
    station = Controller(ChildPrograms(lambda: line, work=NoWork), store_with(folder, **chosen), launch)
    station.dispatch(Show(sound=True))
    return station, line


def onsets(sound: Frames) -> list[tuple[int, float, float]]:
    """Frames since the first that sounds, and how loud left and right are."""
    (struck,) = np.nonzero(sound.max(axis=1) > 1e-6)
    return [(int(at - struck[0]), float(sound[at, 0]), float(sound[at, 1])) for at in struck]


def test_the_click_sounds_as_it_is_set(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    station.dispatch(SetChannel("click", ChannelLevel(0.5, -0.5)))
    station.dispatch(SetClickPattern(ClickPattern(subdivisions=2, swing=Swing(2.0), accents=(0, 2), off=(1,))))
    heard = onsets(line.sound(station, 4.0))
    late = BEAT_FRAMES * 2 // 3  # of two swung eighths the first lasts two thirds
    expected = [
        (0, ACCENT),
        (late, PART),
        (BEAT_FRAMES + late, PART),  # beat 2 is off, what follows it is not
        (2 * BEAT_FRAMES, ACCENT),
        (2 * BEAT_FRAMES + late, PART),
        (3 * BEAT_FRAMES, BEAT),
        (3 * BEAT_FRAMES + late, PART),
        (4 * BEAT_FRAMES, ACCENT),
    ]
    assert [at for at, *_ in heard] == pytest.approx([at for at, _ in expected], abs=1)
    assert [left for _, left, _ in heard] == pytest.approx([0.5 * LEVEL * weight for _, weight in expected], rel=1e-3)
    assert [right for *_, right in heard] == pytest.approx([0.25 * LEVEL * weight for _, weight in expected], rel=1e-3)
    assert load_settings(tmp_path / "settings.toml").click_pattern == "parts=2,swing=2,accents=1+3,off=2"
    assert station.view().settings.levels == "click=0.5@-0.5"


def struck(station: Controller, line: Sounding, piece: Piece) -> tuple[float, float]:
    """How loud a stroke at full velocity is, left and right."""
    line.sound(station, 0.02)  # levels take 10 ms to where they are set
    line.send(KeyHit(line.now_ns, piece, Zone.HEAD, 127, Articulation.NORMAL))
    sound = line.sound(station, 0.05)
    return float(sound[:, 0].max()), float(sound[:, 1].max())


def test_levels_pans_mute_solo_and_the_night(tmp_path: Path) -> None:
    station, line = station_with(tmp_path, levels="kick=1.2")
    station.dispatch(SetChannel("snare", ChannelLevel(0.5, 1.0)))
    assert struck(station, line, Piece.SNARE) == pytest.approx((0.0, 0.5 * LEVEL))
    station.dispatch(SetChannel("master", ChannelLevel(0.4)))
    assert struck(station, line, Piece.SNARE) == pytest.approx((0.0, 0.2 * LEVEL), rel=1e-4)
    station.dispatch(MuteChannel("snare"))
    assert struck(station, line, Piece.SNARE) == (0.0, 0.0)
    assert station.view().settings.levels == "kick=1.2 snare=0@1 master=0.4"
    station.dispatch(MuteChannel("snare"))
    assert struck(station, line, Piece.SNARE) == pytest.approx((0.0, 0.2 * LEVEL), rel=1e-4)
    station.dispatch(SoloChannel("ride"))
    assert struck(station, line, Piece.SNARE) == (0.0, 0.0)
    assert struck(station, line, Piece.RIDE) == pytest.approx((0.4 * LEVEL,) * 2, rel=1e-4)
    station.dispatch(Show())  # the page is left
    assert struck(station, line, Piece.SNARE)[1] == pytest.approx(0.2 * LEVEL, rel=1e-4)
    station.dispatch(SetHeard("nothing"))
    assert struck(station, line, Piece.SNARE) == (0.0, 0.0)
    station.dispatch(SetHeard("everything"))
    assert struck(station, line, Piece.SNARE)[1] == pytest.approx(0.2 * LEVEL, rel=1e-4)
    station.dispatch(SoundOwnStrokes(on=False))
    assert struck(station, line, Piece.SNARE) == (0.0, 0.0)


def test_with_the_click_alone_strokes_are_silent_and_clicks_are_not(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    station.dispatch(SetHeard("click"))
    assert struck(station, line, Piece.SNARE) == (0.0, 0.0)
    station.dispatch(HearClick())
    assert onsets(line.sound(station, 4.0))[0][1] == pytest.approx(LEVEL * ACCENT, rel=1e-3)


def test_a_kit_is_tried_for_a_groove_and_only_a_click_chooses_it(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    station.dispatch(HearDrums("brushes"))
    assert onsets(line.sound(station, 1.0)), "it is heard"
    assert station.view().sound.tried == "brushes"
    station.dispatch(StopHearing())
    line.sound(station, 0.5)
    assert not onsets(line.sound(station, 1.0))
    assert [command for command in line.heard if isinstance(command, SetSounds)] == [
        SetSounds("brushes", "bar"),
        SetSounds("acoustic", "bar"),
    ]
    assert station.view().settings.drums == "acoustic"
    station.dispatch(HearDrums("electronic"))
    line.sound(station, 0.5)
    station.dispatch(ChooseDrums("electronic"))
    station.dispatch(StopHearing())
    assert line.heard[-1] != SetSounds("acoustic", "bar")
    assert station.view().settings.drums == "electronic"
    station.dispatch(ChooseClick("wood"))
    assert line.heard[-1] == SetSounds("electronic", "wood")


def test_a_kit_that_cannot_be_had_is_told_and_the_one_before_stays(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    line.missing = {"shed"}
    station.dispatch(ChooseDrums("shed"))
    station.update(1)
    assert "shed: no such drum kit" in station.view().toast
    assert station.view().settings.drums == "acoustic"
    assert line.heard[-1] == SetSounds("acoustic", "bar")


def test_who_plays_is_not_disturbed(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    station.dispatch(HearDrums("brushes"))
    line.sound(station, 0.1)
    station.dispatch(Begin())
    line.sound(station, 0.1)
    assert line.heard[-1] == SetSounds("acoustic", "bar"), "the session has the kit that is chosen"
    before = len(line.heard)
    station.dispatch(HearDrums("electronic"))
    station.dispatch(SetClickPattern(ClickPattern(counts=True)))
    assert not any(isinstance(command, SetSounds | Play) for command in line.heard[before:])
    station.dispatch(UseOutput(OutputChoice("other", 64, RATE_HZ)))
    station.update(line.now_ns + 1)
    assert "end the session first" in station.view().toast
    station.dispatch(EndSession())
    station.close()


class Outputs:
    """Engines that open what the settings say, but for some."""

    def __init__(self, folder: Path, **chosen: object) -> None:
        self.store = store_with(folder, **chosen)
        self.opened: list[str] = []
        launch = Launch(plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0)))
        self.station = Controller(ChildPrograms(self._wake), self.store, launch)
        self.pass_by()

    def _wake(self) -> Line:
        line, wanted = Line(), self.store.now.output
        self.opened.append(wanted)
        if wanted == "broken":
            fault = f"no sound output is called {wanted!r}"
            line.says = [Notice(f"running silent, on the computer's own clock: {fault}"), Ready(None)]
        else:
            line.says = [Ready(wanted or "Speakers", self.store.now.rate_hz)]
        return line

    def pass_by(self) -> None:
        for i in range(20):
            self.station.update(i * 100 * NS_PER_MS)
            resting = self.station.parts.engine._resting
            if resting is not None:
                resting.join()


def test_another_output_is_opened_between_sessions(tmp_path: Path) -> None:
    outputs = Outputs(tmp_path)
    outputs.station.dispatch(UseOutput(OutputChoice("Headphones", 64, 44_100)))
    outputs.pass_by()
    assert outputs.opened == ["", "Headphones"]
    assert outputs.station.view().toast == "sound goes to Headphones, at 44100 Hz"
    now = outputs.store.now
    assert (now.output, now.block_frames, now.rate_hz) == ("Headphones", 64, 44_100)
    assert room(outputs.station).sound == "Headphones"


def test_an_output_that_does_not_sound_is_left_for_the_one_before(tmp_path: Path) -> None:
    outputs = Outputs(tmp_path, output="Headphones", block_frames=128)
    outputs.station.dispatch(UseOutput(OutputChoice("broken", 64, 48_000)))
    outputs.pass_by()
    assert outputs.opened == ["Headphones", "broken", "Headphones"]
    assert outputs.station.view().toast == "no sound output is called 'broken'; back to Headphones"
    assert (outputs.store.now.output, outputs.store.now.block_frames) == ("Headphones", 128)


def test_where_nothing_sounded_there_is_no_way_back(tmp_path: Path) -> None:
    outputs = Outputs(tmp_path, output="broken")
    outputs.station.dispatch(UseOutput(replace(outputs.station.parts.sound.output.chosen, block_frames=64)))
    outputs.pass_by()
    assert outputs.opened == ["broken", "broken"]
    assert outputs.store.now.block_frames == 64


def test_a_dead_engine_is_told_once(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    line.dead = True
    station.dispatch(HearDrums("brushes"))
    station.update(1)
    assert "the engine has ended" in station.view().toast
    station.dispatch(StopHearing())
    with pytest.raises(DeviceError):
        line.send(SetSounds("acoustic", "bar"))
