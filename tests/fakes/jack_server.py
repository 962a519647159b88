"""The JACK server of the benchmarks, joined by the process of a test."""

import contextlib
from collections.abc import Iterator

import pytest

from station.bench.rigs.devices.jack_server import JackServer, jackd_is_installed

__all__ = ["JackServer", "jackd_is_installed", "joined"]


@contextlib.contextmanager
def joined(server: JackServer) -> Iterator[None]:
    """Clients that this process and its children open meanwhile join `server`."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("JACK_DEFAULT_SERVER", server.name)
        patch.setenv("JACK_NO_START_SERVER", "1")
        yield
