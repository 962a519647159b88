"""The options of `station practice`: what is practised, by whom, and what is left of it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from station.cli.input.read_scores import bars_of_gap
from station.cli.input.tapping import TAP
from station.cli.options.device_option import devices_option, sticks_option
from station.cli.options.option_fields import (
    choice,
    flag,
    group,
    number,
    option,
    optional_argument,
    switch,
    unread,
    whole_number,
)
from station.cli.options.sound_options import SoundOptions, TrackOptions
from station.cli.options.watch_options import WatchOptions
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.drills.grid.tab_symbols import LINE_PIECES
from station.practice.session.cues.quiet_bars import QuietBars
from station.practice.session.rising_tempo import EXPECTED as EXPECTED_RISE
from station.practice.session.rising_tempo import Rise, rise_of
from station.scoring.matching.hit_windows import OUR_LEVELS, Level


def _tempo(text: str) -> float | Literal["tap"]:
    if text == TAP:
        return TAP
    try:
        return float(text)
    except ValueError:
        raise unread(f"a number, or {TAP} to tap it", text) from None


def _percent(text: str) -> float:
    return number(text.removesuffix("%").strip())


def _bars(text: str) -> tuple[int, int]:
    first, dash, last = text.partition("-")
    try:
        return int(first), int(last if dash else first)
    except ValueError:
        raise unread("two bars such as 1-4", text) from None


def _pieces(text: str) -> frozenset[Piece]:
    words = [part.strip() for part in text.split(",")]
    if not all(part in LINE_PIECES for part in words):
        raise unread("pieces such as kick,snare,hihat", text)
    return frozenset(LINE_PIECES[part] for part in words)


def _rise(text: str) -> Rise:
    try:
        return rise_of(text)
    except BadInput:
        raise unread(EXPECTED_RISE, text) from None


@dataclass(frozen=True, slots=True, kw_only=True)
class PracticeOptions:
    """What is practised, by whom, and what is left of it; None leaves the choice to the lesson or the settings."""

    lesson: str | None = optional_argument("LESSON", "a lesson's name or file (the first lesson)")
    tempo: float | Literal["tap"] | None = option(
        "BPM",
        "quarter notes a minute, in any meter, or tap to tap it on the Enter key (the lesson's)",
        _tempo,
        None,
    )
    speed: float | None = option("PERCENT", "of the lesson's own tempo, such as 60%", _percent, None)
    adapt: bool | None = switch(
        "let tempo, bars and feedback follow the student from pass to pass (on in the window, unless --tempo)"
    )
    rise: Rise | None = option(
        "BPM/BARS[:TOP]",
        "so many bpm more every so many bars such as 5/8, up to the lesson's target or TOP",
        _rise,
        None,
    )
    loops: int | None = option("N", "how often the loop is played (the lesson's)", whole_number, None)
    bars: tuple[int, int] | None = option("A-B", "bars to practise, from 1 (the lesson's loop)", _bars, None)
    gap: QuietBars | None = option(
        "ON/OFF|random[:SHARE]",
        "bars with a click and bars without, in turn such as 4/1, or at random such as random:30%",
        bars_of_gap,
        None,
        rivals="click",
    )
    fold: frozenset[Piece] | None = option(
        "PIECES", "on a smaller kit: these pieces alone, such as kick,snare,hihat (the lesson's)", _pieces, None
    )
    no_click: bool = flag("no click after the count-in: the score follows you, and waits", rivals="click")
    today: bool = flag("the next block of today's plan (station today)")
    device: tuple[str, ...] = devices_option()
    sticks: tuple[str, ...] = sticks_option()
    virtual_student: str | None = option("SPEC", "who plays instead of a person, such as pro,seed=3", str, None)
    headless: bool = flag("no window; a virtual student plays faster than real time")
    no_demonstration: bool = flag("count in and play at once")
    report: Path | None = option("DIR", "where to leave the session; practises in the terminal", Path, None)
    no_pictures: bool = flag("leave a report, but no pictures")
    recover: Path | None = option("DIR", "judge and keep a session that was cut off", Path, None)
    student: str | None = option("NAME", "whose session it is", str, None)
    level: Level | None = choice(
        OUR_LEVELS, "how strictly is judged from now on (as the student chose, or came to; else the lesson's)", None
    )
    json: bool = flag("print the report as one JSON document; in the terminal")
    sound: SoundOptions = group(SoundOptions, "sound")
    track: TrackOptions = group(TrackOptions, "a track to play along to")
    remember: bool = flag("keep what was said of student, kit and sound for the next time")
    watch: WatchOptions = group(WatchOptions)
