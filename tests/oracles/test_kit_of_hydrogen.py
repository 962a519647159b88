"""A kit that Hydrogen's makers recorded: what is told of it was read off its file by eye."""

from pathlib import Path

import pytest

from station.core.sound_names import SoundName
from station.sound.samples.hydrogen_kit import pieces_of
from station.sound.samples.hydrogen_xml import parse_kit
from station.sound.samples.load_kit import load_kit
from tests.fakes.sound_files import stroke
from tests.oracles.folder import oracles

pytestmark = [pytest.mark.oracle, pytest.mark.parametrize("path", oracles("Hydrogen's kit"))]


def test_a_real_kit_is_understood(path: Path) -> None:
    kit = parse_kit(path.read_bytes(), str(path))
    assert kit.name == "GMRockKit"
    assert {name: one.name for name, one in pieces_of(kit).items()} == {
        SoundName.KICK: "Kick",
        SoundName.SNARE_CROSS_STICK: "Stick",
        SoundName.SNARE: "Snare",
        SoundName.CLAP: "Hand Clap",
        SoundName.SNARE_RIM_SHOT: "Snare Rimshot",
        SoundName.FLOOR_TOM_1: "Floor Tom",
        SoundName.HIHAT_CLOSED: "Hat Closed",
        SoundName.TOM_2: "Tom 2",
        SoundName.HIHAT_CHICK: "Hat Pedal",
        SoundName.TOM_1: "Tom 1",
        SoundName.HIHAT_OPEN: "Hat Open",
        SoundName.COWBELL: "Cowbell",
        SoundName.RIDE_BOW: "Ride",
        SoundName.CRASH_1: "Crash",
        SoundName.RIDE_2: "Ride 2",
        SoundName.SPLASH: "Splash",
        SoundName.HIHAT_HALF: "Hat Semi-Open",
        SoundName.RIDE_BELL: "Bell",
    }
    kick = next(one for one in kit.instruments if one.name == "Kick")
    assert kick.components[0].layers[0].filename == "Kick-Softest.wav"
    assert kick.components[0].layers[0].high == pytest.approx(0.202899)


def test_a_real_kit_with_stand_in_recordings_is_built(path: Path, tmp_path: Path) -> None:
    xml = path.read_bytes()
    (tmp_path / "drumkit.xml").write_bytes(xml)
    for part in parse_kit(xml, "").instruments:
        for recorded in (one for component in part.components for one in component.layers):
            (tmp_path / recorded.filename).write_bytes(stroke(length_s=0.1))
    kick = load_kit(str(tmp_path), 48_000).sounds[SoundName.KICK]
    # its layers end at 0.2029, 0.3696, 0.7319, 0.8659 and 1 of 127
    assert [one.to_velocity for one in kick.layers] == [26, 47, 93, 110, 127]
