"""What is set once and kept: the first start, views, how sessions go, who demonstrates on which kit."""

from dataclasses import replace
from typing import assert_never

from station.app.actions.battle_actions import OpenBattle
from station.app.actions.settings_actions import (
    Embody,
    FinishFirstStart,
    KeepViewpoint,
    KeptSetting,
    LeadWith,
    LearnPause,
    PutUp,
    SetPreferences,
    SetView,
)
from station.app.actions.style_actions import StyleAction
from station.app.settings.first_start import answered, play_along, student_level
from station.app.settings.view_settings import ViewSettings, with_view_settings
from station.app.station_parts import StationParts
from station.core.errors import StationError
from station.practice.lag.first_groove import FIRST_GROOVE


def keep_setting(parts: StationParts, action: KeptSetting) -> str | None:
    """Put it into the settings; returns a line for the user."""
    store = parts.store
    match action:
        case FinishFirstStart(answers, battles):
            store.update(lambda settings: answered(settings, answers))
            if answers is not None:
                parts.toasts.attempt(lambda: parts.engine.stand(student_level(store.now)))
                parts.chooser.show_anew()
                return parts.battle.act(OpenBattle()) if battles else _begin_first(parts)
        case SetView(view_settings):
            _set_view(parts, replace(view_settings, viewpoints=parts.view_settings.viewpoints))
        case KeepViewpoint(slot, camera):
            _set_view(parts, parts.view_settings.keeping(slot, camera))
            return f"viewpoint {slot + 1} is kept: {slot + 1} comes back to it"
        case SetPreferences(preferences):
            parts.preferences.put(preferences)
        case LearnPause(on):
            parts.preferences.learn(on)
        case LeadWith(hands):
            store.update(lambda settings: replace(settings, hands=hands.value))
            parts.chooser.show_anew()
        case PutUp(stands):
            store.update(lambda settings: replace(settings, stands=stands))
            parts.chooser.show_anew()
        case _:
            assert_never(action)
    return None


def _begin_first(parts: StationParts) -> str:
    """Let a newcomer hear the first groove at once, where that is what the station was opened on; what to do then."""
    if parts.chooser.lesson_name != FIRST_GROOVE:
        return ""
    parts.toasts.attempt(parts.store.write)  # nothing is written while somebody plays
    parts.make_ready()
    parts.chooser.begin()
    return play_along(parts.engine.kits)


def _set_view(parts: StationParts, view_settings: ViewSettings) -> None:
    parts.view_settings = view_settings
    parts.store.update(lambda settings: with_view_settings(settings, view_settings))


def restyle(parts: StationParts, action: StyleAction) -> None:
    """Let the demonstrator move otherwise, at once."""
    before = parts.style.demonstrator.figure
    parts.style.act(action, parts.sessions.practice.session.plan.lesson.score)
    parts.sessions.perform_as(parts.style.demonstrator)
    if parts.style.demonstrator.figure is not before:
        parts.chooser.show_anew()


def embody(parts: StationParts, action: Embody) -> None:
    """Let another drummer demonstrate; who cannot reach the kit leaves the one before in place."""
    before = parts.style.figure
    parts.style.embody(action.figure)
    parts.sessions.perform_as(parts.style.demonstrator)
    try:
        parts.chooser.show_anew()
    except StationError:  # out of reach
        parts.style.embody(before)
        parts.sessions.perform_as(parts.style.demonstrator)
        raise
    parts.store.update(lambda settings: replace(settings, figure=action.figure))
