"""A battle in the terminal's loop: an engine in this process whose time passes while it is waited for."""

import signal
from pathlib import Path

import pytest

from station.core.clock import ManualClock
from station.core.errors import DeviceError
from station.core.units import NS_PER_S, ns_from_s
from station.devices.capture.capture import read_capture
from station.engine.messages import EngineEvent
from station.practice.battle.battle import Battle
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.records.battle_document import battle_document
from station.practice.battle.records.judge_battle_again import judge_battle_again
from station.practice.headless.battle_text import BattleText
from station.practice.headless.engine_here import EngineHere
from station.practice.headless.live_battle import BattleSetup, battle_live
from tests.fakes.played_battle import quarters

KIT = "TD-17"
SNARE = bytes.fromhex("99 26 64")
RULES = BattleRules(Ground(160.0), rounds=2)


class Waited(EngineHere):
    """Time passes while its events are waited for; a snare is struck every second, and it may die."""

    def __init__(self, dies_ns: int | None = None) -> None:
        super().__init__([KIT])
        self.clock = ManualClock()
        self._dies_ns, self._struck_ns = dies_ns, 0

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        if self._dies_ns is not None and self.now_ns >= self._dies_ns:
            raise DeviceError("the engine has ended")
        self.advance_to(self.now_ns + ns_from_s(wait_s))
        self.clock.advance_to(self.now_ns)
        if self.now_ns - self._struck_ns >= NS_PER_S:
            self._struck_ns = self.now_ns
            self.feed(KIT, SNARE, self.now_ns)
        return super().events()


def test_it_is_played_to_its_end_and_told(tmp_path: Path) -> None:
    engine, said = Waited(), list[str]()
    battle = Battle(RULES, quarters)
    live = battle_live(BattleSetup(engine, engine.clock, BattleText(said.append).show), battle, tmp_path / "capture")
    assert live.fault is None
    assert live.result.is_complete
    told = "".join(said)
    assert "round 1 of 2" in told
    assert "lives 2" in told
    assert battle_document(judge_battle_again(read_capture(tmp_path / "capture"))) == battle_document(live.result)


def test_whoever_ends_it_keeps_what_was_played(tmp_path: Path) -> None:
    engine = Waited()
    setup = BattleSetup(engine, engine.clock, lambda _: None)
    battle = Battle(RULES, quarters)

    def ends(shown: Battle) -> None:
        if (shown.at_ns or 0) > 4 * NS_PER_S:
            setup.asked.note(signal.SIGTERM)

    setup = BattleSetup(engine, engine.clock, ends, setup.telling, setup.asked)
    live = battle_live(setup, battle, tmp_path / "capture")
    assert not live.result.is_complete
    assert len(live.result.turns) == 2, "the bars last 1.5 s: a call and an answer were over"
    assert battle_document(judge_battle_again(read_capture(tmp_path / "capture"))) == battle_document(live.result)


def test_a_dead_engine_costs_nothing_that_was_played(tmp_path: Path) -> None:
    engine = Waited(dies_ns=5 * NS_PER_S)
    battle = Battle(RULES, quarters)
    live = battle_live(BattleSetup(engine, engine.clock, lambda _: None), battle, tmp_path / "capture")
    assert "ended" in str(live.fault)
    assert live.result.turns
    engine = Waited(dies_ns=0)
    with pytest.raises(DeviceError, match="ended"):
        battle_live(BattleSetup(engine, engine.clock, lambda _: None), Battle(RULES, quarters), tmp_path / "other")
