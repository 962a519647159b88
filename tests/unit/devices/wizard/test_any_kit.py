"""Kits that no table has, taught by somebody who slips: the wizard must find how each was made, whatever the numbers.

Each kit is drawn at random: numbers, missing zones, pedal, crosstalk before and after its stroke, double triggers. Its
owner strikes unevenly, softly where asked, now and then another pad, and now and then too softly to be heard.
"""

import random
from collections.abc import Iterator

import pytest

from station.core.pieces import Piece, word
from station.core.units import ns_from_ms
from station.devices.wizard.wizard import Wizard
from station.devices.wizard.wizard_steps import STEPS, WizardQuestion, WizardStep
from tests.fakes.module import FakeModule, Sent
from tests.unit.devices.wizard.drummer import answer, name

SOUNDS = (
    *("kick", "snare", "snare rim", "cross-stick", "tom_1", "tom_1 rim", "tom_2", "tom_2 rim", "floor_tom_1"),
    *("open", "open edge", "closed", "closed edge", "half", "stomp", "splash"),
    *("crash_1", "crash_1 edge", "crash_2", "ride", "ride edge", "ride bell"),
)
LACKING = [sound for sound in SOUNDS if " " in sound or sound in ("cross-stick", "crash_2", "tom_2")]
NEIGHBOURS = [("kick", "snare"), ("snare", "tom_1"), ("floor_tom_1", "ride"), ("kick", "floor_tom_1"), ("ride", "open")]
SLIPS = 0.06


def made(rng: random.Random) -> FakeModule:
    """A module of no make."""
    notes = dict(zip(SOUNDS, rng.sample(range(20, 100), len(SOUNDS)), strict=True))
    for sound, plain in (("half", "open"), ("splash", "stomp")):
        if rng.random() < 0.6:
            notes[sound] = notes[plain]
    for sound in LACKING:
        if rng.random() < 0.4:
            del notes[sound]
    crosstalk: dict[str, list[tuple[int, float, float]]] = {}
    for source, victim in rng.sample(NEIGHBOURS, rng.randint(0, 3)):
        crosstalk.setdefault(source, []).append((notes[victim], rng.uniform(0.15, 0.4), rng.uniform(-4, 10)))
    doubles = {sound: rng.uniform(4, 20) for sound in rng.sample(["kick", "snare", "tom_1"], rng.randint(0, 2))}
    places = rng.choice([(), (), (0, 127), (0, 56, 127)])
    pedal = (0, 127) if places else rng.choice([(0, 127), (0, 90), (127, 0), (10, 100)])
    controller = rng.choice([4, 4, None, 1, 16])
    return FakeModule(notes, controller, pedal, places, crosstalk, doubles, least=rng.randint(1, 15))


def strokes(module: FakeModule, step: WizardStep, ms: float, rng: random.Random) -> Iterator[tuple[float, list[Sent]]]:
    """Stroke after stroke of what the step asks, with slips and some that are not heard, until nobody asks any more."""
    for count in range(24):
        ms += rng.uniform(150, 800)
        sent = module.strike(name(step), round(min(127, max(60, rng.gauss(95, 14)))), ms, step.openness)
        if count >= step.firm:
            soft = rng.randint(1, 20)
            sent = [] if soft < module.least else module.strike(name(step), soft, ms, step.openness)
        if rng.random() < SLIPS:
            sent = module.strike(rng.choice(sorted(set(module.notes) - {"stomp", "splash"})), 60, ms)
        yield ms, sent


def taught(module: FakeModule, rng: random.Random) -> Wizard:
    wizard, ms = Wizard("no make"), 1000.0
    for number, step in enumerate(STEPS, 1):
        struck = step.ask is WizardQuestion.STRIKE and step.piece is not Piece.HIHAT_PEDAL
        by_hand = strokes(module, step, ms, rng) if struck and name(step) in module.notes else iter(())
        at_once = [] if struck else [(ms, answer(module, step, ms))]
        for at_ms, sent in (*at_once, *by_hand):
            for sent_ms, data in sorted(sent):
                wizard.feed(data, ns_from_ms(sent_ms))
            ms = max([at_ms, *(sent_ms for sent_ms, _ in sent)])
            wizard.advance(ns_from_ms(ms + 75))
            if wizard.view().step > number or wizard.over:
                break
        ms += 1000
        wizard.advance(ns_from_ms(ms))
        if wizard.view().step == number and not wizard.over:
            wizard.skip()
        ms += 900
    return wizard


def piece(sound: str) -> str:
    plain = sound.split(" ", maxsplit=1)[0]
    known = {"stomp": "hihat_pedal", "splash": "hihat_pedal", "cross-stick": "snare"}
    return "hihat" if plain in ("open", "closed", "half") else known.get(plain, plain)


@pytest.mark.parametrize("seed", range(12))
def test_any_kit_is_found_as_it_was_made(seed: int) -> None:
    rng = random.Random(seed)
    module = made(rng)
    kit = taught(module, rng).learned().kit
    assert {sound: word(kit.notes[number].piece) for sound, number in module.notes.items()} == {
        sound: piece(sound) for sound in module.notes
    }
    ghosts = {
        (piece(source), piece(next(sound for sound, number in module.notes.items() if number == victim)))
        for source, victims in module.crosstalk.items()
        for victim, _, _ in victims
    }
    assert {(word(rule.source), word(rule.victim)) for rule in kit.crosstalk} == ghosts
    assert {word(piece) for piece, pad in kit.pads.items() if pad.mask_ns} == set(module.doubles)
    if module.controller is not None:
        assert kit.pedal is not None
        assert kit.pedal.controller == module.controller
        assert (kit.pedal.wide_open, kit.pedal.shut) == pytest.approx(module.pedal, abs=5)
        assert kit.pedal.steps == tuple(sorted(module.places, reverse=module.pedal[0] > module.pedal[1]))
