from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.sound_names import SoundName
from station.sound.drum_kit import DrumKit, Frames
from station.sound.samples import recordings
from station.sound.samples.load_kit import kit_names, load_kit
from station.sound.samples.recordings import loudness_of
from tests.fakes.sound_files import steady, stroke

RATE_HZ = 48_000
SNARE_DB = -14.0  # what the default kit's table gives its snare


def folder_of(home: Path, files: dict[str, bytes], table: str | None = None) -> Path:
    for name, data in files.items():
        (home / name).parent.mkdir(parents=True, exist_ok=True)
        (home / name).write_bytes(data)
    if table is not None:
        (home / "kit.toml").write_text(table, encoding="utf-8")
    return home


def kit_in(home: Path, rate_hz: int = RATE_HZ) -> DrumKit:
    return load_kit(str(home), rate_hz)


def db(frames: Frames) -> float:
    return 20 * float(np.log10(loudness_of(frames, RATE_HZ)))


def test_layers_and_takes_come_from_the_names(tmp_path: Path) -> None:
    names = ["snare_v40_r1.wav", "snare_v40_r2.wav", "snare_v90.wav", "snare_v127.wav", "kick.wav", "sub/hihat.wav"]
    kit = kit_in(folder_of(tmp_path, {name: stroke() for name in names}))
    snare = kit.sounds[SoundName.SNARE]
    assert [(layer.to_velocity, len(layer.takes)) for layer in snare.layers] == [(40, 2), (90, 1), (127, 1)]
    assert SoundName.KICK in kit.sounds
    assert SoundName.HIHAT_CLOSED in kit.sounds


def test_ranks_share_the_velocities(tmp_path: Path) -> None:
    kit = kit_in(folder_of(tmp_path, {f"snare_v{rank}.wav": stroke() for rank in (1, 2, 3, 4)}))
    reaches = [layer.to_velocity for layer in kit.sounds[SoundName.SNARE].layers]
    assert reaches == [32, 64, 95, 127]  # 127/4 = 31.75, 63.5, 95.25, 127


def test_the_stroke_falls_on_frame_zero(tmp_path: Path) -> None:
    kit = kit_in(folder_of(tmp_path, {"snare.wav": stroke(before_s=0.03)}))
    take = kit.sounds[SoundName.SNARE].layers[0].takes[0]
    assert np.argmax(np.abs(take[:, 0])) / RATE_HZ < 0.001


def test_soft_layers_are_as_loud_as_hard_ones(tmp_path: Path) -> None:
    kit = kit_in(folder_of(tmp_path, {"snare_v60.wav": stroke(0.1), "snare_v127.wav": stroke(0.8)}))
    loud = [db(layer.takes[0]) for layer in kit.sounds[SoundName.SNARE].layers]
    assert loud == pytest.approx([SNARE_DB, SNARE_DB], abs=0.2)


def test_the_whole_kit_is_set_to_our_level_and_keeps_its_balance(tmp_path: Path) -> None:
    kit = kit_in(folder_of(tmp_path, {"snare.wav": stroke(0.4), "kick.wav": stroke(0.8)}))
    snare, kick = (db(kit.sounds[name].layers[0].takes[0]) for name in (SoundName.SNARE, SoundName.KICK))
    assert snare == pytest.approx(SNARE_DB, abs=0.1)
    assert kick - snare == pytest.approx(6.02, abs=0.1)  # twice the amplitude


def test_what_a_folder_lacks_is_lent_or_substituted(tmp_path: Path) -> None:
    kit = kit_in(folder_of(tmp_path, {"crash.wav": stroke()}))
    assert {SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED, SoundName.CRASH_1} == set(kit.sounds)
    assert kit.playing(SoundName.CRASH_2) is SoundName.CRASH_1


@pytest.mark.parametrize("rate_hz", [44_100, 96_000])
def test_a_kit_is_read_at_any_rate(tmp_path: Path, rate_hz: int) -> None:
    kit = kit_in(folder_of(tmp_path, {"snare.wav": stroke(length_s=0.4)}), rate_hz)
    assert kit.rate_hz == rate_hz
    assert len(kit.sounds[SoundName.SNARE].layers[0].takes[0]) == pytest.approx(0.4 * rate_hz, abs=3)


TABLE = """
name = "Shed"
[sounds.snare]
mute_group = 3
pan = -1.0
layers = [{ to_velocity = 60, takes = ["a.wav", "b.wav"] }, { takes = ["b.wav"], pitch = 12, gain_db = -6.0 }]
"""


def test_a_table_says_it_all(tmp_path: Path) -> None:
    kit = kit_in(folder_of(tmp_path, {"a.wav": steady(0.5), "b.wav": steady(0.5)}, TABLE))
    snare = kit.sounds[SoundName.SNARE]
    soft, hard = snare.layers[0].takes[0], snare.layers[1].takes[0]
    assert kit.name == "Shed"
    assert snare.mute_group == 3
    assert [(layer.to_velocity, len(layer.takes)) for layer in snare.layers] == [(60, 2), (127, 1)]
    assert np.all(soft[:, 1] == 0.0)  # hard left
    assert len(hard) == pytest.approx(len(soft) / 2, abs=2)  # an octave up
    assert 20 * np.log10(hard[5000, 0] / soft[5000, 0]) == pytest.approx(-6.0, abs=0.1)


def test_recorded_loudness_is_kept_and_rises_within_a_layer(tmp_path: Path) -> None:
    table = """loudness = "recorded"
[sounds.snare]
layers = [{ to_velocity = 64, takes = ["a.wav"] }, { takes = ["b.wav"] }]"""
    kit = kit_in(folder_of(tmp_path, {"a.wav": steady(0.2), "b.wav": steady(0.8)}, table))
    snare = kit.sounds[SoundName.SNARE]
    soft, hard = (snare.layers[index].takes[0][5000, 0] for index in (0, 1))
    assert hard / soft == pytest.approx(4.0, rel=1e-3)
    assert snare.levels[64] == pytest.approx(1.0)
    assert snare.levels[127] == pytest.approx(1.0)
    assert snare.levels[32] == pytest.approx(0.25)  # (32/64)²


@pytest.mark.parametrize(
    ("table", "fault"),
    [
        ("name = ", "expected a value"),
        ("nome = 'x'", "no such key: nome; did you mean name"),
        ("name = 'x'", "sounds is missing"),
        ("[sounds.gong]\nlayers=[{takes=['a.wav']}]", "no such sound: gong"),
        ("[sounds.snare]\nlayers=[]", r"sounds\.snare\.layers: expected a list"),
        ("[sounds.snare]\nlayers=[{takes=['a.wav'], to_velocity=90}]", "rises from layer to layer, to 127"),
        ("[sounds.snare]\nlayers=[{takes=['a.wav'], to_velocity=0}]", "expected a whole number from 1 to 127"),
        ("[sounds.snare]\nlayers=[{takes=['../a.wav']}]", "there is no such file"),
        ("[sounds.snare]\nlayers=[{takes=['/etc/passwd']}]", "there is no such file"),
        ("[sounds.snare]\nlayers=[{takes=['a.wav'], pitch=99}]", "layers.pitch: expected a number from -24 to 24"),
        (
            "[sounds.snare]\npan=nan\nlayers=[{takes=['a.wav']}]",
            "line 2, column 5: sounds.snare.pan: expected",
        ),
        ("[sounds.snare]\nmute_group='x'\nlayers=[{takes=['a.wav']}]", "mute_group: expected a whole number"),
        ("loudness='loud'\n[sounds.snare]\nlayers=[{takes=['a.wav']}]", "loudness: expected evened or recorded"),
        ("[sounds.snare]\nlayers=[{takes=['bad.wav']}]", r"bad\.wav: cannot be read as sound"),
    ],
)
def test_a_faulty_table_is_refused_with_its_place(tmp_path: Path, table: str, fault: str) -> None:
    home = folder_of(tmp_path, {"a.wav": stroke(), "bad.wav": b"RIFF"}, table)
    with pytest.raises(BadInput, match=fault):
        kit_in(home)


def test_a_folder_without_drums_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="no sound file here is named"):
        kit_in(folder_of(tmp_path, {"voice.wav": stroke()}))


def test_memory_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recordings, "MAX_KIT_BYTES", 400_000)
    takes = "[" + ", ".join(["'a.wav'"] * 5) + "]"  # 5 × 0.4 s × 48 000 × 8 bytes = 768 kB
    with pytest.raises(BadInput, match="larger than"):
        kit_in(folder_of(tmp_path, {"a.wav": stroke()}, f"[sounds.snare]\nlayers=[{{takes={takes}}}]"))


def test_long_recordings_are_faded_out_at_the_limit(tmp_path: Path) -> None:
    kit = kit_in(folder_of(tmp_path, {"crash.wav": steady(0.5, 14.0)}))
    take = kit.sounds[SoundName.CRASH_1].layers[0].takes[0]
    assert len(take) == 12 * RATE_HZ
    assert take[-1, 0] == 0.0
    assert np.abs(np.diff(take[:, 0])).max() < 1e-3


def test_links_out_of_the_folder_are_left_alone(tmp_path: Path) -> None:
    home = folder_of(tmp_path / "kit", {"kick.wav": stroke()})
    (tmp_path / "secret.wav").write_bytes(stroke())
    (home / "snare.wav").symlink_to(tmp_path / "secret.wav")
    with pytest.raises(BadInput, match="there is no such file"):
        kit_in(folder_of(home, {}, "[sounds.snare]\nlayers=[{takes=['snare.wav']}]"))


def test_kits_have_names_in_the_users_folder(tmp_path: Path) -> None:
    folder_of(tmp_path / "Shed", {"snare.wav": stroke()})
    assert "Shed" in kit_names(tmp_path)
    assert load_kit("Shed", RATE_HZ, tmp_path).name == "Shed"
    with pytest.raises(BadInput, match="Shad: no such drum kit; did you mean Shed"):
        load_kit("Shad", RATE_HZ, tmp_path)


@pytest.mark.parametrize("name", ["", "a" * 5_000, "a\0b", "../none"])
def test_a_name_that_no_kit_can_have_is_one_line(tmp_path: Path, name: str) -> None:
    with pytest.raises(BadInput, match="no such drum kit"):
        load_kit(name, RATE_HZ, tmp_path)
