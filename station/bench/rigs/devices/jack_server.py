"""A JACK server of our own: the sound card and the MIDI bus of a machine that has neither, for benchmarks and tests.

`JackServer` starts `jackd` with its dummy driver as a child, under a name that no other server has, and waits until a
client can really join. `JACK_DEFAULT_SERVER` in `env` leads children to it.

Where a busy machine holds a client up, JACK goes on without it, and MIDI that came for it in the meantime is gone. A
server that is `patient` waits for it (-S); it tells its clients of no latency, though.

JACK keeps a table of eight servers for the whole machine, and frees the place of one that was killed only for a server
of the same name. So the names come from a small pool, each guarded by a file lock that ends with its holder.
"""

import contextlib
import fcntl
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from types import TracebackType
from typing import IO, Self

START_WITHIN_S = 10.0
NAME_WITHIN_S = 60.0
POOL = 4
STOP_WITHIN_S = 2.0
ATTEMPTS = 3
_DIES_WITH_US = ["setpriv", "--pdeathsig", "KILL"] if shutil.which("setpriv") else []
_SHARED_MEMORY = Path("/dev/shm")  # where JACK keeps what its clients share
_LOCKS = _SHARED_MEMORY if _SHARED_MEMORY.is_dir() else Path(tempfile.gettempdir())
"""Where names are guarded: beside what they guard, which a container may share when its /tmp is its own."""
_CLIENT_TIMEOUT_MS = 2_000  # a client that stalls on a shared machine is not thrown out


def jackd_is_installed() -> bool:
    """Whether there is a program of that name."""
    return shutil.which("jackd") is not None


class JackServer:
    """A running server; use it as a context manager."""

    def __init__(
        self,
        rate_hz: int = 48_000,
        period_frames: int = 64,
        patient: bool = False,
        client_timeout_ms: int = _CLIENT_TIMEOUT_MS,
    ) -> None:
        self.rate_hz = rate_hz
        self.period_frames = period_frames
        self._timeout_options = [*(["-S"] if patient else []), f"-t{client_timeout_ms}"]
        self.name = ""
        self._lock: IO[bytes] | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._log: Path | None = None

    @property
    def env(self) -> dict[str, str]:
        """The environment for a child that shall join this server."""
        return {**os.environ, "JACK_DEFAULT_SERVER": self.name, "JACK_NO_START_SERVER": "1"}

    def start(self) -> None:
        """Start, under the name it had if it only halted.

        Tries again where a server dies young, and without real-time priority where that is not granted.
        """
        if self._lock is None:
            self._claim_name()
        faults = []
        for attempt in range(ATTEMPTS):
            self._launch(realtime=attempt == 0)
            if self._answers():
                return
            faults.append(self._read_log())
            self.halt()
        self.stop()
        raise RuntimeError("jackd did not start:\n" + "\n".join(faults))

    def halt(self) -> None:
        """End the server, by force if it hangs, and keep its name for the next start."""
        if self._process is not None:
            self._process.terminate()
            try:
                self._process.wait(STOP_WITHIN_S)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
            self._process = None
            for left_over in _SHARED_MEMORY.glob(f"jack*_{self.name}_*"):  # a server that is killed leaves its own
                left_over.unlink(missing_ok=True)
        if self._log is not None:
            self._log.unlink(missing_ok=True)
            self._log = None

    def stop(self) -> None:
        """End the server and give its name to others."""
        self.halt()
        if self._lock is not None:
            self._lock.close()
            self._lock = None

    def _claim_name(self) -> None:
        give_up_s = time.monotonic() + NAME_WITHIN_S
        while time.monotonic() < give_up_s:
            for number in range(POOL):
                self._lock = _locked(_LOCKS / f"drum-test-{number}.lock")
                if self._lock is not None:
                    self.name = f"drum-test-{number}"
                    return
            time.sleep(0.2)
        raise RuntimeError(f"all {POOL} names for JACK servers have been taken for {NAME_WITHIN_S} s")

    def _launch(self, realtime: bool) -> None:
        handle, path = tempfile.mkstemp(prefix="jackd-", suffix=".log")
        self._log = Path(path)
        options = [f"-n{self.name}", *self._timeout_options, "-R" if realtime else "-r"]
        driver = ["-d", "dummy", "-r", str(self.rate_hz), "-p", str(self.period_frames)]
        self._process = subprocess.Popen(
            [*_DIES_WITH_US, "jackd", *options, *driver],
            stdin=subprocess.DEVNULL,
            stdout=handle,
            stderr=subprocess.STDOUT,
        )
        os.close(handle)

    def _answers(self) -> bool:
        import jack  # noqa: PLC0415 - needs JACK's library, which a machine may lack

        assert self._process is not None
        jack.set_error_function(_say_nothing)  # it is not yet there, that is the point
        give_up_s = time.monotonic() + START_WITHIN_S
        while time.monotonic() < give_up_s and self._process.poll() is None:
            with contextlib.suppress(jack.JackError):
                client = jack.Client("probe", servername=self.name, no_start_server=True)
                begun = client.frame_time
                time.sleep(0.05)
                runs = client.frame_time != begun
                client.close()
                if runs:
                    return True
            time.sleep(0.05)
        return False

    def _read_log(self) -> str:
        return self._log.read_text(errors="replace") if self._log is not None else ""

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, fault: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()


def _locked(path: Path) -> IO[bytes] | None:
    """The file, locked until it is closed; None where somebody has it, maybe another user."""
    try:
        lock = path.open("wb")
    except PermissionError:
        return None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        lock.close()
        return None
    return lock


def _say_nothing(_: str) -> None:
    pass
