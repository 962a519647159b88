"""The options that say what sounds and how: the same words as in the settings, for this once or to be remembered."""

import argparse
from pathlib import Path

from station.core.errors import BadInput
from station.engine.level_words import LEVELS_HELP, parse_levels
from station.practice.session.backing_track import BackingRequest
from station.practice.session.click_options import CLICK_HELP, parse_click
from station.sound.click_sounds import TIMBRES

SETTINGS = ("output", "block_frames", "rate_hz", "drums", "click", "click_pattern", "levels", "midi_out", "guide")
"""The settings that these options stand for, by their names."""


def add_sound_options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add = parser.add_argument_group("sound").add_argument
    add("--output", metavar="DEVICE", help="part of the sound output's name (the system's default)")
    add("--block-frames", type=int, metavar="N", help="frames an audio block (the driver's choice)")
    add("--rate", dest="rate_hz", type=int, metavar="HZ", help="the sound card's sample rate (48000)")
    add("--sounds", dest="drums", metavar="KIT", help="the drum kit that sounds: acoustic, brushes, electronic, yours")
    add("--own-sound", action=argparse.BooleanOptionalAction, help="sound the strokes here (--no-…: the module does)")
    add("--click", dest="click_pattern", metavar="CLICK", help=CLICK_HELP)
    add("--click-sound", dest="click", choices=list(TIMBRES), help="how a click sounds")
    add("--levels", metavar="LEVELS", help=LEVELS_HELP)
    add("--guide", action=argparse.BooleanOptionalAction, help="the demonstration plays along in the passes too")
    add("--midi-out", metavar="PORT", help="send the demonstration to the MIDI output whose name contains this")
    add("--track", type=Path, metavar="FILE", help="play along to a sound file (WAV, FLAC, OGG, MP3) in the passes")
    add("--track-start", type=float, metavar="S", help="where in the file the first pass begins, in seconds (0)")
    add("--track-loop", type=_loop, metavar="A-B", help="the part of the file to repeat, in seconds")
    add("--track-speed", type=float, metavar="PERCENT", help="50-150 (as the tempo to the lesson's own)")
    add("--remember", action="store_true", help="keep these choices, the tracks aside, for the next time")


def said_of(arguments: argparse.Namespace) -> dict[str, object]:
    """The settings that the options name; raises `BadInput` for words that cannot be."""
    said = {name: getattr(arguments, name) for name in (*SETTINGS, "own_sound")}
    if said["click_pattern"] is not None:
        parse_click(said["click_pattern"], "--click")
    if said["levels"] is not None:
        parse_levels(said["levels"], "--levels")
    return {name: value for name, value in said.items() if value is not None}


def backing_of(arguments: argparse.Namespace) -> BackingRequest | None:
    """What to play along to; raises `BadInput` where a part of a track is asked for and no track."""
    parts = {"start": arguments.track_start, "loop": arguments.track_loop, "speed": arguments.track_speed}
    if arguments.track is None:
        lonely = [f"--track-{name}" for name, value in parts.items() if value is not None]
        if lonely:
            raise BadInput(lonely[0], "", "of what? name a file with --track")
        return None
    if arguments.adapt:
        raise BadInput("--track", "--adapt", "a track has one tempo; without --adapt the tempo stays")
    speed = None if arguments.track_speed is None else arguments.track_speed / 100.0
    return BackingRequest(arguments.track, arguments.track_start or 0.0, arguments.track_loop, speed)


def _loop(text: str) -> tuple[float, float]:
    first, _, last = text.partition("-")
    try:
        return float(first), float(last)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: expected two times in seconds such as 12.5-30") from None
