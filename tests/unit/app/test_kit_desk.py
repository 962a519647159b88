"""The devices page's desk: what it shows of a kit's bytes, what its rules hold back, and what is kept and told."""

from pathlib import Path

import pytest

from station.app.kit_desk import KitDesk, Stroke
from station.app.panels.devices import cells
from station.core.events import DeviceFound, DeviceLost
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.guard import Why
from station.devices.kit_file import own_kit
from station.engine.messages import Command, Eavesdrop, Overheard, TakeKit

KIT = "TD-17"
SNARE, KICK = "99 26", "99 24"


class Bench:
    """A desk, what it told the engine, and bytes for it."""

    def __init__(self, folder: Path) -> None:
        self.told: list[Command] = []
        self.folder = folder
        self.desk = KitDesk(self.told.append, folder)
        self.desk.take(DeviceFound(0, KIT))

    def strike(self, at_ms: int, text: str) -> None:
        self.desk.take(Overheard(at_ms * NS_PER_MS, KIT, bytes.fromhex(text)))


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "kits")


def test_bytes_are_asked_for_while_the_page_is_open(bench: Bench) -> None:
    for on in (True, True, False):
        bench.desk.listen(on)
    assert bench.told == [Eavesdrop(True), Eavesdrop(False)]


def test_a_stroke_has_its_line_and_its_bar(bench: Bench) -> None:
    bench.strike(100, f"{SNARE} 50")
    assert list(bench.desk.seen.strokes[Piece.SNARE]) == [Stroke(0x50)]
    assert cells(bench.desk.seen.lines[-1]) == ("snare, head", "80", "", "99 26 50")
    assert bench.desk.pads == [Piece.SNARE]


def test_what_is_softer_than_the_threshold_is_hollow(bench: Bench) -> None:
    bench.desk.threshold(Piece.SNARE, 20)
    bench.strike(100, f"{SNARE} 13")
    bench.strike(900, f"{SNARE} 14")
    assert list(bench.desk.seen.strokes[Piece.SNARE]) == [Stroke(19, Why.TOO_SOFT), Stroke(20)]
    assert cells(bench.desk.seen.lines[-2]) == ("snare, head", "19", "too soft", "99 26 13")
    bench.strike(950, "c9 05")
    assert cells(bench.desk.seen.lines[-1]) == ("switch", "", "program=5", "c9 05")


def test_a_mask_holds_the_second_of_two_back(bench: Bench) -> None:
    bench.desk.mask(Piece.SNARE, 30)
    bench.strike(100, f"{SNARE} 60")
    bench.strike(125, f"{SNARE} 60")
    bench.strike(160, f"{SNARE} 60")
    assert [stroke.why for stroke in bench.desk.seen.strokes[Piece.SNARE]] == [None, Why.DOUBLE, None]


def test_crosstalk_is_suspected_and_one_press_makes_a_rule(bench: Bench) -> None:
    bench.strike(100, f"{KICK} 64")
    bench.strike(104, f"{SNARE} 0a")
    (suspicion,) = bench.desk.seen.suspicions
    bench.desk.hold_back(suspicion)
    assert not bench.desk.seen.suspicions
    (rule,) = bench.desk.kit.crosstalk
    assert (rule.source, rule.victim) == (Piece.KICK, Piece.SNARE)
    bench.strike(900, f"{KICK} 64")
    bench.strike(904, f"{SNARE} 0a")
    bench.desk.advance(2000 * NS_PER_MS)
    assert bench.desk.seen.strokes[Piece.SNARE][-1].why is Why.CROSSTALK
    bench.desk.share(Piece.KICK, Piece.SNARE, 0.0)
    assert bench.desk.kit.crosstalk == (), "a share of 0 takes the rule away"


def test_rules_are_on_trial_until_they_are_saved(bench: Bench) -> None:
    bench.desk.threshold(Piece.SNARE, 20)
    changed = [bench.desk.is_changed]
    assert own_kit(KIT, bench.folder) is None
    bench.desk.save()
    kept = own_kit(KIT, bench.folder)
    assert kept is not None
    assert kept.pad(Piece.SNARE).threshold == 20
    assert bench.told == [TakeKit(KIT)], "the engine plays by it from now on"
    changed.append(bench.desk.is_changed)
    assert changed == [True, False]
    bench.desk.threshold(Piece.SNARE, 50)
    bench.desk.back()
    assert bench.desk.kit.pad(Piece.SNARE).threshold == 20


def test_a_kit_that_comes_back_is_understood_as_it_was_kept(bench: Bench) -> None:
    bench.desk.mask(Piece.SNARE, 12)
    bench.desk.save()
    bench.desk.take(DeviceLost(1, KIT))
    assert bench.desk.device == ""
    bench.desk.take(DeviceFound(2, KIT))
    assert bench.desk.kit.pad(Piece.SNARE).mask_ns == 12 * NS_PER_MS


def test_a_file_at_fault_is_told_and_the_preset_holds(tmp_path: Path) -> None:
    (tmp_path / "kits").mkdir()
    (tmp_path / "kits" / f"{KIT}.toml").write_text("pads.snare = { threshold = 900 }\n")
    bench = Bench(tmp_path / "kits")
    assert "threshold" in bench.desk.seen.fault
    assert bench.desk.kit.pad(Piece.SNARE).threshold == 1
