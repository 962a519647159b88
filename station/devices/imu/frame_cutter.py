"""Cuts a stream of bytes into frames of one length, or into lines, and finds its way back after a loss.

Neither ever holds more than one frame or one line.
"""

from collections.abc import Callable


class FrameCutter:
    """Frames of `size` bytes that begin with `header` and that `is_sound` accepts.

    Where a frame is not sound one byte is dropped, and the search begins anew: a sound frame that follows is found.
    """

    def __init__(self, header: bytes, size: int, is_sound: Callable[[bytes], bool]) -> None:
        self._header = header
        self._size = size
        self._is_sound = is_sound
        self._waiting = b""
        self.good_bytes = 0
        self.bad_bytes = 0

    def feed(self, data: bytes) -> list[bytes]:
        """The frames that `data` completes."""
        stream, at, frames = self._waiting + data, 0, []
        while True:
            begin = stream.find(self._header, at)
            if begin < 0:
                begin = len(stream) - _begun(stream[at:], self._header)
            self.bad_bytes += begin - at
            at = begin
            if len(stream) - at < self._size:
                break
            frame = stream[at : at + self._size]
            if self._is_sound(frame):
                frames.append(frame)
                at += self._size
                self.good_bytes += self._size
            else:
                at += 1
                self.bad_bytes += 1
        self._waiting = stream[at:]
        return frames


def _begun(stream: bytes, header: bytes) -> int:
    """How many bytes at the end of `stream` may be the beginning of a header."""
    return next((count for count in range(len(header) - 1, 0, -1) if stream.endswith(header[:count])), 0)


class LineCutter:
    """Lines that end with a line feed, which is cut off; bytes of a line longer than `longest` are `dropped_bytes`."""

    def __init__(self, longest: int) -> None:
        self._longest = longest
        self._waiting = b""
        self.dropped_bytes = 0

    def feed(self, data: bytes) -> list[bytes]:
        """The lines that `data` completes."""
        *lines, self._waiting = (self._waiting + data).split(b"\n")
        if len(self._waiting) > self._longest:
            self.dropped_bytes += len(self._waiting)
            self._waiting = b""
        return lines
