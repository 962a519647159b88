"""From the answers to a kit: the likeliest preset, verified number by number, and what differs on top."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from station.core.note_map import KitMap, NoteMeaning
from station.core.pieces import Piece, Zone, word
from station.core.units import NS_PER_MS, ms_from_ns
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.presets import stable_name
from station.devices.mapping.trigger_filter import GRAB_AFTER_NS, GRAB_BEFORE_NS
from station.devices.wizard.answers import ONE_STROKE_NS, Said, StepAnswer, groups, main_note
from station.devices.wizard.false_triggers import Mains, Takes, learned_crosstalk, learned_foot, learned_pads
from station.devices.wizard.module_guess import ModuleGuess, guess, knows
from station.devices.wizard.pedal_range import learned_pedal
from station.devices.wizard.wizard_steps import SPLASH, STOMP, WizardQuestion, WizardStep

GENERAL_PURPOSE = range(16, 20)
"""The controllers that modules send a stroke's position with (Roland MIDI implementations)."""
_JUST_BEFORE_NS = 15 * NS_PER_MS
"""A position comes within so long before its note: a DIN cable takes 1 ms a message (our choice)."""
_GRAB_MARGIN = 1.25


@dataclass(frozen=True, slots=True)
class Learned:
    """The kit, what it was guessed to be, and what a person may want to know of it."""

    kit: DeviceMap
    guess: ModuleGuess
    findings: tuple[str, ...]


def main_of(step: WizardStep, take: StepAnswer, mains: Mains) -> int | None:
    """The number that a struck step sends; stomps are not what of the hi-hat, known from `mains`, they fire."""
    if step.ask is not WizardQuestion.STRIKE:
        return None
    foot = step in (STOMP, SPLASH)
    hats = {n for s, n in mains.items() if foot and s.piece is Piece.HIHAT}
    return main_note(groups((note for note in take.notes if note.number not in hats), ONE_STROKE_NS))


def main_notes(takes: Takes) -> dict[WizardStep, int]:
    """The number that each struck step sends."""
    mains: dict[WizardStep, int] = {}
    for step, take in takes.items():
        if (number := main_of(step, take, mains)) is not None:
            mains[step] = number
    return mains


def learn(takes: Takes, port: str) -> Learned:
    """What the answers tell of the kit at `port`."""
    mains = main_notes(takes)
    pedal = learned_pedal(takes, None)
    found = guess({step: number for step, number in mains.items() if step is not SPLASH}, port, pedal)
    preset = found.preset
    name = stable_name(port)
    kit = replace(preset, name=name, title=name, base=preset.name, port_words=())
    kit = replace(kit, notes=_notes(mains, preset), pedal=learned_pedal(takes, preset.pedal))
    kit = replace(
        _with_chokes(takes, mains, kit),
        foot=learned_foot(takes, mains, kit),
        pads=MappingProxyType(learned_pads(takes, mains, kit.notes)),
        crosstalk=learned_crosstalk(takes, mains, kit.notes),
        position_controllers=_positions(takes, mains, kit),
    )
    return Learned(kit, found, tuple(_findings(mains, kit, found)))


# --- notes -----------------------------------------------------------------------------------------------------------


def _notes(mains: Mains, preset: DeviceMap) -> KitMap:
    """The preset's map with what was struck; where two steps sent one number, the plainer, earlier one has its say."""
    notes, taken = dict(preset.notes), set[int]()
    for step, number in mains.items():
        if number in taken:
            continue
        taken.add(number)
        held = {s.openness for s, n in mains.items() if n == number and s.piece is Piece.HIHAT}
        openness = None if {0.0, 1.0} <= held else step.openness  # one number for open and closed tells neither
        usual = notes.get(number)
        if usual is None or not _is_usual(mains, preset, step):
            notes[number] = NoteMeaning(step.piece, step.zone, step.articulation, openness)
        elif step.piece is Piece.HIHAT:
            notes[number] = replace(usual, openness=openness)
    return MappingProxyType(notes)


def _is_usual(mains: Mains, preset: DeviceMap, step: WizardStep) -> bool:
    """Whether the preset takes the step's number for what was asked; a pad's only number may be any of its zones."""
    usual, alone = preset.notes.get(mains[step]), len({n for s, n in mains.items() if s.piece is step.piece}) == 1
    return knows(preset, step, mains[step]) or (alone and usual is not None and usual.piece is step.piece)


# --- chokes and positions --------------------------------------------------------------------------------------------


def _with_chokes(takes: Takes, mains: Mains, kit: DeviceMap) -> DeviceMap:
    choke_notes, from_value, grab = dict(kit.choke_notes), kit.choke_from, kit.grab_velocity
    for step, take in takes.items():
        if step.ask is not WizardQuestion.GRAB:
            continue
        if take.touches:
            from_value = min(from_value, *(touch.value for touch in take.touches))
            grab = max(grab, 0, *_grabs(take))
        else:
            choke_notes |= dict.fromkeys(grab_notes(take, mains.values()), step.piece)
    return replace(kit, choke_notes=MappingProxyType(choke_notes), choke_from=from_value, grab_velocity=grab)


def grab_notes(take: StepAnswer, of_pads: Iterable[int]) -> list[int]:
    """The notes, in order, that only a grab sends: none of a pad's own, and never together with the stroke."""
    strokes, own = take.strokes(), set(of_pads)
    own |= {note.number for stroke in strokes[:1] for note in stroke}
    alone = [stroke for stroke in strokes if not any(note.number in own for note in stroke)]
    return [stroke[0].number for stroke in alone]


def _grabs(take: StepAnswer) -> list[int]:
    """The velocities, with a margin, of the notes around a grab that are not the stroke before it."""

    def beside(note: Said) -> bool:
        return any(-GRAB_BEFORE_NS <= note.at_ns - touch.at_ns <= GRAB_AFTER_NS for touch in take.touches)

    hardest = max((note.value for note in take.notes if not beside(note)), default=0)
    return [round(note.value * _GRAB_MARGIN) for note in take.notes if beside(note) and note.value * 2 <= hardest]


def _positions(takes: Takes, mains: Mains, kit: DeviceMap) -> Mapping[int, frozenset[Piece]]:
    pedal = None if kit.pedal is None else kit.pedal.controller
    found: dict[int, set[Piece]] = {}
    for step, number in mains.items():
        notes = [note for note in takes[step].notes if note.number == number]
        for controller in GENERAL_PURPOSE:
            said = [c.at_ns for c in takes[step].controllers if c.number == controller]
            near = sum(any(0 <= note.at_ns - at_ns <= _JUST_BEFORE_NS for at_ns in said) for note in notes)
            if controller != pedal and near * 2 > len(notes):
                found.setdefault(controller, set()).add(step.piece)
    merged = {controller: kit.position_controllers.get(controller, frozenset()) | p for controller, p in found.items()}
    return MappingProxyType({**kit.position_controllers, **merged})


# --- words -----------------------------------------------------------------------------------------------------------


def _findings(mains: Mains, kit: DeviceMap, found: ModuleGuess) -> Iterable[str]:
    if not mains:
        yield f"nothing was struck: all is as on a {found.preset.title}"
        return
    yield f"{found.preset.title}: {found.agreeing} of {found.agreeing + found.differing} sounds are as expected"
    for step, number in mains.items():
        same = [s for s, n in mains.items() if n == number and s is not step and s.piece is step.piece]
        if not _is_usual(mains, found.preset, step):
            yield f"{step.text}: note {number}"
        if step.zone in (Zone.RIM, Zone.EDGE, Zone.BELL) and any(s.zone is not step.zone for s in same):
            yield f"{step.text}: the same note as elsewhere on this pad, so the zone cannot be told"
    yield from _about_foot(kit, found)
    yield from _about_false_triggers(kit)


def _about_foot(kit: DeviceMap, found: ModuleGuess) -> Iterable[str]:
    if kit.pedal is None:
        yield "hi-hat pedal: it sends no controller; the notes alone tell how open it is"
    elif kit.pedal != found.preset.pedal:
        places = f", {len(kit.pedal.steps)} places" if kit.pedal.steps else ""
        yield (
            f"hi-hat pedal: controller {kit.pedal.controller} from {kit.pedal.wide_open} open to {kit.pedal.shut} shut"
            f"{places}"
        )
    if kit.foot.by_controller:
        yield "hi-hat foot: no note tells of a stomp; the pedal's way does"
    if kit.foot.least_travel:
        yield "hi-hat foot: half-open playing fires stomps; they count only if the pedal closes"
    if kit.foot.splash_ns:
        yield "hi-hat foot: a splash is told by the pedal that opens again"


def _about_false_triggers(kit: DeviceMap) -> Iterable[str]:
    for note, piece in kit.choke_notes.items():
        yield f"{word(piece)}: note {note} says that it is grabbed"
    if kit.grab_velocity:
        yield f"a grabbing hand fires strokes up to velocity {kit.grab_velocity}; they do not count"
    for piece, pad in kit.pads.items():
        if pad.mask_ns:
            yield f"{word(piece)}: double triggers, deaf for {ms_from_ns(pad.mask_ns):.0f} ms after a stroke"
        if pad.least_velocity is not None:
            yield f"{word(piece)}: the softest stroke was {pad.least_velocity}"
    for rule in kit.crosstalk:
        early = f", up to {ms_from_ns(rule.before_ns):.0f} ms before it" if rule.before_ns else ""
        yield f"{word(rule.source)} is heard by {word(rule.victim)}, up to {rule.share:.0%} as loud{early}"
