"""A fake sound device: it asks for blocks when the test says so, and fails when the test says so."""

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.sound.output.card_output import Renderer


class FakeOutput:
    """An output of `rate_hz`; `faults` names the calls that fail (`start`, `pause`, `resume`)."""

    def __init__(self, name: str = "fake card", rate_hz: int = 48_000, *faults: str) -> None:
        self.name = name
        self.host = "fake host"
        self.rate_hz = rate_hz
        self.latency_ms: float | None = 3.0
        self.underflows = 0
        self.load = 0.25
        self.fault: DeviceError | None = None
        self.calls: list[str] = []
        self._faults = faults
        self._render: Renderer | None = None

    def start(self, render: Renderer) -> None:
        self._note("start")
        self._render = render

    def pause(self) -> None:
        self._note("pause")

    def resume(self) -> None:
        self._note("resume")

    def close(self) -> None:
        self._note("close")
        self._render = None

    def ask(self, frames: int, dac_ns: int) -> NDArray[np.float32]:
        """Play a block, as the driver would in its thread."""
        assert self._render is not None, "the output runs"
        return self._render(frames, dac_ns)

    def _note(self, call: str) -> None:
        self.calls.append(call)
        if call in self._faults:
            raise DeviceError(f"{self.name}: {call} failed")
