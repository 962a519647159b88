"""The four ways to measure latency, for the command and for the window: what is asked for in, findings out.

docs/calibration.md says how to set each up.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.app.calibration_desk import LOOPBACK, REPORT, STRIKE, TAP
from station.app.calibration_findings import Findings, Row, rows_of_taps
from station.core.calibration import Calibration
from station.core.settings import Settings
from station.devices.kit_ports import KitWish, parse_kits
from station.engine.calibrating import SoundWish, Tell, loopback_rounds, stream_report, struck, tapped


@dataclass(frozen=True, slots=True)
class MeasureWish:
    """What is measured `by` which way, on which devices; `distance_m` from the pads to the microphone."""

    by: str
    sound: SoundWish
    kit: KitWish
    distance_m: float = 0.0

    @classmethod
    def of(cls, settings: Settings, by: str, distance_m: float = 0.0) -> "MeasureWish":
        """On the devices of the settings, the kit the first that they name."""
        sound = SoundWish(settings.output, "", settings.block_frames, settings.rate_hz)
        return cls(by, sound, parse_kits(settings.kit)[0], distance_m)


def measured(wish: MeasureWish, before: Calibration, tell: Tell) -> Findings:
    """Measure; `before` is what is known, `tell` hears what the user has to do. Raises `DeviceError`."""
    return _WAYS[wish.by](wish, before, tell)


def _by_report(wish: MeasureWish, _: Calibration, tell: Tell) -> Findings:
    devices, stream = stream_report(wish.sound, tell)
    return Findings(devices, stream=stream)


def _by_loopback(wish: MeasureWish, _: Calibration, tell: Tell) -> Findings:
    devices, estimate = loopback_rounds(wish.sound, tell)
    return Findings(devices, (Row("output", devices.output or "", estimate),))


def _by_strikes(wish: MeasureWish, _: Calibration, tell: Tell) -> Findings:
    devices, found = struck(wish.sound, wish.kit, tell, wish.distance_m)
    kit = devices.kit or ""
    pads = (Row("pad", kit, estimate, piece) for piece, estimate in found.pads.items())
    return Findings(devices, (Row("kit", kit, found.kit), *pads))


def _by_taps(wish: MeasureWish, before: Calibration, tell: Tell) -> Findings:
    devices, piece, found = tapped(wish.sound, wish.kit, tell)
    return Findings(devices, rows_of_taps(found, piece, devices, before))


_Way = Callable[[MeasureWish, Calibration, Tell], Findings]
_WAYS: Mapping[str, _Way] = MappingProxyType(
    {REPORT: _by_report, LOOPBACK: _by_loopback, STRIKE: _by_strikes, TAP: _by_taps}
)
