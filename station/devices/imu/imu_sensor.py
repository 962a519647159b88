"""One motion sensor: its bytes in, `core.events` out; the same for live bytes and captures."""

from station.core.events import SensorEvent, SensorMounted, SensorSamples, SensorStatus
from station.core.imu import ImuSample, Mounting
from station.core.units import NS_PER_S
from station.devices.imu.detect_protocol import DetectingDecoder
from station.devices.imu.imu_reading import Reading, Told
from station.devices.imu.sample_clock import SampleClock

STATUS_EVERY_NS = NS_PER_S


class ImuSensor:
    """A sensor called `device`, mounted so; all that its bytes say goes by what came since it was made or reset."""

    def __init__(self, device: str, mounting: Mounting) -> None:
        self.mounting = mounting
        self._device = device
        self.reset()

    def reset(self) -> None:
        """Start afresh: with the next bytes it says how it is mounted."""
        self._is_announced = False
        self._decoder = DetectingDecoder()
        self._clock: SampleClock | None = None
        self._last_ns: int | None = None
        self._told = Told()
        self._next_status_ns: int | None = None

    def found(self, at_ns: int) -> SensorMounted:
        """It is here, and is mounted so."""
        self._is_announced = True
        return SensorMounted(at_ns, self._device, self.mounting)

    def feed(self, data: bytes, at_ns: int) -> list[SensorEvent]:
        """What the bytes that came at `at_ns` bring."""
        if not data:  # a capture that begins has no bytes to say how a sensor stands
            return []
        events: list[SensorEvent] = [] if self._is_announced else [self.found(at_ns)]
        if self._next_status_ns is None:
            self._next_status_ns = at_ns + STATUS_EVERY_NS
        samples = self._samples(data, at_ns)
        if samples:
            events.append(SensorSamples(at_ns, self._device, samples))
        if at_ns >= self._next_status_ns:
            self._next_status_ns = at_ns + STATUS_EVERY_NS
            events.append(self._status(at_ns))
        return events

    def _samples(self, data: bytes, at_ns: int) -> tuple[ImuSample, ...]:
        heard = self._decoder.feed(data, at_ns)
        protocol = self._decoder.protocol
        if protocol is None:  # not known yet, or no longer
            self._last_ns, self._clock = self._clock.last_ns if self._clock else self._last_ns, None
            return ()
        if self._clock is None:
            self._clock = SampleClock(protocol.ticks, protocol.rates_hz, self._last_ns)
        readings = []
        for each in heard:
            if isinstance(each, Reading):
                readings.append(each)
            else:
                self._take(each)
        times = self._clock.stamps(readings)
        return tuple(
            ImuSample(time_ns, reading.acceleration_m_s2, reading.rate_rad_s, reading.orientation)
            for time_ns, reading in zip(times, readings, strict=True)
            if time_ns is not None
        )

    def _take(self, told: Told) -> None:
        """Keep what the sensor tells of itself; what it does not tell this time stays."""
        old = self._told
        battery = old.battery if told.battery is None else told.battery
        temperature_c = old.temperature_c if told.temperature_c is None else told.temperature_c
        self._told = Told(battery, temperature_c, told.note or old.note)

    def _status(self, at_ns: int) -> SensorStatus:
        clock, protocol = self._clock, self._decoder.protocol
        return SensorStatus(
            at_ns,
            self._device,
            "" if protocol is None else protocol.name,
            None if clock is None else clock.rate_hz,
            0 if clock is None else clock.samples,
            0 if clock is None else clock.lost,
            self._decoder.bad_bytes,
            self._told.battery,
            self._told.temperature_c,
            self._told.note,
        )
