"""What is asked of a session is checked before it begins, alike for the window, the terminal and a virtual student.

Each word goes through the parser of whoever uses it later, so that nothing is refused here that would have worked.
"""

from station.app.settings.view_settings import view_settings_of
from station.core.settings import Settings, setting_source
from station.engine.engine_config import EngineConfig
from station.motion.kit.kit import load_kit
from station.practice.control.pause_options import parse_pause
from station.practice.session.cues.click_options import parse_click
from station.practice.session.leading_hand import hands_of
from station.sound.click_sounds import blips_of
from station.sound.samples.load_kit import find_kit


def check_settings(settings: Settings) -> None:
    """Raise `BadInput` for the first setting that nobody understands; no device is asked, no sound read."""
    EngineConfig.from_settings(settings)
    find_kit(settings.drums)
    blips_of(settings.click)
    parse_click(settings.click_pattern, setting_source("click_pattern"))
    parse_pause(settings.pause, setting_source("pause"))
    hands_of(settings)
    if settings.stands:
        load_kit(settings.stands)
    settings.sessions_dir  # noqa: B018 - raises where there can be none
    view_settings_of(settings)
