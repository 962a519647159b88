"""Cuts a stream of MIDI bytes into messages: running status, interleaved real-time bytes, system exclusive, line noise.

A message is `bytes` with its status byte first, also where the line left it out (running status). Data bytes that no
status explains, system exclusive that never ends and undefined statuses are dropped: nothing is ever guessed.

Source: MIDI 1.0 Detailed Specification 4.2, "Data format" (running status, real-time bytes inside other messages,
any status but real time ends system exclusive) and table I (lengths).
"""

_DATA_BYTES = {0x8: 2, 0x9: 2, 0xA: 2, 0xB: 2, 0xC: 1, 0xD: 1, 0xE: 2}
"""Data bytes that follow a channel status, by its high four bits."""
_SYSTEM_COMMON = {0xF1: 1, 0xF2: 2, 0xF3: 1, 0xF6: 0}
"""Data bytes that follow a system common status; F4 and F5 are undefined."""
_UNDEFINED_REAL_TIME = frozenset({0xF9, 0xFD})

_SYSEX = 0xF0
_END_OF_SYSEX = 0xF7
_FIRST_STATUS = 0x80
_FIRST_SHORTER = 0xC0  # from here on statuses have other lengths; all below it are followed by two bytes
_NOTE_LENGTH = 3
_FIRST_SYSTEM = 0xF0
_FIRST_REAL_TIME = 0xF8

LONGEST_SYSEX = 65_536
"""Longer system exclusive is dropped (our choice: bulk dumps of drum modules are a few kilobytes a message)."""


class MidiTokenizer:
    """Bytes in, whole messages out; keeps what a message still lacks until its bytes come."""

    def __init__(self) -> None:
        self._status = 0  # 0: no status is in force and data bytes mean nothing
        self._needed = 0
        self._data = bytearray()

    def reset(self) -> None:
        """Forget a half message and the running status, as after a lost connection."""
        self._status = 0
        self._data.clear()

    def unfinished(self) -> bytes:
        """Bytes that bring a new tokenizer to this one's state."""
        if not self._status:
            return bytes((_END_OF_SYSEX,))  # ends whatever is in force and is no message by itself
        return bytes((self._status, *self._data))

    def feed(self, data: bytes) -> list[bytes]:
        """The messages that `data` completes, in order; the same for any division of the stream into pieces."""
        if (
            len(data) == _NOTE_LENGTH
            and _FIRST_STATUS <= data[0] < _FIRST_SHORTER
            and data[1] < _FIRST_STATUS > data[2]
        ):
            self._status, self._needed = data[0], 2  # one whole message, as ports give them: the common case, fast
            self._data.clear()
            return [bytes(data)]
        messages: list[bytes] = []
        for byte in data:
            if byte < _FIRST_STATUS:
                self._feed_data(byte, messages)
            elif byte >= _FIRST_REAL_TIME:
                if byte not in _UNDEFINED_REAL_TIME:
                    messages.append(bytes((byte,)))
            else:
                self._feed_status(byte, messages)
        return messages

    def _feed_status(self, status: int, messages: list[bytes]) -> None:
        if status == _END_OF_SYSEX:
            if self._status == _SYSEX:
                messages.append(bytes((_SYSEX, *self._data, _END_OF_SYSEX)))
            self.reset()
            return
        self._data.clear()
        if status < _FIRST_SYSTEM:
            self._status, self._needed = status, _DATA_BYTES[status >> 4]
        elif status == _SYSEX:
            self._status = _SYSEX
        else:
            self._begin_system_common(status, messages)

    def _begin_system_common(self, status: int, messages: list[bytes]) -> None:
        self._needed = _SYSTEM_COMMON.get(status, 0)
        self._status = status if self._needed else 0
        if status in _SYSTEM_COMMON and not self._needed:
            messages.append(bytes((status,)))

    def _feed_data(self, byte: int, messages: list[bytes]) -> None:
        if not self._status:
            return
        self._data.append(byte)
        if self._status == _SYSEX:
            if len(self._data) > LONGEST_SYSEX:
                self.reset()
        elif len(self._data) == self._needed:
            messages.append(bytes((self._status, *self._data)))
            self._data.clear()
            if self._status >= _FIRST_SYSTEM:
                self._status = 0  # system common has no running status
