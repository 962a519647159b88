"""A drummer who does what the wizard asks, on a fake module."""

from station.core.pieces import Articulation, Piece, Zone, word
from station.core.units import NS_PER_MS, ns_from_ms
from station.devices.wizard.wizard import Wizard
from station.devices.wizard.wizard_steps import (
    HALF_BOW,
    OPEN_BOW,
    OPEN_EDGE,
    SHUT_BOW,
    SHUT_EDGE,
    SPLASH,
    STEPS,
    WizardQuestion,
    WizardStep,
)
from tests.fakes.module import FakeModule, Sent

_PAUSE_MS = 400.0
_SOFT, _FIRM = 3, 100
_HATS = {OPEN_BOW: "open", OPEN_EDGE: "open edge", SHUT_BOW: "closed", SHUT_EDGE: "closed edge", HALF_BOW: "half"}


def name(step: WizardStep) -> str:
    """What the fake module calls what a step asks for."""
    if step in _HATS:
        return _HATS[step]
    if step.articulation is Articulation.CROSS_STICK:
        return "cross-stick"
    zone = "" if step.zone in (Zone.HEAD, Zone.BOW) else f" {word(step.zone)}"
    return f"{word(step.piece)}{zone}"


def answer(module: FakeModule, step: WizardStep, ms: float) -> list[Sent]:
    """What the module sends when its owner does what the step asks."""
    if step.ask is WizardQuestion.SWEEP:
        return list(module.way(ms, 1.0, 0.0, 1500))
    times = [
        (ms + stroke * _PAUSE_MS, _FIRM if stroke < step.firm else _SOFT) for stroke in range(step.firm + step.soft)
    ]
    if step.ask is WizardQuestion.GRAB:
        return [sent for at_ms, _ in times for sent in module.grabbed(name(step).removesuffix(" edge"), 2 * at_ms - ms)]
    if step.piece is Piece.HIHAT_PEDAL:
        return [s for at_ms, v in times for s in module.stomp(v, at_ms + 100, splash=step is SPLASH)]
    return [sent for at_ms, v in times for sent in module.strike(name(step), v, at_ms, step.openness)]


def teach(module: FakeModule, port: str = "USB Kit", steps: tuple[WizardStep, ...] = STEPS) -> Wizard:
    """A wizard that has asked everything; what the module does not send is skipped."""
    wizard, ms = Wizard(port, steps), 1000.0
    while not wizard.over:
        step = steps[wizard.view().step - 1]
        sent = sorted(answer(module, step, ms))
        for at_ms, data in sent:
            wizard.feed(data, ns_from_ms(at_ms))
        ms = max([ms, *(at_ms for at_ms, _ in sent)]) + 1000
        before = wizard.view().step
        wizard.advance(round(ms) * NS_PER_MS)
        if wizard.view().step == before and not wizard.over:
            wizard.skip()
        ms += 800
    return wizard
