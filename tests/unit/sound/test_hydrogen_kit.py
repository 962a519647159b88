import gzip
import tarfile
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.sound_names import HIHAT_STEPS, SoundName
from station.sound.drum_kit import DrumKit
from station.sound.samples import kit_archive
from station.sound.samples.hydrogen_kit import pieces_of
from station.sound.samples.hydrogen_xml import parse_kit
from station.sound.samples.load_kit import load_kit
from tests.fakes.sound_files import instrument, kit_xml, layer, steady, stroke, tar

RATE_HZ = 48_000
KICK_REACHES = [25, 51, 89, 114, 127]  # 0.2, 0.4, 0.7, 0.9 and 1 of 127, to the nearest


def kit_of(home: Path, xml: bytes, files: dict[str, bytes] | None = None) -> DrumKit:
    (home / "drumkit.xml").write_bytes(xml)
    for name, data in (files or {"a.wav": steady(0.25), "b.wav": steady(0.5)}).items():
        (home / name).write_bytes(data)
    return load_kit(str(home), RATE_HZ)


def level(kit: DrumKit, name: SoundName, velocity: int, turn: int = 0, channel: int = 0) -> float:
    return float(kit.sounds[name].frames_for(velocity, turn)[5000, channel])


TWO_LAYERS = layer("a.wav", 0.0, 0.5) + layer("b.wav", 0.5, 1.0)


@pytest.mark.parametrize("component", [True, False])
@pytest.mark.parametrize("namespace", ["", ' xmlns="http://www.hydrogen-music.org/drumkit"'])
def test_layers_old_and_new(tmp_path: Path, component: bool, namespace: str) -> None:
    xml = kit_xml(instrument("Snare", "", TWO_LAYERS, component=component), namespace=namespace)
    kit = kit_of(tmp_path, xml)
    snare = kit.sounds[SoundName.SNARE]
    assert kit.name == "Tiny"
    assert [one.to_velocity for one in snare.layers] == [64, 127]  # 0.5 · 127 = 63.5
    assert level(kit, SoundName.SNARE, 127) / level(kit, SoundName.SNARE, 20) == pytest.approx(2.0, rel=1e-3)
    assert snare.levels[127] == 1.0
    assert snare.levels[32] == pytest.approx(32 / 127)  # in proportion to the velocity


def test_the_oldest_form_names_a_file_alone(tmp_path: Path) -> None:
    kit = kit_of(
        tmp_path, kit_xml("<instrument><name>Kick</name><filename>a.wav</filename></instrument>", namespace="")
    )
    assert SoundName.KICK in kit.sounds


def test_gains_multiply(tmp_path: Path) -> None:
    quiet = instrument("Kick", "<volume>0.5</volume><gain>0.8</gain>", layer("a.wav", gain=0.5))
    kit = kit_of(tmp_path, kit_xml(instrument("Snare", "", layer("a.wav")), quiet))
    ratio = level(kit, SoundName.KICK, 127) / level(kit, SoundName.SNARE, 127)
    assert ratio == pytest.approx(0.5 * 0.8 * 0.5, rel=1e-3)


@pytest.mark.parametrize(
    ("pan", "left", "right"),
    [
        ("<pan>-1</pan>", 1.0, 0.0),
        ("<pan>0.5</pan>", 0.5, 1.0),
        ("<pan_L>1</pan_L><pan_R>0.25</pan_R>", 1.0, 0.25),
        ("<pan_L>0.5</pan_L><pan_R>0.5</pan_R>", 1.0, 1.0),
    ],
)
def test_pan_lowers_the_far_side(tmp_path: Path, pan: str, left: float, right: float) -> None:
    kit = kit_of(tmp_path, kit_xml(instrument("Snare", "", layer("a.wav")), instrument("Kick", pan, layer("a.wav"))))
    centre = level(kit, SoundName.SNARE, 127)
    assert level(kit, SoundName.KICK, 127, channel=0) / centre == pytest.approx(left, abs=1e-3)
    assert level(kit, SoundName.KICK, 127, channel=1) / centre == pytest.approx(right, abs=1e-3)


def test_pitches_add_up(tmp_path: Path) -> None:
    body = "<pitchOffset>5</pitchOffset>"
    kit = kit_of(tmp_path, kit_xml(instrument("Snare", body, layer("a.wav", pitch=7.0))))
    assert len(kit.sounds[SoundName.SNARE].frames_for(127, 0)) == pytest.approx(12_000, abs=2)  # 0.5 s an octave up


@pytest.mark.parametrize(("algorithm", "takes"), [("ROUND_ROBIN", 2), ("RANDOM", 2), ("VELOCITY", 1)])
def test_layers_of_one_velocity_take_turns(tmp_path: Path, algorithm: str, takes: int) -> None:
    both = layer("a.wav") + layer("b.wav")
    kit = kit_of(tmp_path, kit_xml(instrument("Snare", "", both, algorithm=algorithm)))
    assert len(kit.sounds[SoundName.SNARE].layers[0].takes) == takes


def test_microphones_add_up(tmp_path: Path) -> None:
    second = f"<instrumentComponent><gain>2</gain>{layer('a.wav')}</instrumentComponent>"
    both = instrument("Kick", second, layer("a.wav"))
    kit = kit_of(tmp_path, kit_xml(instrument("Snare", "", layer("a.wav")), both))
    ratio = level(kit, SoundName.KICK, 127) / level(kit, SoundName.SNARE, 127)
    assert ratio == pytest.approx(3.0, rel=1e-3)


def test_attack_and_decay_shape_the_take(tmp_path: Path) -> None:
    body = "<Attack>1000</Attack><Decay>2000</Decay><Sustain>0.25</Sustain>"
    kit = kit_of(tmp_path, kit_xml(instrument("Snare", "", layer("a.wav")), instrument("Kick", body, layer("a.wav"))))
    shaped, plain = (kit.sounds[name].frames_for(127, 0)[:, 0] for name in (SoundName.KICK, SoundName.SNARE))
    ratio = shaped[1:6000] / plain[1:6000]
    assert ratio[[499, 999, 1999, 5000]] == pytest.approx([0.5, 1.0, 0.625, 0.25], abs=2e-3)


def test_mute_groups_and_stop_of_velocity_are_kept(tmp_path: Path) -> None:
    body = "<muteGroup>2</muteGroup><applyVelocity>false</applyVelocity>"
    kit = kit_of(tmp_path, kit_xml(instrument("Hat Open", body, layer("a.wav"))))
    hat = kit.sounds[SoundName.HIHAT_OPEN]
    assert hat.mute_group == 2
    assert hat.levels[1] == 1.0


def hat(name: str, low: int, high: int) -> str:
    body = f"<isHihat>0</isHihat><lower_cc>{low}</lower_cc><higher_cc>{high}</higher_cc>"
    return instrument(name, body, layer("a.wav"))


@pytest.mark.parametrize(
    ("instruments", "expected"),
    [
        # openings 0, 32, 64, 95, 127
        ([hat("HH 1", 0, 10), hat("HH 2", 11, 70), hat("HH 3", 71, 127)], ["HH 1", "HH 2", "HH 2", "HH 3", "HH 3"]),
        # here the module says 127 for shut, as the names tell
        ([hat("Hat Open", 0, 63), hat("Hat Closed", 64, 127)], ["Hat Closed"] * 3 + ["Hat Open"] * 2),
    ],
)
def test_openings_choose_by_controller_ranges(instruments: list[str], expected: list[str]) -> None:
    kit = parse_kit(kit_xml(*instruments), "kit")
    chosen = pieces_of(kit)
    assert [chosen[step].name for step in HIHAT_STEPS] == expected


def test_pieces_of_one_family_count_on() -> None:
    kit = parse_kit(kit_xml(*(instrument(name, "", layer("a.wav")) for name in ("Crash", "Crash R", "Crash L"))), "kit")
    chosen = pieces_of(kit)
    assert {name: one.name for name, one in chosen.items()} == {
        SoundName.CRASH_1: "Crash",
        SoundName.CRASH_2: "Crash R",
    }


def test_an_unknown_name_goes_by_its_kind_then_its_note() -> None:
    strange = [
        instrument("Boom", "<type>Kick</type><midiOutNote>40</midiOutNote>", layer("a.wav")),
        instrument("Zing", "<midiOutNote>53</midiOutNote>", layer("a.wav")),
    ]
    chosen = pieces_of(parse_kit(kit_xml(*strange), "kit"))
    assert {name: one.name for name, one in chosen.items()} == {SoundName.KICK: "Boom", SoundName.RIDE_BELL: "Zing"}


def test_notes_that_only_count_instruments_mean_nothing() -> None:
    bodies = [f"<midiOutNote>{note}</midiOutNote>" for note in (36, 37)]
    chosen = pieces_of(parse_kit(kit_xml(*(instrument("Zap", body, layer("a.wav")) for body in bodies)), "kit"))
    assert chosen == {}


def usual_kit() -> bytes:
    """A kit of our own with the names that kits use, its instruments written as Hydrogen writes them (`USUAL`)."""
    body = "<volume>0.8</volume><isMuted>false</isMuted><Attack>0</Attack><Decay>0</Decay><Sustain>1</Sustain>"
    bounds = [0.0, 0.2, 0.4, 0.7, 0.9, 1.0]
    steps = "".join(layer(f"kick-{i}.wav", low, high) for i, (low, high) in enumerate(pairwise(bounds)))
    return kit_xml(*(instrument(name, body, steps if name == "Kick" else layer("a.wav")) for name in USUAL.values()))


USUAL = {
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


def test_a_whole_kit_is_understood() -> None:
    kit = parse_kit(usual_kit(), "drumkit.xml")
    assert {name: one.name for name, one in pieces_of(kit).items()} == USUAL
    kick = next(one for one in kit.instruments if one.name == "Kick")
    assert kick.components[0].layers[1].filename == "kick-1.wav"
    assert kick.components[0].layers[1].high == pytest.approx(0.4)


def test_a_whole_kit_is_built(tmp_path: Path) -> None:
    names = ["a.wav", *(f"kick-{i}.wav" for i in range(5))]
    kit = kit_of(tmp_path, usual_kit(), {name: stroke(length_s=0.1) for name in names})
    assert set(kit.sounds) >= set(USUAL)
    assert [one.to_velocity for one in kit.sounds[SoundName.KICK].layers] == KICK_REACHES


# --- what must be refused ----------------------------------------------------------------------------------------

BOMB = (
    b'<?xml version="1.0"?><!DOCTYPE d [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'
    b"<drumkit_info><name>&b;</name></drumkit_info>"
)


@pytest.mark.parametrize(
    ("xml", "fault"),
    [
        (b"", "line 1: not XML"),
        (b"<drumkit_info><name>", "line 1: not XML"),
        (b"\xff\xfe\x00rubbish", "line 1: not XML"),
        (b"<song/>", "expected <drumkit_info>"),
        (BOMB, "line 1: a document type with rules of its own"),
        (BOMB.decode().encode("utf-16"), "line 1: a document type with rules of its own"),
        (
            kit_xml(instrument("Kick", "<gain>x</gain>", layer("a.wav"))),
            r"instrument 1 \(Kick\), gain: 'x' is no number",
        ),
        (kit_xml(instrument("Kick", "<gain>nan</gain>", layer("a.wav"))), "gain: expected 0 to 100"),
        (kit_xml(instrument("Kick", "<volume>-1</volume>", layer("a.wav"))), "volume: expected"),
        (kit_xml(instrument("Kick", "", layer("a.wav", pitch=1e9))), "pitch: expected"),
        (kit_xml(instrument("Kick", "", layer("a.wav", 0.9, 0.1))), "reaches from"),
        (kit_xml(instrument("Kick", "", layer(""))), "names no sound file"),
        (kit_xml(instrument("Kick", "", layer("../../etc/passwd"))), "no such file in the kit"),
        (kit_xml(instrument("Voice", "", layer("a.wav"))), "none of its instruments"),
        (kit_xml(), "none of its instruments"),
    ],
)
def test_bad_kits_are_refused_with_their_place(tmp_path: Path, xml: bytes, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        kit_of(tmp_path, xml)


def archive_at(home: Path, data: bytes) -> str:
    path = home / "kit.h2drumkit"
    path.write_bytes(data)
    return str(path)


GOOD = {"Tiny/drumkit.xml": kit_xml(instrument("Snare", "", layer("a.wav"))), "Tiny/a.wav": stroke()}


@pytest.mark.parametrize("mode", ["w:gz", "w"])
def test_an_archive_is_a_kit(tmp_path: Path, mode: str) -> None:
    kit = load_kit(archive_at(tmp_path, tar(GOOD, mode=mode)), RATE_HZ)
    assert kit.name == "Tiny"
    assert SoundName.SNARE in kit.sounds


def link(name: str, kind: bytes, target: str) -> tarfile.TarInfo:
    member = tarfile.TarInfo(name)
    member.type, member.linkname = kind, target
    return member


@pytest.mark.parametrize(
    ("data", "fault"),
    [
        (b"", "no drum kit's archive"),
        (b"\x1f\x8b garbage", "no drum kit's archive|Not a gzipped file|Unknown compression"),
        (tar(GOOD)[:-200], "no drum kit's archive|ended"),
        (gzip.compress(b"hello" * 1000), "no drum kit's archive"),
        (tar({"Tiny/a.wav": stroke()}), r"holds no drumkit\.xml"),
        (tar({**GOOD, "../evil.wav": b"x"}), "leads out of the archive"),
        (tar({**GOOD, "/etc/evil": b"x"}), "leads out of the archive"),
        (tar({**GOOD, "..\\evil": b"x"}), "leads out of the archive"),
        (tar(GOOD, extra=[link("Tiny/b.wav", tarfile.SYMTYPE, "/etc/passwd")]), "is a link"),
        (tar(GOOD, extra=[link("Tiny/b.wav", tarfile.LNKTYPE, "Tiny/a.wav")]), "is a link"),
        (tar(GOOD, extra=[link("Tiny/b.wav", tarfile.CHRTYPE, "")]), "is a link, a device"),
    ],
)
def test_hostile_archives_are_refused(tmp_path: Path, data: bytes, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        load_kit(archive_at(tmp_path, data), RATE_HZ)


def test_bombs_are_refused_before_they_fill_the_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kit_archive, "MAX_BYTES", 1_000_000)
    bomb = tar({**GOOD, "Tiny/zeros.wav": bytes(5_000_000)})
    assert len(bomb) < 100_000
    with pytest.raises(BadInput, match=r"larger than|unpacks to more than"):
        load_kit(archive_at(tmp_path, bomb), RATE_HZ)


def test_a_bomb_in_a_header_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kit_archive, "MAX_BYTES", 1_000_000)
    member = tarfile.TarInfo("Tiny/x")
    member.pax_headers = {"comment": "0" * 5_000_000}
    with pytest.raises(BadInput, match="unpacks to more than"):
        load_kit(archive_at(tmp_path, tar(GOOD, extra=[member])), RATE_HZ)


def test_too_many_members_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kit_archive, "MAX_MEMBERS", 3)
    files = {**GOOD, **{f"Tiny/{index}.txt": b"" for index in range(5)}}
    with pytest.raises(BadInput, match="holds more than 3 files"):
        load_kit(archive_at(tmp_path, tar(files)), RATE_HZ)


def test_every_prefix_of_an_archive_is_refused_or_holds_all(tmp_path: Path) -> None:
    whole = tar(GOOD)
    refused = 0
    for end in range(0, len(whole) - 1, max(1, len(whole) // 40)):
        try:
            kit = load_kit(archive_at(tmp_path, whole[:end]), RATE_HZ)
        except BadInput:
            refused += 1
        else:  # only the padding behind the last file is missing
            assert len(kit.sounds[SoundName.SNARE].frames_for(127, 0)) == pytest.approx(0.4 * RATE_HZ, abs=1)
    assert refused > 35


def test_velocity_never_jumps_down_within_a_layer(tmp_path: Path) -> None:
    kit = kit_of(tmp_path, kit_xml(instrument("Snare", "", TWO_LAYERS)))
    assert np.all(np.diff(kit.sounds[SoundName.SNARE].levels) > 0)
