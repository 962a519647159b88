"""The delays that judgement subtracts: what was measured of each device, else what the settings say.

Nanoseconds. Of a kit a stroke is stamped so much after it was played, of an output a sound is heard so much after its
report; positive is late.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.measured_latency import DeviceLatency, StoredCalibration
from station.core.pieces import Piece
from station.core.settings import Settings
from station.core.units import NS_PER_MS, ns_from_ms
from station.engine.engine import KEYBOARD


@dataclass(frozen=True, slots=True)
class KitLatency:
    """A measured kit: of its strokes, and of each pad that has one of its own."""

    kit_ns: int
    pads_ns: Mapping[Piece, int] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def of(cls, measured: DeviceLatency) -> "KitLatency":
        """In nanoseconds."""
        pads = {piece: ns_from_ms(pad.latency_ms) for piece, pad in measured.pads.items()}
        return cls(ns_from_ms(measured.kit.latency_ms), MappingProxyType(pads))


@dataclass(frozen=True, slots=True)
class Latency:
    """`input_ns` of kits and `output_ns` of outputs that were not measured; by name those that were."""

    input_ns: int = 0
    output_ns: int = 0
    kits: Mapping[str, KitLatency] = field(default_factory=lambda: MappingProxyType({}))
    outputs_ns: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))

    def of_stroke(self, device: str, piece: Piece) -> int:
        """Of a stroke; the computer's keys are no kit, and what is known of kits says nothing of them."""
        if device == KEYBOARD:
            return 0
        kit = self.kits.get(device)
        return self.input_ns if kit is None else kit.pads_ns.get(piece, kit.kit_ns)

    def of_kit(self, device: str | None) -> int:
        """Of a kit's strokes in general; None is no kit in particular."""
        if device == KEYBOARD:
            return 0
        kit = self.kits.get(device or "")
        return self.input_ns if kit is None else kit.kit_ns

    def of_output(self, name: str | None) -> int:
        """Of a sound output; None where nothing sounds."""
        return self.outputs_ns.get(name or "", self.output_ns)

    def words(self, device: str | None, output: str | None) -> str:
        """What is subtracted on `device` and `output`, and whether it was measured."""
        kit = self.kits.get(device or "")
        by_pad = f", {len(kit.pads_ns)} pads by themselves" if kit is not None and kit.pads_ns else ""
        measured_in = f" (measured{by_pad})" if kit is not None else ""
        measured_out = " (measured)" if output in self.outputs_ns else ""
        into, out = self.of_kit(device) / NS_PER_MS, self.of_output(output) / NS_PER_MS
        return f"{into:g} ms input{measured_in}, {out:g} ms output{measured_out}"


def latency_of(settings: Settings, calibration: StoredCalibration) -> Latency:
    """What this user has measured and set."""
    return Latency(
        ns_from_ms(settings.input_latency_ms),
        ns_from_ms(settings.output_latency_ms),
        MappingProxyType({name: KitLatency.of(kit) for name, kit in calibration.kits.items()}),
        MappingProxyType({name: ns_from_ms(each.latency_ms) for name, each in calibration.outputs.items()}),
    )
