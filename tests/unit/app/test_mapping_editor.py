"""The devices page's editor: what it shows of a kit's bytes, what its rules hold back, and what is kept and told."""

from pathlib import Path

import pytest

from station.app.actions.equipment_actions import HoldBack, RevertRules, SetCurve, SetMask, SetShare, SetThreshold
from station.app.equipment.mapping_editor import MappingEditor
from station.app.equipment.mapping_view import PadStroke
from station.core.events import DeviceFound, DeviceLost
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.mapping.device_file import own_kit
from station.devices.mapping.device_map import DeviceMap, Pad
from station.devices.mapping.trigger_filter import HeldBack
from station.devices.mapping.velocity_curve import SHAPES
from station.devices.wizard.pad_choices import pad_named
from station.engine.messages import Command, RawBytes, ReloadDevice, WatchRawBytes
from station.gui.panels.devices.devices_panel import cells

KIT = "TD-17"
SNARE, KICK = "99 26", "99 24"


class Bench:
    """A desk, what it told the engine, and bytes for it."""

    def __init__(self, folder: Path) -> None:
        self.told: list[Command] = []
        self.folder = folder
        self.editor = MappingEditor(self.told.append, folder)
        self.editor.handle(DeviceFound(0, KIT))

    def strike(self, at_ms: int, text: str) -> None:
        self.editor.handle(RawBytes(at_ms * NS_PER_MS, KIT, bytes.fromhex(text)))


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "kits")


def test_bytes_are_asked_for_while_the_page_is_open(bench: Bench) -> None:
    for on in (True, True, False):
        bench.editor.listen(on)
    assert bench.told == [WatchRawBytes(True), WatchRawBytes(False)]


def test_a_stroke_has_its_line_and_its_bar(bench: Bench) -> None:
    bench.strike(100, f"{SNARE} 50")
    assert list(bench.editor.seen.strokes[Piece.SNARE]) == [PadStroke(0x50)]
    assert cells(bench.editor.seen.lines[-1]) == ("snare, head", "80", "", "99 26 50")
    assert bench.editor.pads == [Piece.SNARE]


def test_what_is_softer_than_the_threshold_is_hollow(bench: Bench) -> None:
    bench.editor.act(SetThreshold(Piece.SNARE, 20))
    bench.strike(100, f"{SNARE} 13")
    bench.strike(900, f"{SNARE} 14")
    assert list(bench.editor.seen.strokes[Piece.SNARE]) == [PadStroke(19, HeldBack.TOO_SOFT), PadStroke(20)]
    assert cells(bench.editor.seen.lines[-2]) == ("snare, head", "19", "too soft", "99 26 13")
    bench.strike(950, "c9 05")
    assert cells(bench.editor.seen.lines[-1]) == ("switch", "", "program=5", "c9 05")


def test_a_mask_holds_the_second_of_two_back(bench: Bench) -> None:
    bench.editor.act(SetMask(Piece.SNARE, 30))
    bench.strike(100, f"{SNARE} 60")
    bench.strike(125, f"{SNARE} 60")
    bench.strike(160, f"{SNARE} 60")
    assert [stroke.why for stroke in bench.editor.seen.strokes[Piece.SNARE]] == [None, HeldBack.DOUBLE, None]


def test_crosstalk_is_suspected_and_one_press_makes_a_rule(bench: Bench) -> None:
    bench.strike(100, f"{KICK} 64")
    bench.strike(104, f"{SNARE} 0a")
    (suspicion,) = bench.editor.seen.suspicions
    bench.editor.act(HoldBack(suspicion))
    assert not bench.editor.seen.suspicions
    (rule,) = bench.editor.kit.crosstalk
    assert (rule.source, rule.victim) == (Piece.KICK, Piece.SNARE)
    bench.strike(900, f"{KICK} 64")
    bench.strike(904, f"{SNARE} 0a")
    bench.editor.advance(2000 * NS_PER_MS)
    assert bench.editor.seen.strokes[Piece.SNARE][-1].why is HeldBack.CROSSTALK
    bench.editor.act(SetShare(Piece.KICK, Piece.SNARE, 0.0))
    assert bench.editor.kit.crosstalk == (), "a share of 0 takes the rule away"


def test_rules_are_on_trial_until_they_are_saved(bench: Bench) -> None:
    bench.editor.act(SetThreshold(Piece.SNARE, 20))
    changed = [bench.editor.is_changed]
    assert own_kit(KIT, bench.folder) is None
    bench.editor.save()
    kept = own_kit(KIT, bench.folder)
    assert kept is not None
    assert kept.pad(Piece.SNARE).threshold == 20
    assert bench.told == [ReloadDevice(KIT)], "the engine plays by it from now on"
    changed.append(bench.editor.is_changed)
    assert changed == [True, False]
    bench.editor.act(SetThreshold(Piece.SNARE, 50))
    bench.editor.act(RevertRules())
    assert bench.editor.kit.pad(Piece.SNARE).threshold == 20


def test_a_kit_that_comes_back_is_understood_as_it_was_kept(bench: Bench) -> None:
    bench.editor.act(SetMask(Piece.SNARE, 12))
    bench.editor.save()
    bench.editor.handle(DeviceLost(1, KIT))
    assert bench.editor.device == ""
    bench.editor.handle(DeviceFound(2, KIT))
    assert bench.editor.kit.pad(Piece.SNARE).mask_ns == 12 * NS_PER_MS


def test_a_file_at_fault_is_told_and_the_preset_holds(tmp_path: Path) -> None:
    (tmp_path / "kits").mkdir()
    (tmp_path / "kits" / f"{KIT}.toml").write_text("pads.snare = { threshold = 900 }\n")
    bench = Bench(tmp_path / "kits")
    assert "threshold" in bench.editor.seen.fault
    assert bench.editor.kit.pad(Piece.SNARE).threshold == 1


def kept(bench: Bench) -> DeviceMap:
    kit = own_kit(KIT, bench.folder)
    assert kit is not None
    return kit


def test_a_pad_is_learnt_with_one_hit_kept_at_once_and_undone(bench: Bench) -> None:
    bench.editor.act(SetThreshold(Piece.SNARE, 20))
    bench.editor.learn_pad(pad_named("tom_1/rim"))
    assert (bench.editor.learns, bench.editor.asks) == (True, "hit it now, once: high tom, rim")
    bench.strike(1000, f"{KICK} 14")
    bench.strike(1002, "99 43 60")
    bench.editor.advance(1300 * NS_PER_MS)
    assert not bench.editor.learns
    assert bench.editor.learnt == "note 67 (channel 10) is the high tom, rim", "the loudest of the notes of a hit"
    assert kept(bench).strike(10, 67) == pad_named("tom_1/rim")
    assert kept(bench).pad(Piece.SNARE).threshold == 1, "what is on trial is not kept with it"
    assert bench.editor.kit.pad(Piece.SNARE).threshold == 20, "nor lost by it"
    assert bench.told == [ReloadDevice(KIT)]
    bench.editor.undo()
    assert kept(bench).strike(10, 67).piece is Piece.PERCUSSION
    assert bench.editor.kit.pad(Piece.SNARE).threshold == 20
    assert not bench.editor.can_undo


def test_a_pad_that_meant_another_thing_is_said(bench: Bench) -> None:
    bench.editor.learn_pad(pad_named("crash_1/edge"))
    bench.strike(1000, f"{SNARE} 60")
    bench.editor.advance(1300 * NS_PER_MS)
    assert bench.editor.learnt == "note 38 (channel 10) is the crash, edge now; it was the snare, head before"


def test_what_is_not_known_gets_its_name(bench: Bench) -> None:
    bench.strike(100, "99 02 40")
    assert (bench.editor.unknown, bench.editor.pads) == ([(10, 2)], [])
    bench.editor.name((10, 2), pad_named("cowbell"))
    assert bench.editor.unknown == []
    bench.strike(900, "99 02 40")
    assert bench.editor.pads == [Piece.COWBELL]


@pytest.mark.parametrize("end", ["give_up", "listen", "lost"])
def test_nothing_is_learnt_that_was_given_up(bench: Bench, end: str) -> None:
    bench.editor.listen(on=True)
    bench.editor.learn_pad(pad_named("tom_1/rim"))
    bench.strike(1000, f"{SNARE} 60")
    match end:
        case "give_up":
            bench.editor.give_up()
        case "listen":
            bench.editor.listen(on=False)
        case _:
            bench.editor.handle(DeviceLost(1100 * NS_PER_MS, KIT))
    bench.editor.advance(2000 * NS_PER_MS)
    assert not bench.editor.learns
    assert own_kit(KIT, bench.folder) is None


def ten_strokes(bench: Bench, ghost: int, accent: int) -> None:
    for k in range(10):
        bench.strike(1000 + 500 * k, f"{SNARE} {(ghost if k < 5 else accent) + k % 5:02x}")
        bench.editor.advance((1400 + 500 * k) * NS_PER_MS)


def test_ghosts_below_the_threshold_teach_too(bench: Bench) -> None:
    bench.editor.act(SetThreshold(Piece.SNARE, 30))
    bench.editor.save()
    bench.editor.learn_velocity(Piece.SNARE)
    ten_strokes(bench, 18, 90)
    pad = kept(bench).pad(Piece.SNARE)
    assert (pad.curve.table[20], pad.curve.table[92], pad.threshold) == (32, 116, 9)
    bench.editor.undo()
    assert kept(bench).pad(Piece.SNARE) == Pad(threshold=30)


def test_strokes_that_are_all_alike_teach_nothing(bench: Bench) -> None:
    bench.editor.learn_velocity(Piece.SNARE)
    ten_strokes(bench, 60, 61)
    assert "told apart" in bench.editor.learnt
    assert (bench.editor.learns, bench.editor.can_undo, own_kit(KIT, bench.folder)) == (False, False, None)


def test_a_file_at_fault_is_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "kits").mkdir()
    path = tmp_path / "kits" / f"{KIT}.toml"
    path.write_text("pads.snare = { threshold = 900 }\n")
    bench = Bench(tmp_path / "kits")
    bench.editor.name((10, 2), pad_named("cowbell"))
    assert "has a fault" in bench.editor.learnt
    assert path.read_text() == "pads.snare = { threshold = 900 }\n"


def test_a_line_says_what_a_stroke_counts_as_where_that_is_not_what_was_sent(bench: Bench) -> None:
    bench.editor.act(SetCurve(Piece.SNARE, SHAPES["very_light"]))
    bench.strike(100, f"{SNARE} 20")
    bench.strike(400, f"{KICK} 20")
    assert [line.counts for line in bench.editor.seen.lines][-2:] == [63, None]
    assert bench.editor.seen.strokes[Piece.SNARE][-1].velocity == 32, "bars and dots stand where the pad was struck"
