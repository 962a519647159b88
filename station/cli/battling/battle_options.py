"""The options of `station battle`, and the rules that they make."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from station.cli.battling.battle_video import FilmOptions
from station.cli.battling.network_options import NetworkOptions
from station.cli.options.device_option import devices_option
from station.cli.options.option_fields import (
    choice,
    flag,
    group,
    number,
    option,
    repeated,
    switch,
    unread,
    whole_number,
)
from station.cli.options.sound_options import SoundOptions
from station.cli.options.virtual_students import virtual_name
from station.core.errors import BadInput
from station.core.settings import Settings, setting_source
from station.practice.battle.battle_rules import (
    TURN_BARS,
    USUAL_BARS,
    USUAL_LIVES,
    USUAL_ROUNDS,
    USUAL_TARGET,
    BattleMode,
    BattleRules,
)
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.opponents.opponent import OPPONENTS, USUAL_OPPONENT, find_opponent
from station.practice.battle.people.player import Player, virtual_device
from station.practice.battle.records.earlier_rounds import after_earlier
from station.practice.battle.repeating.answer_marks import ACCURACY_WORDS
from station.practice.battle.repeating.demands import MOST_STEP
from station.practice.battle.repeating.staircase import FIRST_STEPS
from station.practice.history.student_history import StudentHistory
from station.practice.records.memory import LevelMemory
from station.practice.session.cues.click_options import parse_click
from station.scoring.matching.hit_windows import OUR_LEVELS, Level

_MODES: Mapping[str, BattleMode] = MappingProxyType({mode.value: mode for mode in BattleMode})
_FEELS: Mapping[str, Feel] = MappingProxyType({feel.value: feel for feel in Feel})
_UNITS = (2, 4, 8, 16)
_MOST_BEATS = 16
"""Of a bar (our choice: no groove here has more)."""


def _meter(text: str) -> tuple[int, int]:
    beats, _, unit = text.partition("/")
    try:
        meter = int(beats), int(unit)
    except ValueError:
        raise unread("a meter such as 4/4", text) from None
    if not 1 <= meter[0] <= _MOST_BEATS or meter[1] not in _UNITS:
        raise unread("a meter such as 4/4 or 7/8", text)
    return meter


def _percent(text: str) -> float:
    return number(text.removesuffix("%").strip()) / 100.0


def _players(text: str) -> tuple[Player, ...]:
    pairs = (part.partition("=") for part in text.split(","))
    return tuple(Player(name.strip(), device.strip()) for name, _, device in pairs)


def _opponents() -> str:
    return "; ".join(f"{one.name}: {one.title[0].lower()}{one.title[1:]}" for one in OPPONENTS.values())


@dataclass(frozen=True, slots=True, kw_only=True)
class BattleOptions:
    """What is played, against whom, and what is left of it; None leaves the choice to the opponent or the settings."""

    mode: BattleMode = choice(_MODES, "repeat what the drummer plays, or trade improvised phrases", BattleMode.REPEAT)
    opponent: str = option("NAME", f"who the drummer is ({_opponents()})", str, USUAL_OPPONENT)
    tempo: float | None = option("BPM", "quarter notes a minute (as the opponent likes it)", number, None)
    meter: tuple[int, int] | None = option("N/U", "such as 4/4 or 7/8 (as the opponent likes it)", _meter, None)
    feel: Feel | None = choice(_FEELS, "how a beat is divided (as the opponent likes it)", None)
    style: str | None = option("WORD", "such as rock or jazz (as the opponent likes it)", str, None)
    bars: int = option(
        "N", f"bars of an improvised turn: {', '.join(map(str, TURN_BARS))} ({USUAL_BARS})", whole_number, USUAL_BARS
    )
    rounds: int = option("N", f"rounds before the final ({USUAL_ROUNDS})", whole_number, USUAL_ROUNDS)
    no_final: bool = flag("no final after the rounds")
    lives: int = option(
        "N", f"lost rounds until one is out, in repeat mode ({USUAL_LIVES}); none with --handicap", whole_number,
        USUAL_LIVES,
    )  # fmt: skip
    target: float = option(
        "PERCENT", f"accuracy that wins a round, in repeat mode ({USUAL_TARGET:.0%}): {ACCURACY_WORDS}", _percent,
        USUAL_TARGET,
    )  # fmt: skip
    first_step: int | None = option(
        "N",
        f"how hard the first phrase to repeat is, 0 to {MOST_STEP} (as earlier battles ask, else by the level: "
        f"{', '.join(f'{level} {step}' for level, step in FIRST_STEPS.items())}); with --handicap for each player",
        whole_number,
        None,
    )
    keep_time: bool | None = switch("the drummer keeps time under your turns (on when you improvise)")
    seed: int = option("N", "which battle: the same number and strokes are the same battle (1)", whole_number, 1)
    level: Level | None = choice(
        OUR_LEVELS,
        "how strictly is judged (as your lessons on the whole, beginner where there are none; judged again: as it was)",
        None,
    )
    players: tuple[Player, ...] = option(
        "NAME[=PORT],…",
        "people who play each other: each on a kit of their own by part of its port's name, or in turn on one",
        _players,
        (),
    )
    handicap: bool = flag(
        "each player gets phrases of their own step, and is measured against their own earlier battles; no lives"
    )
    device: tuple[str, ...] = devices_option()
    virtual_student: tuple[str, ...] = repeated(
        "SPEC", "who plays instead of a person, such as pro,seed=3; once for each player"
    )
    headless: bool = flag("no window; virtual players play faster than real time")
    student: str | None = option("NAME", "whose battle it is", str, None)
    report: Path | None = option("DIR", "where to leave the battle", Path, None)
    recover: Path | None = option("DIR", "judge and keep a battle that was cut off", Path, None)
    judge_again: str | None = option(
        "SESSION",
        "judge a kept battle again (its number, last, a day, folder or capture), by the windows of --level",
        str,
        None,
    )
    json: bool = flag("print the battle as one JSON document")
    network: NetworkOptions = group(NetworkOptions, "two stations on one network")
    video: FilmOptions = group(FilmOptions, "video")
    sound: SoundOptions = group(SoundOptions, "sound")


def battle_rules(options: BattleOptions, settings: Settings, specs: Sequence[str] = ()) -> BattleRules:
    """What is agreed; `specs` are the virtual students who play, none where people do.

    Raises `BadInput` for what nobody can play.
    """
    keeps_time = options.mode is BattleMode.IMPROVISE if options.keep_time is None else options.keep_time
    if options.handicap and len(options.players) < 2:
        raise BadInput("--handicap", "", "it is for two players or more; name them with --players")
    if options.first_step is not None and not 0 <= options.first_step <= MOST_STEP:
        raise BadInput("--first-step", f"{options.first_step}", f"expected 0 to {MOST_STEP}")
    players = _who(options, settings, specs)
    level = options.level or LevelMemory(StudentHistory(settings, players[0].name)).usual()
    rules = BattleRules(
        ground=_ground(options),
        mode=options.mode,
        opponent=find_opponent(options.opponent).name,
        players=players,
        rounds=options.rounds,
        has_final=not options.no_final,
        bars=options.bars,
        lives=options.lives,
        target=options.target,
        level=level,
        first_step=options.first_step,
        seed=options.seed,
        click=parse_click(settings.click_pattern, setting_source("click_pattern")),
        keeps_time=keeps_time,
    )
    return after_earlier(rules, settings, options.handicap, bool(specs))


def _who(options: BattleOptions, settings: Settings, specs: Sequence[str]) -> tuple[Player, ...]:
    """Who plays; virtual students sit at kits of their own where people would."""
    if not options.players:
        return (Player(virtual_name(specs[0]) if specs and options.student is None else settings.student),)
    if not specs:
        return options.players
    sides = enumerate(options.players, 1)
    return tuple(replace(one, device=virtual_device(side)) if one.device else one for side, one in sides)


def _ground(options: BattleOptions) -> Ground:
    ground = find_opponent(options.opponent).ground
    beats, unit = options.meter or (ground.beats, ground.unit)
    ground = replace(
        ground, tempo_bpm=ground.tempo_bpm if options.tempo is None else options.tempo, beats=beats, unit=unit
    )
    return replace(ground, feel=options.feel or ground.feel, style=options.style or ground.style)
