"""Which module a kit is most likely of: the port's name, and which presets know what was struck by its number."""

from collections.abc import Mapping
from dataclasses import dataclass

from station.core.pieces import Piece, Zone
from station.devices.mapping.device_map import DeviceMap, PedalRange
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, PRESETS, preset_for
from station.devices.wizard.pedal_range import are_alike
from station.devices.wizard.wizard_steps import WizardStep

_PIECE, _ZONE, _WRONG, _NAME, _PEDAL = 2, 1, -2, 3, 1
"""What a number is worth whose piece a preset knows, and whose zone too, or which it takes for another piece; and the
port's name, which outweighs a number that its owner has changed, not two; and the pedal's way (our choice)."""


@dataclass(frozen=True, slots=True)
class ModuleGuess:
    """The likeliest preset; of the numbers struck it knows `agreeing` and takes `differing` for something else."""

    preset: DeviceMap
    agreeing: int
    differing: int


def guess(numbers: Mapping[WizardStep, int], port: str, pedal: PedalRange | None = None) -> ModuleGuess:
    """The preset that explains `numbers`, the main note of each step, and the way of the `pedal` best."""
    named = preset_for(port)

    def merit(preset: DeviceMap) -> int:
        bonus = _NAME if preset is named and preset is not GENERAL_MIDI_PRESET else 0
        bonus += _PEDAL if pedal is not None and preset.pedal is not None and are_alike(pedal, preset.pedal) else 0
        return bonus + sum(_worth(preset, step, number) for step, number in numbers.items())

    candidates = [named] if named.reports else PRESETS.values()
    best = max(candidates, key=lambda preset: (merit(preset), preset is named))
    agreeing = sum(_worth(best, step, number) > 0 for step, number in numbers.items())
    return ModuleGuess(best, agreeing, len(numbers) - agreeing)


def knows(preset: DeviceMap, step: WizardStep, number: int) -> bool:
    """Whether `preset` takes `number` for what the step asked for; a zone that it does not tell apart counts."""
    strike = preset.notes.get(number)
    return strike is not None and strike.piece is step.piece and _zone(strike.zone) == _zone(step.zone)


def _zone(zone: Zone) -> Zone:
    return Zone.BOW if zone is Zone.HEAD else zone


def _worth(preset: DeviceMap, step: WizardStep, number: int) -> int:
    strike = preset.notes.get(number)
    if strike is None:
        return 0
    if strike.piece is not step.piece:
        return _WRONG if strike.piece is not Piece.PERCUSSION else 0
    return _PIECE + (_ZONE if knows(preset, step, number) else 0)
