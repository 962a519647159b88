"""What the settings tell the engine's process."""

from station.core.settings import Settings
from station.engine.engine_config import EngineConfig
from station.engine.messages import Bus, SetLevel


def test_a_module_that_sounds_itself_silences_the_students_strokes() -> None:
    assert EngineConfig.from_settings(Settings(own_sound=False)).first_commands == (SetLevel(Bus.STUDENT, 0.0),)
    assert EngineConfig.from_settings(Settings()).first_commands == ()
