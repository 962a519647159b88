"""Reports of game drums and foot switches, byte by byte as PlasticBand and USB HID 1.11 write them; see `hid_devices`.

Expected lanes are PlasticBand's tables, velocities reckoned by hand: a Rock Band byte is 255 less twice the velocity.
"""

import random

import pytest

from station.core.events import DeviceEvent, Hit, Switched
from station.core.pieces import Piece, word
from station.devices.decoders import DecoderBank
from station.devices.hid.hid_reports import HID_DEVICES, KEYS, LAYOUTS
from station.devices.mapping.device_file import parse_kit
from station.devices.mapping.device_writer import kit_text
from station.devices.mapping.game_presets import GAME_PRESETS
from station.devices.mapping.presets import preset_for, preset_named
from station.devices.message_tokens import tokens_for
from tests.fakes.hid_devices import drum_report, key_report

ROCK_BAND, PRO, HERO, PEDAL = (
    "Rock Band drums (PS3)",
    "Rock Band MIDI Pro (PS3)",
    "Guitar Hero drums (PS3)",
    "Foot switch (PCsensor)",
)
REST = drum_report()


def heard(device: str, *reports: bytes) -> list[DeviceEvent]:
    bank = DecoderBank()
    return [event for at_ns, report in enumerate(reports) for event in bank.feed(device, report, at_ns).certain]


def struck(device: str, *reports: bytes) -> list[tuple[str, int]]:
    return [(word(event.piece), event.velocity) for event in heard(device, *reports) if isinstance(event, Hit)]


@pytest.mark.parametrize(
    ("pressed", "at", "piece"),
    [
        ("circle l3", 12, "snare"),
        ("triangle l3", 11, "tom_1"),
        ("square l3", 14, "tom_2"),
        ("cross l3", 13, "floor_tom_1"),
        ("triangle r3 up", 11, "hihat"),
        ("square r3 down", 14, "ride"),
        ("cross r3", 13, "crash_1"),
    ],
)
def test_every_lane_of_a_rock_band_kit_with_its_velocity(pressed: str, at: int, piece: str) -> None:
    others = {f"b{byte}": 3 for byte in (11, 12, 13, 14)}
    for velocity in (1, 40, 64, 127):
        sent = drum_report(pressed, **{**others, f"b{at}": 255 - 2 * velocity})
        assert struck(ROCK_BAND, REST, sent) == [(piece, velocity)]


def test_nought_is_the_hardest_and_255_the_softest() -> None:
    hard, soft = drum_report("circle l3", b12=0), drum_report("circle l3", b12=255)
    assert struck(ROCK_BAND, hard, REST, soft) == [("snare", 127), ("snare", 1)]


@pytest.mark.parametrize(
    ("device", "pressed", "pieces"),
    [
        (ROCK_BAND, "l1", ["kick"]),
        (ROCK_BAND, "r1", ["kick"]),
        (PRO, "l1", ["kick"]),
        (PRO, "r1", ["hihat_pedal"]),
    ],
)
def test_pedals_say_nothing_of_how_hard(device: str, pressed: str, pieces: list[str]) -> None:
    assert struck(device, REST, drum_report(pressed)) == [(piece, 80) for piece in pieces]


@pytest.mark.parametrize(
    ("pressed", "pieces"),
    [
        ("circle triangle l3 r3 up", {"snare", "hihat"}),
        ("circle square l3 r3 down", {"snare", "ride"}),
        ("circle cross l3 r3", {"snare", "crash_1"}),
        ("triangle cross l3 r3", {"tom_1", "crash_1"}),
        ("triangle cross l3 r3 up", {"hihat", "floor_tom_1"}),
        ("square cross l3 r3 down", {"ride", "floor_tom_1"}),
        ("square triangle l3 r3 up", {"hihat", "tom_2"}),
        ("square triangle l3 r3 down", {"ride", "tom_1"}),
        ("circle triangle l3", {"snare", "tom_1"}),
        ("triangle square r3 up", {"hihat", "ride"}),
        ("triangle square r3 down", {"hihat", "ride"}),
        ("triangle l3 r3 up", {"tom_1", "hihat"}),
        ("cross l3 r3", {"floor_tom_1", "crash_1"}),
        ("circle triangle l3 r3 up l1 r1", {"snare", "hihat", "kick"}),
    ],
)
def test_what_is_struck_at_once_is_told_apart_by_flags_and_hat(pressed: str, pieces: set[str]) -> None:
    assert {piece for piece, _ in struck(ROCK_BAND, REST, drum_report(pressed))} == pieces


def test_a_cymbal_with_its_own_pad_has_its_velocity_in_the_red_byte() -> None:
    both = drum_report("square l3 r3 down", b14=255 - 2 * 100, b12=255 - 2 * 30)
    assert sorted(struck(ROCK_BAND, REST, both)) == [("ride", 30), ("tom_2", 100)]


def test_a_held_bit_is_struck_once_and_a_roll_each_time() -> None:
    down, up = drum_report("circle l3", b12=55), REST
    assert struck(ROCK_BAND, up, down, down, down, up) == [("snare", 100)]
    assert struck(ROCK_BAND, *[down, up] * 9) == [("snare", 100)] * 9


def test_strokes_that_overlap_are_each_struck_once() -> None:
    """The second comes while the first is held; then the first is let go."""
    reports = [drum_report(pressed) for pressed in ("circle l3", "circle l3 l1", "l1", "l1 circle l3", "circle l3")]
    assert [piece for piece, _ in struck(ROCK_BAND, *reports)] == ["snare", "kick", "snare"]


def test_a_cymbal_under_a_pad_that_is_held() -> None:
    reports = [drum_report("triangle l3", b11=55), drum_report("triangle l3 r3 up", b11=55, b12=155)]
    assert struck(ROCK_BAND, *reports) == [("tom_1", 100), ("hihat", 50)]


@pytest.mark.parametrize(
    "falling",
    [
        ["circle l3 r3 up", "circle l3"],  # the colour before the hat, as PlasticBand saw
        ["circle triangle l3 r3", "circle l3"],  # the hat first
        ["circle triangle r3 up"],  # the pad's flag first
        ["circle triangle l3 up", "circle l3"],  # the cymbal's flag first
        ["triangle r3 up", "triangle r3", "triangle"],
    ],
)
def test_bits_that_only_fall_strike_nothing(falling: list[str]) -> None:
    reports = [drum_report(pressed) for pressed in ("", "circle triangle l3 r3 up", *falling, "")]
    assert sorted(piece for piece, _ in struck(ROCK_BAND, *reports)) == ["hihat", "snare"]


def test_a_hat_that_is_late_makes_no_cymbal_of_the_next_pad() -> None:
    reports = [drum_report(p) for p in ("triangle r3 up", "r3 up", "circle l3 r3 up", "circle l3", "")]
    assert [piece for piece, _ in struck(ROCK_BAND, *reports)] == ["hihat", "snare"]


def test_a_first_generation_kit_tells_the_colour_alone() -> None:
    reports = [r for p in ("circle", "triangle", "square", "cross", "l1") for r in (drum_report(p), REST)]
    expected = [(piece, 80) for piece in ("snare", "hihat", "tom_1", "crash_1", "kick")]
    assert struck(ROCK_BAND, *reports) == struck("Rock Band drums 1 (Wii)", *reports) == expected


@pytest.mark.parametrize(
    ("pressed", "at", "piece"),
    [
        ("circle", 12, "snare"),
        ("triangle", 11, "hihat"),
        ("square", 14, "tom_1"),
        ("r1", 16, "crash_1"),
        ("cross", 13, "floor_tom_1"),
        ("l1", 15, "kick"),
    ],
)
def test_every_lane_of_a_guitar_hero_kit_with_its_velocity(pressed: str, at: int, piece: str) -> None:
    for velocity in (1, 64, 127):
        assert struck(HERO, REST, drum_report(pressed, **{f"b{at}": velocity})) == [(piece, velocity)]


def test_a_guitar_hero_stomp_is_told_from_a_kick_by_its_midi_message() -> None:
    """`99 64 1c`, PlasticBand's own example: note 100, velocity 28."""
    stomp = drum_report("l1", b15=28, b5=0x99, b19=0x64, b23=0x1C)
    assert struck(HERO, REST, stomp, REST, drum_report("l1", b15=28)) == [("hihat_pedal", 28), ("kick", 28)]


def test_raw_windows_puts_a_nought_before_a_report() -> None:
    assert struck(HERO, b"\0" + REST, b"\0" + drum_report("circle", b12=90)) == [("snare", 90)]


def test_start_and_select_are_switches_and_no_strokes() -> None:
    events = heard(ROCK_BAND, REST, drum_report("start"), drum_report("start"), REST, drum_report("select ps"))
    assert [event.switch for event in events if isinstance(event, Switched)] == ["button=10", "button=9", "button=13"]
    assert len(events) == 3


def test_a_foot_switch_says_which_key_goes_down() -> None:
    b, c = 5, 6
    reports = [key_report(b), key_report(b), key_report(b, c), key_report(c), key_report(), key_report(b)]
    events = heard(PEDAL, *reports, key_report(modifiers=1), key_report(1, 1, 1, 1, 1, 1), key_report(c)[1:])
    assert [event.switch for event in events if isinstance(event, Switched)] == [
        "key=5",
        "key=6",
        "key=5",
        "key=224",
        "key=6",
    ]


@pytest.mark.parametrize("device", [ROCK_BAND, PRO, HERO, PEDAL])
def test_reports_that_are_none_are_nothing_and_spoil_nothing(device: str) -> None:
    chance = random.Random(5)
    bank = DecoderBank()
    for size in [0, 1, 2, 3, 7, 10, 26, 29, 30, 64] * 20:
        assert bank.feed(device, chance.randbytes(size), 0).certain == []
    for size in [8, 9, 27, 28] * 200:
        for event in bank.feed(device, chance.randbytes(size), 0).certain:
            assert not isinstance(event, Hit) or 1 <= event.velocity <= 127
    bank.feed(device, key_report() if device == PEDAL else REST, 0)
    assert len(bank.feed(device, key_report(9) if device == PEDAL else drum_report("l1", b15=9), 0).certain) == 1


@pytest.mark.parametrize(
    ("device", "held", "more"),
    [
        (ROCK_BAND, drum_report("circle l3", b12=55), drum_report("circle l3 l1", b12=55)),
        (PEDAL, key_report(5), key_report(5, 6)),
    ],
)
def test_what_is_down_as_a_capture_begins_is_no_stroke_in_it(device: str, held: bytes, more: bytes) -> None:
    before, after = DecoderBank(), DecoderBank()
    before.feed(device, held, 0)
    assert after.feed(device, before.restart_state(device), 1).certain == []
    assert after.feed(device, more, 2) == before.feed(device, more, 2)
    assert DecoderBank().restart_state(device) == b""


def test_a_kit_plugged_in_again_is_read_afresh() -> None:
    bank, down = DecoderBank(), drum_report("circle l3")
    bank.feed(ROCK_BAND, down, 0)
    bank.lost(ROCK_BAND, 1)
    bank.found(ROCK_BAND, 2)
    assert len(bank.feed(ROCK_BAND, down, 3).certain) == 1


def test_every_known_device_has_a_preset_and_every_preset_a_table() -> None:
    assert {preset_for(device.title).name for device in HID_DEVICES.values()} == set(GAME_PRESETS)
    assert {preset.reports for preset in GAME_PRESETS.values()} == {*LAYOUTS, KEYS}


def test_every_note_that_a_table_can_send_means_a_piece() -> None:
    for preset in GAME_PRESETS.values():
        if preset.reports == KEYS:
            continue
        layout = LAYOUTS[preset.reports]
        coloured = (*layout.pads.values(), *layout.cymbals.values(), *layout.unflagged.values())
        notes = {lane.note for lane in (*layout.plain, *coloured, layout.stomp) if lane is not None}
        assert notes == set(preset.notes)


def test_a_kits_own_file_makes_another_piece_of_a_lane_and_keeps_how_it_is_read() -> None:
    own = parse_kit('base = "rock-band"\nnotes.48 = { piece = "cowbell" }', "mine")
    bank = DecoderBank()
    bank.add("mine", own)
    (hit,) = bank.feed("mine", drum_report("triangle l3"), 0).certain
    assert isinstance(hit, Hit)
    assert hit.piece is Piece.COWBELL
    assert parse_kit(kit_text(own), "mine").reports == own.reports == preset_named("rock-band").reports


def test_a_lane_is_learnt_by_the_note_that_it_goes_by() -> None:
    tokens = tokens_for(preset_for(HERO).reports)
    assert tokens.feed(drum_report("r1", b16=77)) == [bytes((0x99, 49, 77))]
