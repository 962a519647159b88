"""The lines in which a battle is chosen: what each says, and what it is turned to.

A line goes on to its next value and after the last to the first again, so that one pad reaches all of them.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from station.app.settings.chosen_battle import ChosenBattle, People
from station.core.counts import counted
from station.practice.battle.battle_rules import TURN_BARS, BattleMode
from station.practice.battle.ground import Feel
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.session.plan import MAX_TEMPO_BPM, MIN_TEMPO_BPM
from station.scoring.matching.hit_windows import Level

METERS = ((4, 4), (3, 4), (6, 8), (5, 4), (7, 8), (12, 8))
TEMPO_STEP_BPM = 4.0
"""Our choice: half of what a listener surely notices is a step (HUMANS)."""
SLOWEST_BPM, FASTEST_BPM = max(40.0, MIN_TEMPO_BPM), min(220.0, MAX_TEMPO_BPM)
"""Our choice: what is battled at; a file may say more."""
ROUNDS = (1, 2, 3, 4, 6, 8, 12, 16)
LIVES = (1, 2, 3, 5, 9)
TARGETS = (70, 80, 90, 95)
"""Percent of a phrase that are to be right (the issue's 90; less for a first battle, our choice)."""


@dataclass(frozen=True, slots=True)
class SetupLine:
    """A line of the page: its value in `words`, the same `turned` a step on or back, and whether it `matters`."""

    title: str
    about: str
    words: Callable[[ChosenBattle], str]
    turned: Callable[[ChosenBattle, int], ChosenBattle]
    matters: Callable[[ChosenBattle], bool] = lambda _: True


MODE_WORDS = {BattleMode.REPEAT: "Repeat", BattleMode.IMPROVISE: "Improvise"}
MODE_ABOUT = {
    BattleMode.REPEAT: "The drummer plays a phrase, you play it back at once. It gets harder while you succeed.",
    BattleMode.IMPROVISE: "You trade bars over the groove: the drummer listens to you, and answers.",
}
_Value = TypeVar("_Value")


def stepped(values: Sequence[_Value], value: _Value, way: int) -> _Value:
    """What stands `way` places after `value`, round and round; the first where it is none of them."""
    return values[(values.index(value) + way) % len(values)] if value in values else values[0]


def _ground(setup: ChosenBattle, **others: object) -> ChosenBattle:
    return replace(setup, ground=replace(setup.ground, **others))  # type: ignore[arg-type] # its fields


def _tempo(setup: ChosenBattle, way: int) -> ChosenBattle:
    tempo = setup.ground.tempo_bpm + way * TEMPO_STEP_BPM
    if tempo > FASTEST_BPM:
        tempo = SLOWEST_BPM
    return _ground(setup, tempo_bpm=FASTEST_BPM if tempo < SLOWEST_BPM else tempo)


def _meter(setup: ChosenBattle, way: int) -> ChosenBattle:
    beats, unit = stepped(METERS, (setup.ground.beats, setup.ground.unit), way)
    return _ground(setup, beats=beats, unit=unit)


STYLES = tuple(dict.fromkeys(one.ground.style for one in OPPONENTS.values()))
"""What may be played on: the grounds that drummers here are at home on."""
_FEELS = {Feel.STRAIGHT: "Straight", Feel.TRIPLET: "Swung"}


def _repeats(setup: ChosenBattle) -> bool:
    return setup.mode is BattleMode.REPEAT


MODE_LINE = SetupLine(
    "What",
    "Repeat what the drummer plays, or trade improvised bars",
    lambda setup: MODE_WORDS[setup.mode],
    lambda setup, way: replace(setup, mode=stepped(tuple(BattleMode), setup.mode, way)),
)
OPPONENT_LINE = SetupLine(
    "Against",
    "The drummer on the other side",
    lambda setup: setup.drummer.title,
    lambda setup, way: setup.against(stepped(tuple(OPPONENTS), setup.opponent, way)),
)
LEVEL_LINE = SetupLine(
    "Judged as",
    "How near to its time a stroke counts as right",
    lambda setup: setup.level.words,
    lambda setup, way: replace(setup, level=stepped(tuple(Level), setup.level, way)),
    _repeats,
)
WHO_LINE = SetupLine(
    "Who",
    "You against the computer's drummer, or against a friend",
    lambda setup: setup.people.words,
    lambda setup, way: replace(setup, people=stepped(tuple(People), setup.people, way)),
)
WAY_LINE = SetupLine(
    "This station",
    "One of you hosts and chooses what is played, the other joins",
    lambda setup: "joins" if setup.joins else "hosts",
    lambda setup, _: replace(setup, joins=not setup.joins),
    lambda setup: setup.is_linked,
)
CLICK_LINE = SetupLine(
    "Click",
    "Whether a click sounds all the while",
    lambda setup: "on" if setup.is_clicked else "off",
    lambda setup, _: replace(setup, is_clicked=not setup.is_clicked),
)
TEMPO_LINE = SetupLine(
    "Tempo",
    "Beats a minute, the same for both",
    lambda setup: f"{setup.ground.beats_a_minute:.0f} bpm",
    _tempo,
)
LINES: tuple[SetupLine, ...] = (
    MODE_LINE,
    OPPONENT_LINE,
    TEMPO_LINE,
    SetupLine(
        "Bars a turn",
        "How long each plays before the other does",
        lambda setup: counted(setup.bars, "bar"),
        lambda setup, way: replace(setup, bars=stepped(TURN_BARS, setup.bars, way)),
        lambda setup: not _repeats(setup),
    ),
    SetupLine(
        "Rounds",
        "A round is a turn of each",
        lambda setup: f"{setup.rounds}",
        lambda setup, way: replace(setup, rounds=stepped(ROUNDS, setup.rounds, way)),
    ),
    SetupLine(
        "To win a round",
        "How much of a phrase is to be right; below it, a life is lost",
        lambda setup: f"{setup.target} % right",
        lambda setup, way: replace(setup, target=stepped(TARGETS, setup.target, way)),
        _repeats,
    ),
    LEVEL_LINE,
    SetupLine(
        "Lives",
        "Rounds that may be lost before the battle is over",
        lambda setup: f"{setup.lives}",
        lambda setup, way: replace(setup, lives=stepped(LIVES, setup.lives, way)),
        _repeats,
    ),
    WHO_LINE,
    WAY_LINE,
    SetupLine(
        "Begins",
        "Who plays the first turn",
        lambda setup: "your friend" if setup.guest_begins else "you",
        lambda setup, _: replace(setup, guest_begins=not setup.guest_begins),
        lambda setup: setup.is_linked and not _repeats(setup),
    ),
    SetupLine(
        "Meter",
        "Beats of a bar",
        lambda setup: f"{setup.ground.beats}/{setup.ground.unit}",
        _meter,
    ),
    SetupLine(
        "Feel",
        "How beats are mostly divided; single beats may be otherwise",
        lambda setup: _FEELS[setup.ground.feel],
        lambda setup, way: _ground(setup, feel=stepped(tuple(Feel), setup.ground.feel, way)),
    ),
    SetupLine(
        "Style",
        "What both play on",
        lambda setup: setup.ground.style,
        lambda setup, way: _ground(setup, style=stepped(STYLES, setup.ground.style, way)),
    ),
    CLICK_LINE,
    SetupLine(
        "Under your turn",
        "Whether the drummer keeps time while you play",
        lambda setup: "the drummer keeps time" if setup.keeps_time else "nobody plays",
        lambda setup, _: replace(setup, keeps_time=not setup.keeps_time),
    ),
    SetupLine(
        "Handicap",
        "Each is measured against their own earlier battles, so that a child can beat a parent fairly",
        lambda setup: "fair play" if setup.is_fair else "none",
        lambda setup, _: replace(setup, is_fair=not setup.is_fair),
        lambda setup: setup.people.needs_friend and not setup.is_linked,
    ),
)
"""In the order in which they are read; pads reach them in the same."""


_OF_A_GUEST = (WHO_LINE, WAY_LINE, LEVEL_LINE, CLICK_LINE)
"""All that a guest chooses; the rest is the host's."""


def lines_of(setup: ChosenBattle) -> tuple[SetupLine, ...]:
    """The lines that matter to what is chosen."""
    if setup.is_guest:
        return _OF_A_GUEST
    return tuple(line for line in LINES if line.matters(setup))
