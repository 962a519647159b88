"""The protocols that a motion sensor may speak: one table, from which it is found out which it is."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.devices.imu.bno085_rvc import Bno085RvcDecoder
from station.devices.imu.imu_csv import ImuCsvDecoder
from station.devices.imu.imu_reading import ImuDecoder, Ticks
from station.devices.imu.witmotion import WitMotionBleDecoder, WitMotionDecoder
from station.devices.imu.witmotion_setup import RATES
from station.devices.imu.x_imu3 import XImu3Decoder


@dataclass(frozen=True, slots=True)
class ImuProtocol:
    """One protocol: its `title`, its `decoder`, and the `ticks` by which it tells time.

    `bauds` are the rates at which such sensors leave the factory, the usual one first; none where there is no wire.
    `rates_hz` are all that such a sensor can be set to, where they are few and samples can only be counted.
    """

    name: str
    title: str
    decoder: Callable[[], ImuDecoder]
    ticks: Ticks
    bauds: tuple[int, ...] = ()
    rates_hz: tuple[float, ...] = ()


_WIT_RATES_HZ = tuple(RATES)
PROTOCOLS: Mapping[str, ImuProtocol] = MappingProxyType(
    {
        each.name: each
        for each in (
            ImuProtocol("x-imu3", "x-IMU3", XImu3Decoder, Ticks.MICROSECONDS, (115_200,)),
            ImuProtocol("csv", "lines of CSV", ImuCsvDecoder, Ticks.MICROSECONDS, (115_200, 921_600)),
            ImuProtocol("bno085-rvc", "BNO085 in RVC mode", Bno085RvcDecoder, Ticks.INDEX_OF_256, (115_200,)),
            ImuProtocol(
                "witmotion", "WitMotion", WitMotionDecoder, Ticks.MILLISECONDS, (9_600, 115_200), _WIT_RATES_HZ
            ),
            ImuProtocol("witmotion-ble", "WitMotion Bluetooth", WitMotionBleDecoder, Ticks.NOTHING, (), _WIT_RATES_HZ),
        )
    }
)
