"""A JACK server for each test that asks for one, joined by this process and its children."""

from collections.abc import Iterator

import pytest

from tests.fakes.jack_server import JackServer, jackd_is_installed, joined

PERIOD_FRAMES = 256
"""5 ms: the tests ask whether all that was played is heard, on machines that may be shared; benchmarks ask how soon."""


@pytest.fixture
def jack_server() -> Iterator[JackServer]:
    if not jackd_is_installed():
        pytest.skip("jackd is not installed: apt install jackd2")
    with JackServer(period_frames=PERIOD_FRAMES, patient=True) as server, joined(server):
        yield server
