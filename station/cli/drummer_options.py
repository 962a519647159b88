"""The drummer's furniture and leading hand as words of a command: `--drums` and `--hands`.

`--kit` is another thing: the MIDI port of the kit that the user plays.
"""

import argparse

from station.cli.read_scores import kit_of_lesson, load_led_score
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import DEFAULT_KIT, Kit, kit_names, load_kit
from station.motion.motion_plan import MotionPlan
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import METHODS, Assignment, assign_limbs
from station.music.score import Score


def add_drums_options(parser: argparse.ArgumentParser) -> None:
    """Add `--drums`, `--hands`, `--as-written` and `--method`: who plays what, and on which kit."""
    drums = f"the drummer's kit: {', '.join(kit_names())}, or a file (the lesson's, else {DEFAULT_KIT})"
    parser.add_argument("--drums", default="", metavar="NAME", help=drums)
    hands = "which hand leads; open: the left hand plays a right-handed kit's hi-hat (as the kit is built)"
    parser.add_argument("--hands", choices=[h.value for h in Hands], help=hands)
    as_written = "leave the sides of a lesson's sticking on a left-handed kit, and for open hands"
    parser.add_argument("--as-written", action="store_true", help=as_written)
    parser.add_argument("--method", choices=METHODS, default=METHODS[0], help="how limbs are assigned (%(default)s)")


def assigned(score: Score, kit: Kit, arguments: argparse.Namespace) -> Assignment:
    """The limbs of `score` on `kit` as the arguments ask for them."""
    return assign_limbs(score, kit, arguments.method, _hands_of(arguments))


def _hands_of(arguments: argparse.Namespace) -> Hands | None:
    return Hands(arguments.hands) if arguments.hands else None


def drums_of(arguments: argparse.Namespace) -> Kit:
    """The kit that `--drums` names, else the lesson's own; raises `BadInput` if there is none of that name."""
    return load_kit(arguments.drums or kit_of_lesson(arguments.score) or DEFAULT_KIT)


def led_score(arguments: argparse.Namespace) -> Score:
    """The score that is asked for, a lesson's sticking read for who plays it unless `--as-written`."""
    return load_led_score(arguments.score, drums_of(arguments), _hands_of(arguments), arguments.as_written)


def planned(score: Score, figure: Figure, arguments: argparse.Namespace) -> MotionPlan:
    """The plan of `score` on the kit and with the hands that the arguments ask for."""
    kit = drums_of(arguments)
    return MotionPlan.of(score, kit, figure, assigned(score, kit, arguments))
