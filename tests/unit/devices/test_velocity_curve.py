"""How loud strokes count: curves by hand, learnt ones at their medians; engine and replay."""

from dataclasses import replace
from pathlib import Path
from statistics import median
from types import MappingProxyType

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.events import Hit
from station.core.pieces import Dynamic, Piece
from station.core.units import NS_PER_MS
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_map import Crosstalk, DeviceMap, Pad
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.devices.mapping.velocity_curve import (
    ACCENT_COUNTS,
    AS_SENT,
    GHOST_COUNTS,
    LEAST_SPAN,
    LOUDEST_TO,
    SOFTEST_TO,
    VelocityCurve,
    counted,
    fitted,
    threshold_below,
)
from station.devices.mapping_commands import obey
from station.drills.grid.stroke_settings import Velocities
from station.engine.engine import Engine
from station.engine.messages import RecordCapture

KIT = "kit"
SNARE, KICK = 0x26, 0x24
curves = st.builds(
    lambda softest, span, bend: VelocityCurve(softest, softest + span, bend),
    st.floats(1, SOFTEST_TO),
    st.floats(LEAST_SPAN, LOUDEST_TO - SOFTEST_TO),
    st.floats(-1, 1),
)


def with_pads(**pads: Pad) -> DeviceMap:
    return replace(GENERAL_MIDI_PRESET, pads=MappingProxyType({Piece[name]: pad for name, pad in pads.items()}))


def strikes(*velocities: int, note: int = SNARE) -> list[tuple[int, bytes]]:
    """A stroke each 200 ms."""
    return [(200 * NS_PER_MS * k, bytes((0x99, note, velocity))) for k, velocity in enumerate(velocities, 1)]


def certain(kit: DeviceMap, sent: list[tuple[int, bytes]]) -> list[Hit]:
    bank = DecoderBank()
    bank.add(KIT, kit)
    events = [event for at_ns, data in sent for event in bank.feed(KIT, data, at_ns).certain] + bank.flush()
    return [event for event in events if isinstance(event, Hit)]


def test_what_is_not_set_counts_as_it_was_sent() -> None:
    assert AS_SENT.table == tuple(range(128))
    assert [hit.velocity for hit in certain(GENERAL_MIDI_PRESET, strikes(1, 64, 127))] == [1, 64, 127]


def test_the_nearest_curve_is_always_one_that_a_kit_file_may_hold() -> None:
    assert VelocityCurve.nearest(40.0, 30.0, 0.1) == VelocityCurve(40.0, 50.0, 0.1), "by hand: ten apart at the least"
    assert VelocityCurve.nearest(-3.0, 5.0, 7.0) == VelocityCurve(1.0, 20.0, 1.0)
    assert VelocityCurve.nearest(500.0, 900.0, -7.0) == VelocityCurve(100.0, 400.0, -1.0)
    assert VelocityCurve.nearest(8.0, 118.0, 0.3) == VelocityCurve(8.0, 118.0, 0.3)


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-3, 3))
def test_every_nearest_curve_is_obeyed(softest: float, loudest: float, bend: float) -> None:
    curve = VelocityCurve.nearest(softest, loudest, bend)
    kit = obey(GENERAL_MIDI_PRESET, f"curve snare {curve.softest} {curve.loudest} {curve.bend}")
    assert kit.pad(Piece.SNARE).curve == curve


def test_numbers_by_hand() -> None:
    straight = VelocityCurve(11.0, 111.0).table  # from 1 to 127 over 100 steps: 1.26 a step
    assert (straight[5], straight[11], straight[61], straight[111], straight[127]) == (1, 1, 64, 127, 127)
    light = VelocityCurve(bend=0.5).table  # a square root: a quarter of the way counts as half
    assert (light[0], light[1], light[127]) == (0, 1, 127)
    assert light[32] == 63  # 1 + 126 · √(31 / 126) = 63.498
    firm = VelocityCurve(bend=-0.5).table  # a square
    assert firm[64] == 32  # 1 + 126 · (63 / 126)² = 32.5 in exact numbers, halves to even


@given(curves)
def test_harder_never_counts_less_and_a_stroke_stays_one(curve: VelocityCurve) -> None:
    table = curve.table
    assert len(table) == 128
    assert list(table[1:]) == sorted(table[1:])
    assert min(table[1:]) >= 1
    assert max(table) <= 127


def test_what_a_kit_tells_finer_stays_between_its_neighbours() -> None:
    table = VelocityCurve(bend=0.5).table
    assert counted(table, 32, 0.0) == (table[32], 0.0)
    velocity, fraction = counted(table, 8, 0.5)
    assert velocity + fraction == pytest.approx((table[8] + table[9]) / 2)
    assert counted(table, 127, 0.9) == (127, 0.0)


@given(
    st.lists(st.integers(1, 60), min_size=5, max_size=5), st.integers(1, 66), st.lists(st.integers(0, 3), min_size=5)
)
def test_five_of_each_make_their_medians_count_as_lessons_write(ghosts: list[int], gap: int, more: list[int]) -> None:
    accents = [min(127, max(20, round(1.3 * max(ghosts)) + gap + slack)) for slack in more[:5]]
    curve = fitted(ghosts, accents)
    assert abs(curve.table[int(median(accents))] - ACCENT_COUNTS) <= 1
    if median(ghosts) >= 4:  # so soft that no curve of ours lifts it so far
        assert abs(curve.table[int(median(ghosts))] - GHOST_COUNTS) <= 2


def test_a_slip_among_five_changes_nothing() -> None:
    assert fitted([20, 22, 18, 110, 21], [100, 98, 30, 104, 101]) == fitted(
        [20, 22, 18, 60, 21], [100, 98, 40, 104, 101]
    )


@pytest.mark.parametrize(
    ("ghosts", "accents", "fault"),
    [
        ([60, 62, 80, 64, 70], [72, 60, 68, 75, 80], "told apart (ghosts 60–80, accents 60–80)"),
        ([100] * 5, [30] * 5, "told apart"),
        ([2] * 5, [9] * 5, "too soft to tell"),
    ],
)
def test_what_cannot_be_told_apart_is_refused(ghosts: list[int], accents: list[int], fault: str) -> None:
    with pytest.raises(BadInput, match="the velocity curve") as raised:
        fitted(ghosts, accents)
    assert fault in raised.value.fault


def test_ghosts_count_as_the_lessons_own() -> None:
    usual = Velocities().usual
    assert (usual[Dynamic.GHOST], usual[Dynamic.ACCENT]) == (GHOST_COUNTS, ACCENT_COUNTS)


def test_the_threshold_leaves_ghosts_alone() -> None:
    assert threshold_below(30, [14, 11, 20]) == 5
    assert threshold_below(3, [14, 11, 20]) == 3
    assert threshold_below(9, [1, 11]) == 1


def test_rules_go_by_what_was_sent_and_only_strokes_are_bent() -> None:
    light = VelocityCurve(bend=0.5)
    kit = replace(with_pads(SNARE=Pad(threshold=10, curve=light)), crosstalk=(Crosstalk(Piece.KICK, Piece.SNARE, 0.3),))
    sent = [
        *strikes(9, 10, 40),
        (700 * NS_PER_MS, bytes((0x99, KICK, 100))),
        (705 * NS_PER_MS, bytes((0x99, SNARE, 29))),
    ]
    heard = certain(kit, sent)
    assert [(hit.piece, hit.velocity) for hit in heard] == [
        (Piece.SNARE, light.table[10]),
        (Piece.SNARE, light.table[40]),
        (Piece.KICK, 100),
    ], "9 is softer than 10, and 29 is 0.3 times 100, though it would count as 60"


def test_a_capture_keeps_what_was_sent_and_counts_as_it_did(tmp_path: Path) -> None:
    engine = Engine()
    engine.use_preset(KIT, with_pads(SNARE=Pad(curve=VelocityCurve(4.0, 110.5, 0.3125))))
    engine.device_found(KIT, 0)
    engine.handle(RecordCapture(tmp_path / "take.drumcap"))
    for at_ns, data in strikes(8, 60, 120):
        engine.feed(KIT, data, at_ns)
    live = [event for event in engine.advance(NS_PER_MS * 2000) if isinstance(event, Hit)]
    engine.handle(RecordCapture(None))
    capture = read_capture(tmp_path / "take.drumcap")
    again = [event for event in replay(capture) if isinstance(event, Hit)]
    assert again == live
    assert [hit.velocity for hit in again] == [VelocityCurve(4.0, 110.5, 0.3125).table[v] for v in (8, 60, 120)]
    assert bytes((0x99, SNARE, 8)) in b"".join(record.payload for record in capture.records)
