import pytest

from station.core.errors import DeviceError
from station.sound.card_output import SoundDevice
from station.sound.outputs_now import default_has_changed, outputs_now
from tests.fakes.jack_server import JackServer, jackd_is_installed


def device(name: str, is_default: bool) -> SoundDevice:
    return SoundDevice(0, name, "ALSA", 2, 48_000, is_default)


@pytest.mark.parametrize(
    ("devices", "changed"),
    [
        ([device("card", True), device("phones", False)], False),
        ([device("phones", True), device("card", False)], True),
        ([device("card", False)], False),  # no default: nothing to move to
        ([], False),
    ],
)
def test_another_default_is_noticed(devices: list[SoundDevice], changed: bool) -> None:
    assert default_has_changed("card", devices) is changed


def test_a_lister_that_hangs_is_given_up() -> None:
    with pytest.raises(DeviceError, match="cannot be listed"):
        outputs_now(patience_s=0.001)


@pytest.mark.jack
@pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed")
def test_a_server_is_seen_while_it_lives(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("JACK_NO_START_SERVER", "1")
    with JackServer() as server:
        monkeypatch.setenv("JACK_DEFAULT_SERVER", server.name)
        assert any("JACK" in found.host for found in outputs_now(60.0))
    assert not any("JACK" in found.host for found in outputs_now(60.0))
