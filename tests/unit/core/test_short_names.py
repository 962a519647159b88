"""Paths in what is said in passing, by hand."""

import pytest

from station.core.short_names import short_paths


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("kept in /home/ann/.config/drum-station/latency.toml", "kept in /home/…/drum-station/latency.toml"),
        (
            "left: it counts as yours (TD-17, in /home/ann/.config/drum-station/latency.toml; Devices changes it)",
            "left: it counts as yours (TD-17, in /home/…/drum-station/latency.toml; Devices changes it)",
        ),
        ("serial:/tmp/pytest-of-ann/pytest-12/kit@31250 is here", "serial:/tmp/…/pytest-12/kit@31250 is here"),
        ("serial:/dev/ttyUSB0@115200 is here", "serial:/dev/ttyUSB0@115200 is here"),
        ("no lesson in /a/b/c.toml", "no lesson in /a/b/c.toml"),
        ("4/4 at 80 bpm, kick/snare", "4/4 at 80 bpm, kick/snare"),
        ("", ""),
    ],
)
def test_long_paths_are_shortened_in_the_middle(said: str, shown: str) -> None:
    assert short_paths(said) == shown
