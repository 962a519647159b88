"""A live battle in the terminal: the engine's process plays and hears, every stroke is shown as it is judged."""

from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path

from station.cli.console import say
from station.core.clock import MonotonicClock
from station.core.errors import DeviceError
from station.core.measured_latency import load_calibration
from station.core.settings import Settings
from station.devices.device_ports import no_device
from station.engine.engine_config import EngineConfig
from station.engine.supervisor import EngineSupervisor
from station.practice.battle.battle import Battle
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.battle_words import LANDING_WORDS
from station.practice.battle.drummed import drummed
from station.practice.headless.battle_text import BattleText
from station.practice.headless.end_signals import end_asked
from station.practice.headless.guarded_output import GuardedOutput
from station.practice.headless.live import wait_for_kits
from station.practice.headless.live_battle import BattleSetup, LiveBattle, battle_live
from station.practice.headless.live_text import LEGEND, level_words
from station.practice.session.device_latency import latency_of

KIT_WAIT_S = 5.0
"""How long to look for kits before giving up (as in practice)."""


def how_it_counts(rules: BattleRules) -> str:
    """What to know before the count-in, in a few lines."""
    lines = [level_words(rules.level), LEGEND]
    return "\n".join([*lines, LANDING_WORDS] if rules.mode is BattleMode.IMPROVISE else lines)


def battle_in_terminal(rules: BattleRules, settings: Settings, capture: Path, until_saved: ExitStack) -> LiveBattle:
    """Play a battle on the kits that are there.

    From the count-in on nothing ends the program before the battle is kept: `until_saved` is left then. Raises
    `DeviceError` where a kit is missing, or where the engine dies before it began.
    """
    battle = Battle(rules, drummed, latency_of(settings, load_calibration()))
    text, telling, clock = BattleText(partial(say, end="")), GuardedOutput(), MonotonicClock()
    config = EngineConfig.from_settings(settings)
    telling.attempt(say, "looking for a kit and a sound output …")
    with EngineSupervisor(config) as engine:
        wait_for_kits(engine, battle, clock, KIT_WAIT_S, len(config.kits))
        if not battle.heard.devices:
            raise DeviceError(f"{no_device(config.kits)}; station battle --virtual-student intermediate needs none")
        absent = [one for one in rules.players if not any(map(one.plays_on, battle.heard.devices))]
        if absent:
            here = ", ".join(battle.heard.devices)
            raise DeviceError(f"{absent[0].name} has no kit: {absent[0].device!r} is not among {here}")
        telling.attempt(say, f"\n{how_it_counts(rules)}", end="")
        setup = BattleSetup(engine, clock, text.show, telling)
        setup = replace(setup, asked=until_saved.enter_context(end_asked()))
        return battle_live(setup, battle, capture)
