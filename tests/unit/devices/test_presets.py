"""Expected pieces are those that the modules' published note tables name."""

import pytest

from station.core.errors import BadInput
from station.core.note_map import strike_of
from station.core.pieces import Articulation, Piece, Zone
from station.devices.mapping.device_map import PedalRange
from station.devices.mapping.presets import PRESETS, preset_for, preset_named, stable_name


@pytest.mark.parametrize(
    ("port", "name"),
    [
        ("TD-17", "roland-td-17"),
        ("2- TD-17", "roland-td-17"),
        ("TD-27:TD-27 MIDI 1 24:0", "roland-td-27"),
        ("Alesis Nitro 28:0", "alesis-nitro"),
        ("ALESIS NITRO MAX", "alesis-nitro"),
        ("DTX502 Port1", "yamaha-dtx502"),
        ("TD-50", "general-midi"),
        ("USB Keyboard", "general-midi"),
        ("Alesis DM10 MkII", "alesis-dm10"),
        ("Edrumulus", "edrumulus"),
    ],
)
def test_a_port_suggests_its_preset(port: str, name: str) -> None:
    assert preset_for(port).name == name


@pytest.mark.parametrize(
    ("port", "name"),
    [
        ("2- TD-17", "TD-17"),
        ("TD-17", "TD-17"),
        ("Alesis Nitro:Alesis Nitro MIDI 1 28:0", "Alesis Nitro:Alesis Nitro MIDI 1"),
        ("fake kit:out", "fake kit:out"),
    ],
)
def test_a_stable_name_lacks_what_replugging_changes(port: str, name: str) -> None:
    assert stable_name(port) == name


@pytest.mark.parametrize(
    ("preset", "note", "piece", "zone"),
    [
        ("roland-td-17", 36, Piece.KICK, Zone.HEAD),
        ("roland-td-17", 40, Piece.SNARE, Zone.RIM),
        ("roland-td-17", 48, Piece.TOM_1, Zone.HEAD),
        ("roland-td-17", 50, Piece.TOM_1, Zone.RIM),
        ("roland-td-17", 45, Piece.TOM_2, Zone.HEAD),
        ("roland-td-17", 58, Piece.FLOOR_TOM_1, Zone.RIM),
        ("roland-td-17", 26, Piece.HIHAT, Zone.EDGE),
        ("roland-td-17", 55, Piece.CRASH_1, Zone.EDGE),
        ("roland-td-17", 52, Piece.CRASH_2, Zone.EDGE),
        ("roland-td-17", 59, Piece.RIDE, Zone.EDGE),
        ("alesis-nitro", 41, Piece.FLOOR_TOM_2, Zone.HEAD),
        ("alesis-nitro", 39, Piece.FLOOR_TOM_2, Zone.RIM),
        ("alesis-nitro", 23, Piece.HIHAT, Zone.BOW),
        ("alesis-crimson-2", 8, Piece.HIHAT, Zone.BOW),
        ("alesis-crimson-2", 82, Piece.TOM_1, Zone.RIM),
        ("yamaha-dtx502", 31, Piece.SNARE, Zone.HEAD),
        ("yamaha-dtx502", 49, Piece.CRASH_1, Zone.EDGE),
        ("yamaha-dtxplorer", 33, Piece.KICK, Zone.HEAD),
        ("yamaha-dtxplorer", 47, Piece.TOM_2, Zone.HEAD),
        ("alesis-dm10", 46, Piece.HIHAT, Zone.BOW),
        ("edrumulus", 22, Piece.HIHAT, Zone.EDGE),
        ("edrumulus", 55, Piece.CRASH_1, Zone.EDGE),
        ("edrumulus", 66, Piece.RIDE, Zone.EDGE),
        ("alesis-nitro", 50, Piece.TOM_1, Zone.RIM),
        ("alesis-nitro", 58, Piece.FLOOR_TOM_1, Zone.RIM),
        ("alesis-nitro", 49, Piece.CRASH_1, Zone.EDGE),
        ("alesis-nitro", 55, Piece.SPLASH, Zone.EDGE),  # no guide says otherwise: General MIDI
        ("yamaha-dtx502", 16, Piece.PERCUSSION, Zone.HEAD),
        ("roland-vqd106", 48, Piece.TOM_2, Zone.HEAD),  # General MIDI: no map of it was found
    ],
)
def test_the_tables_say_what_the_manuals_say(preset: str, note: int, piece: Piece, zone: Zone) -> None:
    strike = strike_of(note, preset_named(preset).notes)
    assert (strike.piece, strike.zone) == (piece, zone)


def test_a_foot_splash_is_one() -> None:
    assert strike_of(21, preset_named("alesis-nitro").notes).articulation is Articulation.SPLASH
    assert strike_of(85, preset_named("yamaha-dtxplorer").notes).articulation is Articulation.SPLASH


def test_presets_are_found_by_their_own_names() -> None:
    assert all(preset_named(name).name == name for name in PRESETS)


def test_an_unknown_preset_is_refused_with_the_nearest() -> None:
    with pytest.raises(BadInput, match="did you mean roland-td-"):
        preset_named("roland-td-99")


@pytest.mark.parametrize(("value", "openness"), [(0, 1.0), (45, 0.5), (90, 0.0), (127, 0.0)])
def test_a_pedal_range_is_linear_and_clipped(value: int, openness: float) -> None:
    assert PedalRange(0, 90).openness(value) == pytest.approx(openness)


def test_a_pedal_range_may_run_the_other_way() -> None:
    assert PedalRange(wide_open=127, shut=0).openness(127) == 1.0


def test_the_words_of_a_port_lead_to_one_preset_alone() -> None:
    for preset in PRESETS.values():
        for words in preset.port_words:
            assert preset_for(f"2- {words.upper()} MIDI 1 20:0") is preset


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("roland-td-17", {0: 1.0, 127: 0.0}),
        ("roland-td-11", {0: 1.0, 45: 0.5, 90: 0.0, 120: 0.0}),
        ("roland-vqd106", {0: 1.0, 90: 0.0}),
        ("roland-td-07", {0: 1.0, 90: 0.0}),
        ("edrumulus", {0: 1.0, 50: 0.5, 100: 0.0, 127: 0.0}),
        ("yamaha-dtxplorer", {0: 1.0, 54: 0.5, 58: 0.5, 127: 0.0}),
    ],
)
def test_pedals_are_as_their_makers_and_players_say(name: str, values: dict[int, float]) -> None:
    pedal = preset_named(name).pedal
    assert pedal is not None
    assert {value: pedal.openness(value) for value in values} == values


def test_a_module_of_which_nothing_else_is_known_has_no_rules() -> None:
    assert not any(preset.has_rules for preset in PRESETS.values())
