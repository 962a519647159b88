import pytest

from station.sound.drum_kit import DrumKit
from station.sound.synth.synth_kits import synth_kit
from tests.unit.sound.kits import RATE_HZ


@pytest.fixture(scope="session")
def kit() -> DrumKit:
    return synth_kit(RATE_HZ)
