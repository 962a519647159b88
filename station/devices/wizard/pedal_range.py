"""What a hi-hat's pedal sends, from how it was moved: controller, ends, and whether it knows but a few places."""

from collections.abc import Iterable, Mapping
from statistics import median

from station.devices.mapping.device_map import PEDAL_CONTROLLER, PedalRange
from station.devices.wizard.answers import StepAnswer
from station.devices.wizard.wizard_steps import OPEN_BOW, OPEN_EDGE, PEDAL_SWEEP, SHUT_BOW, SHUT_EDGE, WizardStep

Takes = Mapping[WizardStep, StepAnswer]

FEW = 4
"""A pedal that says no more different things than this knows places, not a way; our choice."""
_NEARLY = 5
"""Ends that lie so near to the expected ones are those (our choice: nobody presses twice alike)."""
_VELOCITY_PREFIX = 88


def moved_controller(take: StepAnswer) -> int | None:
    """The controller that the pedal moves, the foot controller if that did; None where none said two things."""
    values: dict[int, set[int]] = {}
    for said in take.controllers:
        if said.number != _VELOCITY_PREFIX:
            values.setdefault(said.number, set()).add(said.value)
    moved = {number: said for number, said in values.items() if len(said) > 1}
    if PEDAL_CONTROLLER in moved:
        return PEDAL_CONTROLLER
    return max(moved, key=lambda number: len(moved[number]), default=None)


def learned_pedal(takes: Takes, usual: PedalRange | None) -> PedalRange | None:
    """The pedal as it was moved; `usual` where nobody was asked or where it is as expected."""
    sweep = takes.get(PEDAL_SWEEP)
    if sweep is None:
        return usual
    controller = moved_controller(sweep)
    if controller is None:
        return None
    way = [said.value for said in sweep.controllers if said.number == controller]
    rises = way[-1] > way[0]
    ends = (min(way), max(way)) if rises else (max(way), min(way))
    wide_open = _at_strokes(takes, controller, (OPEN_BOW, OPEN_EDGE), ends[0])
    shut = _at_strokes(takes, controller, (SHUT_BOW, SHUT_EDGE), ends[1])
    if (shut > wide_open) != rises or shut == wide_open:  # the student held it otherwise than asked
        wide_open, shut = ends
    said = {said.value for take in takes.values() for said in take.controllers if said.number == controller}
    steps = tuple(sorted(said, reverse=not rises)) if len(said) <= FEW else ()
    learned = PedalRange(wide_open, shut, controller, steps)
    return usual if usual is not None and are_alike(learned, usual) else learned


def _at_strokes(takes: Takes, controller: int, steps: Iterable[WizardStep], otherwise: int) -> int:
    """What the controller said just before the strokes of these steps: modules say there what they make of it."""
    said = [
        value
        for step in steps
        if step in takes
        for stroke in takes[step].strokes()
        if (value := takes[step].value_at(controller, stroke[0].at_ns)) is not None
    ]
    return round(median(said)) if said else otherwise


def are_alike(one: PedalRange, other: PedalRange) -> bool:
    """Whether two pedals are the same, but for how far they happened to be pressed."""
    ends = max(abs(one.wide_open - other.wide_open), abs(one.shut - other.shut))
    if one.controller != other.controller or ends > _NEARLY:
        return False
    return one.steps == () == other.steps or set(one.steps) <= set(other.steps)


def presses(take: StepAnswer, pedal: PedalRange | None) -> int:
    """How often the pedal went from its open half into its shut half."""
    if pedal is None:
        return 0
    half = [pedal.openness(said.value) >= 0.5 for said in take.controllers if said.number == pedal.controller]
    return sum(before and not after for before, after in zip([True, *half], half, strict=False))
