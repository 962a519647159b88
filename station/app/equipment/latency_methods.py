"""The four ways to measure latency, for the command and for the window: what is asked for in, findings out.

docs/calibration.md says how to set each up.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.app.equipment.calibration_results import CalibrationResult, CalibrationResults, rows_of_taps
from station.core.measured_latency import LOOPBACK, REPORT, STRIKE, TAP, StoredCalibration
from station.core.settings import Settings
from station.devices.device_ports import DeviceRequest, parse_devices
from station.engine.latency_measurement import Notify, SoundRequest, loopback_rounds, stream_report, struck, tapped


@dataclass(frozen=True, slots=True)
class MeasureRequest:
    """What is measured `by` which way, on which devices; `distance_m` from the pads to the microphone."""

    by: str
    sound: SoundRequest
    kit: DeviceRequest
    distance_m: float = 0.0

    @classmethod
    def of(cls, settings: Settings, by: str, distance_m: float = 0.0) -> "MeasureRequest":
        """On the devices of the settings, the kit the first that they name."""
        sound = SoundRequest(settings.output, "", settings.block_frames, settings.rate_hz)
        return cls(by, sound, parse_devices(settings.kit)[0], distance_m)


def measured(request: MeasureRequest, before: StoredCalibration, notify: Notify) -> CalibrationResults:
    """Measure; `before` is what is known, `notify` hears what the user has to do. Raises `DeviceError`."""
    return _WAYS[request.by](request, before, notify)


def _by_report(request: MeasureRequest, _: StoredCalibration, notify: Notify) -> CalibrationResults:
    devices, stream = stream_report(request.sound, notify)
    return CalibrationResults(devices, stream=stream)


def _by_loopback(request: MeasureRequest, _: StoredCalibration, notify: Notify) -> CalibrationResults:
    devices, estimate = loopback_rounds(request.sound, notify)
    return CalibrationResults(devices, (CalibrationResult("output", devices.output or "", estimate),))


def _by_strikes(request: MeasureRequest, _: StoredCalibration, notify: Notify) -> CalibrationResults:
    devices, found = struck(request.sound, request.kit, notify, request.distance_m)
    kit = devices.kit or ""
    pads = (CalibrationResult("pad", kit, estimate, piece) for piece, estimate in found.pads.items())
    return CalibrationResults(devices, (CalibrationResult("kit", kit, found.kit), *pads))


def _by_taps(request: MeasureRequest, before: StoredCalibration, notify: Notify) -> CalibrationResults:
    devices, piece, found = tapped(request.sound, request.kit, notify)
    return CalibrationResults(devices, rows_of_taps(found, piece, devices, before))


_Way = Callable[[MeasureRequest, StoredCalibration, Notify], CalibrationResults]
_WAYS: Mapping[str, _Way] = MappingProxyType(
    {REPORT: _by_report, LOOPBACK: _by_loopback, STRIKE: _by_strikes, TAP: _by_taps}
)
