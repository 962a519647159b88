"""The drummer's kit and leading hand as options of a command: `--drums` and `--hands`.

`--device` is another thing: the kit that is plugged in.
"""

from dataclasses import dataclass

from station.cli.input.read_scores import kit_of_lesson, load_led_score
from station.cli.options.option_fields import choice, flag, option
from station.motion.kit.kit import DEFAULT_KIT, Kit, kit_names, load_kit
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import METHODS, Assignment, assign_limbs
from station.music.score import Score


@dataclass(frozen=True, slots=True, kw_only=True)
class DrumsOptions:
    """Who plays what, and on which kit."""

    drums: str = option(
        "NAME", f"the drummer's kit: {', '.join(kit_names())}, or a file (the lesson's, else {DEFAULT_KIT})", str, ""
    )
    hands: Hands | None = choice(
        {hands.value: hands for hands in Hands},
        "which hand leads; open: the left hand plays a right-handed kit's hi-hat (as the kit is built)",
        None,
    )
    as_written: bool = flag("leave the sides of a lesson's sticking on a left-handed kit, and for open hands")
    method: str = choice(dict(zip(METHODS, METHODS, strict=True)), f"how limbs are assigned ({METHODS[0]})", METHODS[0])


def assigned(score: Score, kit: Kit, options: DrumsOptions) -> Assignment:
    """The limbs of `score` on `kit` as the options ask for them."""
    return assign_limbs(score, kit, options.method, options.hands)


def drums_of(name: str, options: DrumsOptions) -> Kit:
    """The kit that `--drums` names, else that of the lesson `name`; raises `BadInput` if there is none of that name."""
    return load_kit(options.drums or kit_of_lesson(name) or DEFAULT_KIT)


def led_score(name: str, options: DrumsOptions) -> Score:
    """The score that `name` means, a lesson's sticking read for who plays it unless `--as-written`."""
    return load_led_score(name, drums_of(name, options), options.hands, options.as_written)
