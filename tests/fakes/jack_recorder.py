"""Records what a program plays into JACK, in a process of its own, with the monotonic time of every frame.

As a program: `python -m tests.fakes.jack_recorder FILE.npz`. It says `ready`, then obeys `connect REGEX` (the outputs
of the program to be heard; says `connected`) and `stop` (writes FILE and says `done`).
"""

import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from tests.fakes.child import Child, say
from tests.fakes.jack_server import JackServer

_CONNECT_WITHIN_S = 10.0
_WINDOW_BLOCKS = 200
_GAP_FRAMES = 16
_AUDIBLE = 0.001
"""A sound that ends by itself has faded below this."""


@dataclass(frozen=True)
class Recording:
    """What was heard: `sound` float32 (n, 2); `at_ns` (n,) the monotonic time at which JACK took each frame."""

    sound: NDArray[np.float32]
    at_ns: NDArray[np.int64]
    rate_hz: int
    lost_frames: int

    def onsets(self, threshold: float = 0.002, rise: float = 3.0, dead_ms: float = 40.0) -> list[int]:
        """The frames at which sound sets in, also over what still rings.

        An onset is where the peak of a millisecond exceeds `threshold` and `rise` times the peak of the ten
        milliseconds before; the next one follows `dead_ms` later at the earliest. The frame is the first within the
        millisecond above both. Peaks are those of the sound's steps from frame to frame, in which a stick's attack
        stands out of a ringing drum. Where a missed block cuts a hole into the sound there is no onset.
        """
        level = np.abs(np.diff(self.sound, axis=0, prepend=0.0)).max(axis=1)
        width = self.rate_hz // 1000
        peaks = level[: len(level) // width * width].reshape(-1, width).max(axis=1)
        found: list[int] = []
        next_window = 0
        for window in range(1, len(peaks)):
            before = max(threshold, rise * peaks[max(0, window - 10) : window].max())
            if window >= next_window and peaks[window] > before:
                frame = window * width + int(np.argmax(level[window * width : (window + 1) * width] > before))
                if not self._is_edge_of_gap(frame):
                    found.append(frame)
                    next_window = window + round(dead_ms)
        return found

    def _is_edge_of_gap(self, frame: int) -> bool:
        """Whether sound breaks off at `frame`, or goes on there after it broke off: the driver missed a block."""
        if not self.sound[frame : frame + _GAP_FRAMES].any():
            return True
        before = np.flatnonzero(self.sound[:frame].any(axis=1))
        broke_off = int(before[-1]) if len(before) else 0
        return frame - broke_off > _GAP_FRAMES and bool(np.abs(self.sound[broke_off]).max() > _AUDIBLE)

    def centroid_hz(self, frame: int, for_ms: float = 60.0) -> float:
        """The centre of gravity of the power spectrum of the sound that follows `frame`."""
        part = self.sound[frame : frame + round(for_ms * self.rate_hz / 1000)].mean(axis=1)
        power = np.abs(np.fft.rfft(part * np.hanning(2 * len(part))[len(part) :])) ** 2
        return float(np.fft.rfftfreq(len(part), 1 / self.rate_hz) @ power / power.sum())


class JackRecorder:
    """The recorder as the test sees it."""

    def __init__(self, server: JackServer, folder: Path) -> None:
        self._rate_hz = server.rate_hz
        self._file = folder / "heard.npz"
        self._child = Child(__name__, [str(self._file)], server.env)

    def connect(self, pattern: str) -> None:
        """Listen to the audio outputs whose full names match `pattern`."""
        self._child.tell(f"connect {pattern}")
        self._child.expect("connected")

    def stop(self) -> Recording:
        """End recording; everything that was heard since the start."""
        self._child.tell("stop")
        self._child.expect("done")
        with np.load(self._file) as heard:
            return timed(heard["sound"], heard["first_frame"], heard["called_ns"], self._rate_hz)

    def __enter__(self) -> "JackRecorder":
        return self

    def __exit__(self, *_: object) -> None:
        self._child.stop()


def timed(
    sound: NDArray[np.float32], first_frame: NDArray[np.int64], called_ns: NDArray[np.int64], rate_hz: int
) -> Recording:
    """Give every frame its time: a callback comes soon after its period begins or late, but never before.

    A server that stalls goes on with the next frame later (the offset between frames and time jumps up), or with a
    later frame (it jumps down, where the frame numbers do).
    """
    frames_in_block = len(sound) // len(first_frame)
    begin_ns = first_frame * 1e9 / rate_hz
    skipped = np.diff(first_frame) - frames_in_block
    stretches = np.split(called_ns - begin_ns, np.flatnonzero(skipped) + 1)
    begin_ns += np.concatenate([_base(offsets_ns) for offsets_ns in stretches])
    at_ns = (begin_ns[:, None] + np.arange(frames_in_block) * 1e9 / rate_hz).ravel()
    return Recording(sound, np.round(at_ns).astype(np.int64), rate_hz, int(skipped.sum()))


def _base(offset_ns: NDArray[np.float64]) -> NDArray[np.float64]:
    """The offset below which no callback came, which may rise: the higher of the least before and the least after."""
    width = min(_WINDOW_BLOCKS, len(offset_ns))
    least: NDArray[np.float64] = sliding_window_view(offset_ns, width).min(axis=1)  # of each window of full width
    last_window = len(least) - 1
    block = np.arange(len(offset_ns))
    base: NDArray[np.float64] = np.maximum(
        least[np.clip(block - width + 1, 0, last_window)], least[np.clip(block, 0, last_window)]
    )
    return base


class _Listener:
    """A JACK client that keeps every block of its two inputs."""

    def __init__(self) -> None:
        import jack  # needs JACK's library, which a machine may lack

        self.client = jack.Client("recorder", no_start_server=True)
        self._inputs = [self.client.inports.register(name) for name in ("left", "right")]
        self._blocks: list[NDArray[np.float32]] = []
        self._first_frames: list[int] = []
        self._called_ns: list[int] = []
        self.client.set_process_callback(self._take)
        self.client.activate()

    def _take(self, _: int) -> None:
        self._called_ns.append(time.monotonic_ns())
        self._first_frames.append(self.client.last_frame_time)
        self._blocks.append(np.column_stack([port.get_array() for port in self._inputs]))

    def connect(self, pattern: str) -> None:
        give_up_s = time.monotonic() + _CONNECT_WITHIN_S
        while time.monotonic() < give_up_s:
            found = self.client.get_ports(pattern, is_audio=True, is_output=True)
            if len(found) >= len(self._inputs):
                for source, target in zip(found, self._inputs, strict=False):
                    self.client.connect(source, target)
                return
            time.sleep(0.02)
        raise RuntimeError(f"no two audio outputs match {pattern!r}")

    def write(self, path: Path) -> None:
        self.client.deactivate()
        count = min(len(self._blocks), len(self._first_frames))
        np.savez(
            path,
            sound=np.concatenate(self._blocks[:count]),
            first_frame=np.array(self._first_frames[:count], np.int64),
            called_ns=np.array(self._called_ns[:count], np.int64),
        )
        self.client.close()


def main(path: str) -> None:
    """The child's whole life."""
    listener = _Listener()
    say("ready")
    for line in sys.stdin:
        word, _, rest = line.strip().partition(" ")
        if word == "connect":
            listener.connect(rest)
            say("connected")
        elif word == "stop":
            listener.write(Path(path))
            say("done")
            return


if __name__ == "__main__":
    main(*sys.argv[1:])
