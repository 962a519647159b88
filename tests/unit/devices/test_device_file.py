"""Own kits as files: every word read, every fault at its place, what is written reads back."""

from pathlib import Path
from types import MappingProxyType

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.mapping.device_file import own_kit, own_kit_path, parse_kit, read_kit, save_kit
from station.devices.mapping.device_map import Crosstalk, DeviceMap, Foot, Pad, PedalRange
from station.devices.mapping.device_writer import kit_text
from station.devices.mapping.presets import PRESETS, preset_named
from station.devices.mapping.velocity_curve import SHAPES, VelocityCurve

EVERYTHING = """
title = "mine"
base = "yamaha-dtxplorer"
notes.66 = { piece = "ride", zone = "edge" }
notes.46 = { piece = "hihat", zone = "bow", openness = 0.5 }
notes.49 = { piece = "none" }
pedal = { open = 127, shut = 10 }
foot = { least_travel = 0.3, splash_ms = 90, by_controller = true }
choke = { from = 100, grab_velocity = 20, notes.60 = { piece = "crash_1" } }
positions.16 = { pieces = ["snare", "tom_1"] }
channels.3.notes.36 = { piece = "cowbell" }
pads.snare = { threshold = 5, mask_ms = 9.5, least_velocity = 12, curve = "light" }
pads.kick = { curve = { softest = 8, loudest = 118.5, bend = -0.25 } }
[[crosstalk]]
source = "kick"
victim = "snare"
share = 0.3
before_ms = 2
"""


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "kit.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_everything_that_can_be_said_is_read(tmp_path: Path) -> None:
    kit, base = read_kit(written(tmp_path, EVERYTHING)), preset_named("yamaha-dtxplorer")
    assert (kit.title, kit.base) == ("mine", "yamaha-dtxplorer")
    assert kit.notes[66] == NoteMeaning(Piece.RIDE, Zone.EDGE)
    assert kit.notes[46] == NoteMeaning(Piece.HIHAT, Zone.BOW, openness=0.5)
    assert 49 not in kit.notes
    assert kit.notes[33] == base.notes[33]
    assert kit.pedal == PedalRange(127, 10)
    assert kit.foot == Foot(0.3, 90 * NS_PER_MS, True)
    assert (kit.choke_from, kit.grab_velocity, dict(kit.choke_notes)) == (100, 20, {60: Piece.CRASH_1})
    assert dict(kit.position_controllers) == {16: {Piece.SNARE, Piece.TOM_1}}
    assert kit.pad(Piece.SNARE) == Pad(5, 9_500_000, 12, VelocityCurve(1.0, 127.0, 0.25))
    assert kit.pad(Piece.KICK) == Pad(curve=VelocityCurve(8.0, 118.5, -0.25))
    assert dict(kit.channel_notes) == {(3, 36): NoteMeaning(Piece.COWBELL)}
    assert kit.crosstalk == (Crosstalk(Piece.KICK, Piece.SNARE, 0.3, 30 * NS_PER_MS, 2 * NS_PER_MS),)


@pytest.mark.parametrize(
    ("text", "place", "fault"),
    [
        ('base = "roland-td-99"', "line 1, column 8", "no such kit preset"),
        ("nots = 3", "line 1", "no such key"),
        ('title = "a"\nnotes.128 = { piece = "snare" }', "line 2", "from 0 to 127"),
        ('notes.38 = { piece = "snaer" }', "line 1, column 22", "snare"),
        (
            'notes.38 = { piece = "snare", zone = "top" }',
            "line 1, column 38",
            "expected head, rim, bow, bell, edge or pedal",
        ),
        ('notes.38 = { zone = "head" }', "line 1", "is missing"),
        ("notes.38 = 5", "line 1, column 12", "expected a table"),
        ("pedal = { open = 5, shut = 5 }", "line 1, column 28", "tells nothing"),
        ("pedal = { steps = [3] }", "line 1, column 19", "0, 56, 127"),
        ("pads.snare = { threshold = 0 }", "line 1, column 28", "1 to 127"),
        ("pads.snaer = { threshold = 2 }", "line 1", "no such pad: snaer; did you mean snare?"),
        (
            'pads.snare = { curve = "softly" }',
            "line 1, column 24",
            "expected as_sent, light, very_light, firm or very_firm",
        ),
        ("pads.snare = { curve = { softest = 0 } }", "line 1, column 36", "1 to 100"),
        ("pads.snare = { curve = { softest = 90, loudest = 95 } }", "line 1, column 50", "10 or more above softest"),
        ("pads.snare = { curve = { bend = 2 } }", "line 1, column 33", "-1 to 1"),
        ("pads.snare = { curve = { bent = 0.5 } }", "line 1", "no such key"),
        ("pads.snare = { curve = 7 }", "line 1, column 24", "expected a table"),
        ('channels.17.notes.36 = { piece = "kick" }', "line 1", "from 1 to 16"),
        ('channels.1.notes.36 = { piece = "kik" }', "line 1, column 33", "kick"),
        ('positions.16 = { pieces = ["snaer"] }', "line 1, column 28", "did you mean snare?"),
        ("positions.16 = { pieces = [] }", "line 1, column 27", "pieces such as"),
        ("positions.16 = { pieces = 4 }", "line 1, column 27", "pieces such as"),
        ('notes.38 = { piece = "snare" }\nnotes.038 = { piece = "ride" }', "line 2, column 1", "038 is here twice"),
        ("crosstalk = 4", "line 1, column 13", "array of tables"),
        (
            '[[crosstalk]]\nsource = "kick"\nvictim = "snare"\nshare = 1.5',
            "line 4, column 9",
            "crosstalk.share: expected a number from 0 to 1",
        ),
        ('[[crosstalk]]\nsource = "kick"\nvictim = "kick"\nshare = 0.5', "line 3, column 10", "not its own"),
        ("title = @", "line 1, column 9", ""),
    ],
)
def test_a_fault_is_named_with_its_place(text: str, place: str, fault: str, tmp_path: Path) -> None:
    with pytest.raises(BadInput) as raised:
        read_kit(written(tmp_path, text))
    assert raised.value.place.startswith(place)
    assert fault in raised.value.fault


def test_a_device_has_its_own_file(tmp_path: Path) -> None:
    assert own_kit_path("2- TD-17", tmp_path) == own_kit_path("TD-17", tmp_path) == tmp_path / "TD-17.toml"
    assert own_kit_path("TD-27:TD-27 MIDI 1 24:0", tmp_path).name == "TD-27-TD-27-MIDI-1.toml"
    assert own_kit_path("../..", tmp_path).parent == tmp_path
    assert own_kit("TD-17", tmp_path) is None
    save_kit(preset_named("roland-td-17"), "TD-17", tmp_path)
    found = own_kit("2- TD-17", tmp_path)
    assert found is not None
    assert found.base == "roland-td-17"


@pytest.mark.parametrize("name", sorted(PRESETS))
def test_a_preset_needs_no_words_but_its_name(name: str) -> None:
    assert len(kit_text(preset_named(name)).splitlines()) == 2


VELOCITY, NUMBER = st.integers(1, 127), st.integers(0, 127)
PIECE, SHARE = st.sampled_from(Piece), st.floats(0, 1)
NS = st.integers(0, 500 * NS_PER_MS)
CURVES = st.one_of(
    st.sampled_from(sorted(SHAPES.values(), key=str)),
    st.builds(VelocityCurve, st.floats(1, 90), st.floats(100, 400), st.floats(-1, 1)),
)
STRIKES = st.builds(
    NoteMeaning, PIECE, st.sampled_from(Zone), st.sampled_from(Articulation), st.one_of(st.none(), st.floats(0, 1))
)


@st.composite
def kits(draw: st.DrawFn) -> DeviceMap:
    base = draw(st.sampled_from(sorted(PRESETS)))
    ends = draw(st.lists(NUMBER, min_size=2, max_size=2, unique=True))
    steps = draw(st.one_of(st.just([]), st.lists(NUMBER, min_size=2, max_size=5, unique=True)))
    pair = st.lists(PIECE, min_size=2, max_size=2, unique=True)
    crosstalk = st.builds(lambda two, *rest: Crosstalk(two[0], two[1], *rest), pair, SHARE, NS, NS)
    pedal = PedalRange(ends[0], ends[1], draw(NUMBER), tuple(steps))
    return DeviceMap(
        "own",
        draw(st.text(st.characters(codec="utf-8", exclude_characters="\x7f"), max_size=20)),
        MappingProxyType(draw(st.dictionaries(NUMBER, STRIKES, max_size=20))),
        base=base,
        pedal=draw(st.sampled_from([None, pedal])),
        choke_from=draw(VELOCITY),
        choke_notes=MappingProxyType(draw(st.dictionaries(NUMBER, PIECE, max_size=3))),
        grab_velocity=draw(NUMBER),
        channel_notes=MappingProxyType(
            draw(st.dictionaries(st.tuples(st.integers(1, 16), NUMBER), STRIKES, max_size=3))
        ),
        position_controllers=MappingProxyType(
            draw(st.dictionaries(NUMBER, st.frozensets(PIECE, min_size=1, max_size=4), max_size=3))
        ),
        foot=Foot(draw(SHARE), draw(NS), draw(st.booleans())),
        pads=MappingProxyType(
            draw(
                st.dictionaries(PIECE, st.builds(Pad, VELOCITY, NS, st.one_of(st.none(), VELOCITY), CURVES), max_size=4)
            )
        ),
        crosstalk=tuple(draw(st.lists(crosstalk, max_size=3))),
    )


@given(kits())
def test_what_is_written_reads_back(kit: DeviceMap) -> None:
    assert parse_kit(kit_text(kit), "own") == kit


def test_the_kit_that_the_manual_shows_is_one(tmp_path: Path) -> None:
    manual = (Path(__file__).parents[3] / "docs" / "devices.md").read_text(encoding="utf-8")
    shown = manual.partition("```toml\n")[2].partition("```")[0]
    kit = read_kit(written(tmp_path, shown))
    assert (kit.title, kit.base, dict(kit.choke_notes)) == ("my TD-17", "roland-td-17", {60: Piece.CRASH_1})
    assert kit.crosstalk == (Crosstalk(Piece.KICK, Piece.SNARE, 0.3, 30 * NS_PER_MS, 5 * NS_PER_MS),)


def test_a_port_of_any_name_has_a_file_that_reads_back(tmp_path: Path) -> None:
    port = "ü\x7f\x1b/../" + "𝄞" * 320
    kit = DeviceMap(port, port, preset_named("general-midi").notes, base="general-midi")
    assert len(own_kit_path(port, tmp_path).name.encode()) < 256
    save_kit(kit, port, tmp_path)
    read = own_kit(port, tmp_path)
    assert read is not None
    assert read.title == port


def test_a_folder_that_cannot_be_looked_into_is_bad_input(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="name too long"):
        own_kit("TD-17", tmp_path / ("x" * 300))


@pytest.mark.parametrize("text", ["a = " + "[" * 5000, "a" * 100, "title = 3"])
def test_the_text_of_a_kit_in_a_capture_that_is_none_is_bad_input(text: str) -> None:
    with pytest.raises(BadInput):
        parse_kit(text, "taken")
