import pytest

from station.core.errors import DeviceError
from station.sound.output.list_outputs import outputs_now
from tests.fakes.jack_server import JackServer, jackd_is_installed


def test_a_lister_that_hangs_is_given_up() -> None:
    with pytest.raises(DeviceError, match="cannot be listed"):
        outputs_now(timeout_s=0.001)


@pytest.mark.jack
@pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed")
def test_a_server_is_seen_while_it_lives(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("JACK_NO_START_SERVER", "1")
    with JackServer() as server:
        monkeypatch.setenv("JACK_DEFAULT_SERVER", server.name)
        assert any("JACK" in found.host for found in outputs_now(60.0))
    assert not any("JACK" in found.host for found in outputs_now(60.0))
