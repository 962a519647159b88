"""One pad learnt with one hit, its touch with ten: bytes by hand, notes and meanings from the General MIDI table."""

from dataclasses import replace
from types import MappingProxyType

import pytest

from station.core.errors import BadInput
from station.core.events import Hit
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone, word
from station.core.units import NS_PER_MS
from station.devices.mapping.device_file import parse_kit
from station.devices.mapping.device_map import Pad
from station.devices.mapping.device_writer import kit_text
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, preset_named
from station.devices.wizard.one_hit import PadListener, in_words, taught
from station.devices.wizard.pad_choices import PADS, pad_name, pad_named
from station.devices.wizard.velocity_learning import VelocityLearning

RIM = NoteMeaning(Piece.TOM_1, Zone.RIM)
MS = NS_PER_MS


def heard(*sent: tuple[float, str]) -> PadListener:
    ear = PadListener()
    ear.listen(on=True)
    for ms, data in sent:
        ear.feed(bytes.fromhex(data), round(ms * MS))
    return ear


def test_the_loudest_note_of_a_hit_is_the_pad_s() -> None:
    ear = heard((0, "99 24 10"), (2, "99 2f 60"), (3, "99 26 0a"))
    assert ear.hit(50 * MS) is None, "something louder may yet belong to it"
    assert ear.hit(71 * MS) == (10, 47)
    assert (ear.awaits, ear.hit(80 * MS)) == (False, None), "one hit is learnt, and no more"


def test_what_is_no_stroke_is_no_hit() -> None:
    ear = heard((0, "89 2f 40 99 2f 00 b9 04 7f f8 fe c9 05 a9 31 7f"))
    assert ear.hit(500 * MS) is None
    ear.feed(bytes.fromhex("99 2f"), 600 * MS)
    ear.feed(bytes.fromhex("40"), 601 * MS)
    assert ear.hit(700 * MS) == (10, 47), "bytes may come one by one"


def test_nothing_is_learnt_after_it_was_given_up() -> None:
    ear = heard((0, "99 2f 60"))
    ear.listen(on=False)
    assert ear.hit(500 * MS) is None


def test_notes_that_nobody_knows_are_listed_as_they_came() -> None:
    ear = heard((0, "99 26 40 99 02 40"), (500, "90 66 10"))
    assert ear.unknown(GENERAL_MIDI_PRESET) == [(10, 2), (1, 102)]
    assert ear.unknown(taught(GENERAL_MIDI_PRESET, (10, 2), RIM)) == [(1, 102)]


def test_a_note_is_the_pad_from_then_on_and_the_file_keeps_it() -> None:
    kit = taught(preset_named("roland-td-17"), (10, 99), RIM)
    again = parse_kit(kit_text(kit), "mine")
    assert again.base == "roland-td-17"
    assert [again.strike(channel, 99) for channel in (1, 10)] == [RIM, RIM]
    assert len(kit_text(kit).splitlines()) == 3, "what differs from the preset alone"


def test_a_number_that_comes_on_two_channels_is_learnt_for_one() -> None:
    ear = heard((0, "99 26 40"), (300, "92 26 60"))
    assert [ear.is_shared((3, 38)), ear.is_shared((10, 40))] == [True, False]
    kit = taught(GENERAL_MIDI_PRESET, (3, 38), NoteMeaning(Piece.COWBELL), is_shared=True)
    assert [kit.strike(channel, 38).piece for channel in (3, 10)] == [Piece.COWBELL, Piece.SNARE]
    assert taught(kit, (3, 38), RIM).strike(3, 38) == RIM, "what was learnt last holds"


def test_a_grab_s_note_can_become_a_pad() -> None:
    kit = replace(GENERAL_MIDI_PRESET, choke_notes=MappingProxyType({60: Piece.CRASH_1}))
    assert taught(kit, (10, 60), RIM).choke_notes == {}
    assert "it was a grab before" in in_words(kit, (10, 60), RIM)


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (38, "note 38 (channel 10) is the high tom, rim now; it was the snare, head before"),
        (2, "note 2 (channel 10) is the high tom, rim"),
    ],
)
def test_what_a_pad_meant_is_said(number: int, words: str) -> None:
    assert in_words(GENERAL_MIDI_PRESET, (10, number), RIM) == words
    assert in_words(taught(GENERAL_MIDI_PRESET, (10, number), RIM), (10, number), RIM).endswith(", as it was")


def test_every_pad_has_a_name_that_finds_it() -> None:
    names = [f"{word(piece)}/{zone}" for piece, zones in PADS.items() for zone in zones]
    assert len({pad_named(name) for name in names}) == len(names)
    assert set(PADS) == set(Piece) - {Piece.PERCUSSION}
    assert pad_named("snare/cross_stick") == NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK)
    assert [pad_name(pad_named(name)) for name in ("kick", "ride/bell", "hihat/half_open")] == [
        "kick",
        "ride, bell",
        "hi-hat, half open",
    ]
    for text in ("snaer", "snare/top", ""):
        with pytest.raises(BadInput):
            pad_named(text)


def strike(at_ms: float, velocity: int, piece: Piece = Piece.SNARE) -> Hit:
    return Hit(round(at_ms * MS), piece, Zone.HEAD, velocity)


def test_five_ghosts_then_five_accents() -> None:
    touch = VelocityLearning(Piece.SNARE)
    asked = []
    for k, velocity in enumerate((12, 10, 11, 14, 13, 90, 95, 92, 99, 91)):
        asked.append(touch.asks)
        touch.feed(strike(500 * k, velocity))
        touch.feed(strike(500 * k + 8, 3))  # a double trigger belongs to its stroke
        touch.feed(strike(500 * k + 9, 100, Piece.KICK))
    assert (asked[0], asked[7]) == (
        "snare: play five ghost strokes, 0 of 5",
        "snare: now five accents, 2 of 5",
    )
    assert touch.is_over
    kit = touch.learnt(replace(GENERAL_MIDI_PRESET, pads=MappingProxyType({Piece.SNARE: Pad(threshold=20)})))
    pad = kit.pad(Piece.SNARE)
    assert (pad.curve.table[12], pad.curve.table[92]) == (32, 116), "as lessons write ghosts and accents"
    assert pad.threshold == 5, "half of the softest ghost"
    assert parse_kit(kit_text(kit), "mine").pad(Piece.SNARE) == pad
