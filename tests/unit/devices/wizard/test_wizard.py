"""The wizard with fake modules that send what makers' tables say; expected kits are how the fakes are made."""

import pytest

from station.core.events import Choke, DeviceEvent, Hit
from station.core.note_map import NoteMeaning, strike_of
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS, ns_from_ms
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_file import parse_kit
from station.devices.mapping.device_map import DeviceMap, PedalRange
from station.devices.mapping.device_writer import kit_text
from station.devices.mapping.presets import preset_named
from station.devices.wizard.wizard import Wizard
from station.devices.wizard.wizard_steps import STEPS
from tests.fakes.hid_devices import drum_report
from tests.fakes.module import FakeModule, Sent
from tests.unit.devices.wizard.drummer import answer, teach

TD17 = {
    **{"kick": 36, "snare": 38, "snare rim": 40, "cross-stick": 37, "tom_1": 48, "tom_1 rim": 50, "tom_2": 45},
    **{"tom_2 rim": 47, "floor_tom_1": 43, "floor_tom_1 rim": 58, "open": 46, "open edge": 26, "closed": 42},
    **{"closed edge": 22, "half": 46, "stomp": 44, "crash_1": 49, "crash_1 edge": 55, "crash_2": 57},
    **{"crash_2 edge": 52, "ride": 51, "ride edge": 59, "ride bell": 53},
}
NITRO = {
    **{"kick": 36, "snare": 38, "snare rim": 40, "tom_1": 48, "tom_2": 45, "floor_tom_1": 43, "floor_tom_2": 41},
    **{"open": 46, "half": 23, "closed": 42, "stomp": 44, "splash": 21, "crash_1": 49, "crash_2": 57, "ride": 51},
}
DTXPLORER = {
    **{"kick": 33, "snare": 31, "snare rim": 34, "cross-stick": 37, "tom_1": 48, "tom_2": 47, "floor_tom_1": 43},
    **{"open": 46, "half": 46, "closed": 42, "stomp": 44, "splash": 85, "ride": 51, "ride edge": 52},
    **{"crash_1": 49, "crash_2": 57},
}
CRIMSON = {
    **{"kick": 36, "snare": 38, "snare rim": 40, "tom_1": 50, "tom_1 rim": 82, "tom_2": 47, "tom_2 rim": 80},
    **{"floor_tom_1": 43, "floor_tom_1 rim": 75, "floor_tom_2": 41, "floor_tom_2 rim": 73, "open": 8, "half": 8},
    **{"closed": 8, "stomp": 22, "splash": 23, "crash_1": 49, "crash_2": 57, "ride": 51},
}


def learned(module: FakeModule, port: str = "USB Kit") -> DeviceMap:
    return teach(module, port).learned().kit


def played(kit: DeviceMap, sent: list[Sent]) -> list[DeviceEvent]:
    bank, told = DecoderBank(), list[DeviceEvent]()
    bank.add("kit", kit)
    for ms, data in sorted(sent):
        told += bank.feed("kit", data, ns_from_ms(ms)).certain
    return told + bank.flush()


def hits(kit: DeviceMap, sent: list[Sent]) -> list[tuple[Piece, int]]:
    return [(event.piece, event.velocity) for event in played(kit, sent) if isinstance(event, Hit)]


@pytest.mark.parametrize(
    ("notes", "controller", "places", "base"),
    [
        (TD17, 4, (), "roland-td-17"),
        (NITRO, None, (), "alesis-nitro"),
        (DTXPLORER, 4, (0, 56, 127), "yamaha-dtxplorer"),
        (CRIMSON, 4, (), "alesis-crimson-2"),
    ],
)
def test_a_module_is_known_by_what_it_sends_alone(
    notes: dict[str, int], controller: int | None, places: tuple[int, ...], base: str
) -> None:
    result = teach(FakeModule(notes, controller, places=places)).learned()
    assert result.guess.preset.name == base
    assert result.guess.differing == 0
    expected = preset_named(base)
    strokes = [number for name, number in notes.items() if name != "half"]
    assert {n: strike_of(n, result.kit.notes) for n in strokes} == {n: strike_of(n, expected.notes) for n in strokes}
    assert result.kit.crosstalk == ()
    assert not any(pad.mask_ns for pad in result.kit.pads.values())


def test_what_differs_from_the_preset_is_learned() -> None:
    result = teach(FakeModule({**TD17, "ride edge": 66, "tom_2": 61}), "TD-17").learned()
    assert result.guess.preset.name == "roland-td-17"
    assert result.guess.differing == 2
    assert result.kit.notes[66] == NoteMeaning(Piece.RIDE, Zone.EDGE)
    assert result.kit.notes[61] == NoteMeaning(Piece.TOM_2)
    assert {"second tom, on the head: note 61", "ride, on the edge: note 66"} <= set(result.findings)
    assert parse_kit(kit_text(result.kit), result.kit.name) == result.kit


def test_the_ports_name_decides_between_modules_that_send_the_same() -> None:
    only = {"kick": 36, "snare": 38, "tom_1": 48, "tom_2": 45, "open": 46, "closed": 42}
    assert teach(FakeModule(only), "TD-27:TD-27 MIDI 1 24:0").learned().kit.base == "roland-td-27"
    assert teach(FakeModule(only), "Alesis Nitro 28:0").learned().kit.base == "alesis-nitro"


def test_numbers_that_no_preset_has_are_learned_all_the_same() -> None:
    odd = {
        "kick": 1,
        "snare": 2,
        "open": 3,
        "closed": 4,
        "half": 5,
        "stomp": 6,
        "crash_1": 7,
        "ride": 9,
        "ride bell": 10,
    }
    notes = learned(FakeModule(odd)).notes
    assert notes[1] == NoteMeaning(Piece.KICK)
    assert notes[3] == NoteMeaning(Piece.HIHAT, Zone.BOW, openness=1.0)
    assert notes[4] == NoteMeaning(Piece.HIHAT, Zone.BOW, openness=0.0)
    assert notes[5] == NoteMeaning(Piece.HIHAT, Zone.BOW, openness=0.5)
    assert notes[6] == NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0)
    assert notes[10] == NoteMeaning(Piece.RIDE, Zone.BELL)


# --- the hi-hat ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("module", "pedal"),
    [
        (FakeModule(TD17), PedalRange()),
        (FakeModule(TD17, pedal=(0, 90)), PedalRange(0, 90)),
        (FakeModule(TD17, pedal=(127, 0)), PedalRange(127, 0)),
        (FakeModule(TD17, controller=19), PedalRange(controller=19)),
        (FakeModule(TD17, places=(0, 56, 127)), PedalRange(steps=(0, 56, 127))),
        (FakeModule(TD17, pedal=(127, 0), places=(127, 0)), PedalRange(127, 0, steps=(127, 0))),
    ],
)
def test_the_pedals_way_is_found(module: FakeModule, pedal: PedalRange) -> None:
    assert learned(module, "TD-17").pedal == pedal


def test_one_note_for_open_and_closed_tells_neither() -> None:
    kit = learned(FakeModule({"kick": 36, "snare": 38, "open": 46, "closed": 46, "half": 46}))
    assert kit.notes[46].openness is None


def test_a_stomp_without_a_note_is_read_off_the_pedal() -> None:
    notes = {name: number for name, number in TD17.items() if name != "stomp"}
    module = FakeModule(notes)
    kit = learned(module)
    assert kit.foot.by_controller
    stomps = [event for event in played(kit, module.stomp(90, 500)) if isinstance(event, Hit)]
    assert [stomp.piece for stomp in stomps] == [Piece.HIHAT_PEDAL]


def test_hats_that_a_stomp_fires_do_not_count() -> None:
    module = FakeModule(TD17, stomp_fires=(46,))
    kit = learned(module)
    assert hits(kit, module.stomp(90, 500)) == [(Piece.HIHAT_PEDAL, 90)]
    assert hits(kit, module.strike("open", 80, 500, 1.0)) == [(Piece.HIHAT, 80)]


def test_stomps_that_fire_the_hat_and_have_no_note_are_read_off_the_pedal() -> None:
    notes = {name: number for name, number in TD17.items() if name not in ("splash", "half")}
    module = FakeModule({**notes, "stomp": 42})
    kit = learned(module)
    assert kit.foot.by_controller
    assert kit.notes[42].piece is Piece.HIHAT
    assert [piece for piece, _ in hits(kit, module.stomp(60, 500))] == [Piece.HIHAT_PEDAL]
    assert hits(kit, module.strike("closed", 60, 500, 0.0)) == [(Piece.HIHAT, 60)]


def test_stomps_that_half_open_playing_fires_do_not_count() -> None:
    module = FakeModule(TD17, crosstalk={"half": [(44, 0.3, 15)]})
    kit = learned(module)
    assert hits(kit, module.strike("half", 100, 500, 0.5)) == [(Piece.HIHAT, 100)]
    assert (Piece.HIHAT_PEDAL, 90) in hits(kit, module.strike("half", 100, 500, 0.5) + module.stomp(90, 540))


def test_a_splash_that_sounds_like_a_stomp_is_told_by_the_pedal() -> None:
    module = FakeModule(TD17)
    kit = learned(module)
    for splash, articulation in ((True, Articulation.SPLASH), (False, Articulation.CHICK)):
        (hit,) = [event for event in played(kit, module.stomp(90, 500, splash)) if isinstance(event, Hit)]
        assert hit.articulation is articulation


# --- ghosts ----------------------------------------------------------------------------------------------------------


def test_crosstalk_before_and_after_its_stroke_is_found() -> None:
    module = FakeModule(TD17, crosstalk={"kick": [(38, 0.25, -3.0), (43, 0.15, 4.0)]})
    kit = learned(module)
    assert {(rule.source, rule.victim) for rule in kit.crosstalk} == {
        (Piece.KICK, Piece.SNARE),
        (Piece.KICK, Piece.FLOOR_TOM_1),
    }
    assert hits(kit, module.strike("kick", 120, 500)) == [(Piece.KICK, 120)]
    both = module.strike("kick", 100, 500) + module.strike("snare", 100, 502)
    assert sorted(hits(kit, both)) == [(Piece.KICK, 100), (Piece.SNARE, 100)]


def test_double_triggers_are_masked_and_rolls_are_not() -> None:
    module = FakeModule(TD17, doubles={"snare": 8.0})
    kit = learned(module)
    roll = [sent for stroke in range(10) for sent in module.strike("snare", 90, 500 + 40 * stroke)]
    assert hits(kit, roll) == [(Piece.SNARE, 90)] * 10
    assert kit.pad(Piece.TOM_1).mask_ns == 0


def test_the_softest_stroke_of_each_pad_is_measured() -> None:
    kit = learned(FakeModule(TD17, least=11, doubles={"snare": 8.0}))
    assert kit.pad(Piece.SNARE).least_velocity == 11
    assert kit.pad(Piece.KICK).least_velocity == 11


def test_a_position_that_comes_before_its_notes_is_found() -> None:
    kit = learned(FakeModule(TD17, position={"snare": 18, "ride": 17}), "TD-17")
    assert dict(kit.position_controllers) == {18: {Piece.SNARE}, 17: {Piece.RIDE}}


# --- grabs -----------------------------------------------------------------------------------------------------------


def test_a_note_that_means_a_grab_is_found() -> None:
    module = FakeModule(TD17, grab=lambda note, ms: [(ms, bytes((0x99, note + 40, 64)))])
    kit = learned(module)
    assert dict(kit.choke_notes) == {89: Piece.CRASH_1, 97: Piece.CRASH_2, 91: Piece.RIDE}
    assert [type(event) for event in played(kit, module.grabbed("ride", 500))] == [Hit, Choke]


def test_a_stroke_of_the_grabbing_hand_does_not_count() -> None:
    module = FakeModule(
        TD17, grab=lambda note, ms: [(ms - 10, bytes((0x99, note, 20))), (ms, bytes((0xA9, note, 127)))]
    )
    kit = learned(module)
    assert [type(event) for event in played(kit, module.grabbed("crash_1", 500))] == [Hit, Choke]
    assert hits(kit, module.strike("crash_1", 15, 900)) == [(Piece.CRASH_1, 15)]


# --- the state machine -----------------------------------------------------------------------------------------------


def strike(wizard: Wizard, number: int, ms: int, times: int = 6) -> int:
    for stroke in range(times):
        wizard.feed(bytes((0x99, number, 100 - 10 * stroke)), (ms + 300 * stroke) * NS_PER_MS)
    wizard.advance((ms + 300 * times) * NS_PER_MS)
    return ms + 300 * times + 1000


def test_a_step_asks_for_firm_strokes_then_for_soft_ones() -> None:
    wizard = Wizard("kit")
    assert wizard.view().text == "kick: 3 firm single strokes, with a pause"
    ms = strike(wizard, 36, 0, 3)
    assert (wizard.view().done, wizard.view().needed) == (3, 6)
    assert "softly" in wizard.view().text
    strike(wizard, 36, ms, 3)
    assert wizard.view().text.startswith("snare, on the head")


def test_skip_leaves_a_step_and_back_asks_the_last_one_anew() -> None:
    wizard = Wizard("kit")
    ms = strike(wizard, 36, 0)
    wizard.back()
    assert wizard.view().text.startswith("kick")
    assert wizard.learned().guess.agreeing == 0
    ms = strike(wizard, 35, ms)
    wizard.skip()
    assert wizard.view().step == 3
    assert wizard.learned().guess.agreeing == 1
    wizard.finish()
    assert wizard.over
    assert wizard.view().text == ""


def test_a_pad_that_sends_nothing_soft_is_learned_all_the_same() -> None:
    wizard = Wizard("kit")
    strike(wizard, 61, 0, 3)
    wizard.skip()
    assert wizard.view().step == 2
    assert wizard.learned().kit.notes[61] == NoteMeaning(Piece.KICK)


def test_a_pad_that_was_another_before_is_told_and_asked_again() -> None:
    wizard = Wizard("kit")
    strike(wizard, 36, strike(wizard, 36, 0), 2)
    assert wizard.view().step == 2
    assert "pad of: kick" in wizard.view().hint


def test_when_all_agrees_the_rest_may_be_left_to_the_preset() -> None:
    wizard, ms = Wizard("TD-17"), 1000.0
    for step in STEPS[:8]:
        assert "finish" not in wizard.view().hint or wizard.view().step > 5
        for at_ms, data in answer(FakeModule(TD17), step, ms):
            wizard.feed(data, ns_from_ms(at_ms))
        ms += 4000
        wizard.advance(ns_from_ms(ms))
        ms += 1000
    assert wizard.view().hint == "all is as on a Roland TD-17: the rest can be left to that (finish)"


def test_without_an_answer_nothing_is_learned() -> None:
    wizard = Wizard("TD-17")
    wizard.finish()
    kit = wizard.learned().kit
    assert kit.notes == preset_named("roland-td-17").notes
    assert kit.pedal == preset_named("roland-td-17").pedal


def test_game_drums_are_learned_from_their_reports_and_stay_game_drums() -> None:
    """The kick's bit is L1, its velocity byte 15 (PlasticBand)."""
    wizard, ms = Wizard("Guitar Hero drums (PS3)"), 1000
    for velocity in (110, 100, 90, 30, 25, 20):
        wizard.feed(drum_report("l1", b15=velocity), ms * NS_PER_MS)
        wizard.feed(drum_report(), (ms + 20) * NS_PER_MS)
        ms += 300
    wizard.advance((ms + 1000) * NS_PER_MS)
    assert wizard.view().step == 2
    kit = wizard.learned().kit
    assert (kit.base, kit.reports, kit.pad(Piece.KICK).least_velocity) == ("guitar-hero", "guitar-hero", 20)
