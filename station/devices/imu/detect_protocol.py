"""Finds out from the bytes alone which protocol a sensor speaks, so that nobody has to say, and a capture plays alike.

All decoders listen until one of them has understood a few messages and most of the bytes. What came before is then
decoded by it, each chunk with its own time: nothing is lost. A sensor that says nothing readable any more is listened
to anew, for its settings may have been changed.
"""

from station.devices.imu.imu_protocols import PROTOCOLS, ImuProtocol
from station.devices.imu.imu_reading import Heard, ImuDecoder, Reading

_READINGS = 3
"""So many measurements make a protocol known (our choice: no other's bytes have as many by chance)."""
_UNDERSTOOD = 0.5
"""The least share of all bytes that they must be of: a line may begin in the middle of a message."""
_MOST_KEPT = 4_096
"""Bytes that are kept until it is known: a second of the slowest sensor, and more messages than are needed of any."""
_UNREADABLE = 4_096
"""After so many bytes with nothing sound among them it is found out anew (our choice)."""


class DetectingDecoder:
    """Decodes one sensor's bytes by whichever protocol they are of."""

    def __init__(self) -> None:
        self.protocol: ImuProtocol | None = None
        """The protocol that is spoken, None until it is known."""
        self.bad_bytes = 0
        """The bytes that belong to no sound message."""
        self._decoder: ImuDecoder | None = None
        self._unreadable = 0
        self._begin()

    def _begin(self) -> None:
        self._kept: list[tuple[bytes, int]] = []  # what came, and when
        self._kept_bytes = 0
        self._candidates = {name: (each.decoder(), [0]) for name, each in PROTOCOLS.items()}

    def feed(self, data: bytes, at_ns: int) -> list[Heard]:
        """What the bytes that came at `at_ns`, and those before them, are now known to say."""
        if self._decoder is None:
            return self._listen(data, at_ns)
        before, sound = self._decoder.bad_bytes, self._decoder.good_bytes
        heard = self._decoder.feed(data, at_ns)
        self.bad_bytes += self._decoder.bad_bytes - before
        self._unreadable = 0 if self._decoder.good_bytes > sound else self._unreadable + len(data)
        if self._unreadable >= _UNREADABLE:
            self._decoder = self.protocol = None
            self._begin()
        return heard

    def _listen(self, data: bytes, at_ns: int) -> list[Heard]:
        self._kept.append((data, at_ns))
        self._kept_bytes += len(data)
        for name, (decoder, count) in self._candidates.items():
            count[0] += sum(isinstance(each, Reading) for each in decoder.feed(data, at_ns))
            if count[0] >= _READINGS and decoder.good_bytes >= _UNDERSTOOD * self._kept_bytes:
                return self._found(PROTOCOLS[name])
        if self._kept_bytes > _MOST_KEPT:
            self.bad_bytes += self._kept_bytes
            self._begin()
        return []

    def _found(self, protocol: ImuProtocol) -> list[Heard]:
        self.protocol, self._decoder, self._unreadable = protocol, protocol.decoder(), 0
        heard = [each for data, at_ns in self._kept for each in self._decoder.feed(data, at_ns)]
        self.bad_bytes += self._decoder.bad_bytes
        self._kept, self._candidates = [], {}
        return heard
