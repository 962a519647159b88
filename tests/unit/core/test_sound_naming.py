import pytest

from station.core.sound_names import SoundName
from station.core.sound_naming import file_named, sound_named

# what a drummer reads in the names; those with "GM" stand in the table of instruments of a well-known rock kit
NAMES = [
    ("Kick", "kick"),
    ("Bass Drum 01", "kick"),
    ("BD_Hard", "kick"),
    ("Stick", "snare_cross_stick"),  # GM
    ("Side Stick", "snare_cross_stick"),
    ("Snare Rimshot", "snare_rim_shot"),  # GM
    ("SnareRim", "snare_rim_shot"),
    ("snare", "snare"),
    ("Hat Closed", "hihat_closed"),
    ("Hat Semi-Open", "hihat_half"),  # GM
    ("HiHatOpen", "hihat_open"),
    ("Closed HH", "hihat_closed"),
    ("Open HH", "hihat_open"),
    ("Hi-hat Pedal", "hihat_chick"),
    ("hihat_foot_splash", "hihat_foot_splash"),
    ("Floor Tom", "floor_tom_1"),
    ("FloorTom2", "floor_tom_2"),
    ("Tom 2", "tom_2"),
    ("Tom 1 rim", "tom_1_rim"),
    ("Tom Low", "tom_3"),
    ("Bell", "ride_bell"),
    ("Ride Bell", "ride_bell"),
    ("Cowbell", "cowbell"),
    ("Ride 2", "ride_2"),
    ("Ride Rock", "ride_bow"),
    ("Crash Left", "crash_1"),
    ("Crash 2", "crash_2"),
    ("Splash", "splash"),
    ("Chinese", "china"),
    ("Hand Clap", "clap"),
]


@pytest.mark.parametrize(("name", "sound"), NAMES)
def test_names_mean_pieces(name: str, sound: str) -> None:
    assert sound_named(name) is SoundName(sound)


@pytest.mark.parametrize("name", list(SoundName))
def test_our_own_names_mean_themselves(name: SoundName) -> None:
    assert sound_named(name) is name


@pytest.mark.parametrize("name", ["Vocal", "", "ooh", "7", "Weird Noise"])
def test_other_names_mean_nothing(name: str) -> None:
    assert sound_named(name) is None


@pytest.mark.parametrize(
    ("stem", "expected"),
    [
        ("snare_v40_r2", ("snare", 40, 2)),
        ("kick-v3", ("kick", 3, 0)),
        ("tom_2_v127_rr3", ("tom_2", 127, 3)),
        ("Kick-Softest", ("kick", 1, 0)),
        ("HatOpen-Hard", ("hihat_open", 4, 0)),
        ("snare mf", ("snare", 5, 0)),
        ("crash", ("crash_1", 0, 0)),
    ],
)
def test_file_names_tell_layer_and_take(stem: str, expected: tuple[str, int, int]) -> None:
    assert file_named(stem) == (SoundName(expected[0]), *expected[1:])
