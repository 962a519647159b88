"""The page of sounds: what is set holds at once where it can, and is heard while it is set.

Levels, the drum kit and the click's voice change in mid-session too; what clicks where, the track and the output are
those of the next session. What is tried (a kit or a voice under the mouse) sounds until the mouse goes elsewhere, and
never while somebody plays.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import assert_never

from station.app.actions.sound_actions import (
    ChooseClick,
    ChooseDrums,
    HearClick,
    HearDrums,
    LookForSounds,
    MuteChannel,
    OutputChoice,
    SetChannel,
    SetClickPattern,
    SetHeard,
    SoloChannel,
    SoundAction,
    SoundOwnStrokes,
    StopHearing,
    UseOutput,
)
from station.app.engine_client import EngineClient
from station.app.sessions.session_control import SessionControl
from station.app.settings.settings_store import SettingsStore
from station.app.sound.kit_shelf import SoundShelf, sound_shelf
from station.app.sound.mixing_desk import changed, desk_commands, levels_of, with_level
from station.app.sound.output_change import OutputChange, choice_of
from station.app.sound.preview_groove import click_bar, groove
from station.app.sound.track_desk import TrackDesk, TrackView
from station.app.sound.tried_sounds import TriedSounds
from station.app.worker_process import StartWork, Work
from station.core.errors import BadInput, StationError
from station.core.settings import Settings, setting_source
from station.engine.levels_option import USUAL, ChannelLevel
from station.engine.messages import EngineEvent, SetSounds
from station.music.tempo import MeterChange
from station.practice.session.cues.click_options import click_text, parse_click
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern


@dataclass(frozen=True, slots=True)
class SoundView:
    """What the page shows beside the settings.

    `pattern` is what clicks over bars of `beats` beats, `levels` the channels that were set, `solo` those that are
    heard alone, `muted` those whose level comes back; `shelf` what kits and outputs there are, None while it is looked;
    `tried` the kit or click that is heard to try it, `is_awaited` while it is read; `changing` whether another output
    is being opened; `is_playing` while a session has the sound; `output` what was chosen, `sounding` where the sound
    goes; `track` what is played along to.
    """

    pattern: ClickPattern = PLAIN
    beats: int = 4
    levels: tuple[tuple[str, ChannelLevel], ...] = ()
    solo: frozenset[str] = frozenset()
    muted: frozenset[str] = frozenset()
    shelf: SoundShelf | None = None
    tried: str = ""
    is_awaited: bool = False
    changing: bool = False
    is_playing: bool = False
    output: OutputChoice = field(default_factory=lambda: choice_of(Settings()))
    sounding: str = ""
    rate_hz: int = 48_000
    track: TrackView = field(default_factory=TrackView)

    def level(self, channel: str) -> ChannelLevel:
        """How loud a channel is set, and on which side."""
        return dict(self.levels).get(channel, USUAL)


@dataclass(frozen=True, slots=True)
class SoundSurroundings:
    """What the page needs of the station.

    `quarters_a_minute` is the tempo that is chosen, `rest` lets the engine's devices go, `notify` shows a line, `start`
    begins work in a process of its own.
    """

    quarters_a_minute: Callable[[], float]
    rest: Callable[[], object]
    notify: Callable[[str], None]
    start: StartWork


class SoundPage:
    """The page over the settings of `store`."""

    def __init__(
        self,
        store: SettingsStore,
        engine: EngineClient,
        sessions: SessionControl,
        around: SoundSurroundings,
    ) -> None:
        self._store, self._engine, self._sessions, self._around = store, engine, sessions, around
        self._looking: Work[SoundShelf] | None = None
        self._shelf: SoundShelf | None = None
        self._solo: frozenset[str] = frozenset()
        self._muted: dict[str, ChannelLevel] = {}
        self._chosen_before: SetSounds | None = None  # what to go back to where the chosen cannot be had
        self.tried = TriedSounds(engine, sessions, self._chosen)
        self.output = OutputChange(store, engine, around.rest, around.notify)
        self.track = TrackDesk(store, engine, sessions, around.start)

    def view(self) -> SoundView:
        """What is shown."""
        return SoundView(
            pattern=self._pattern(),
            beats=self._meter().beats,
            levels=tuple(levels_of(self._store.now).items()),
            solo=self._solo,
            muted=frozenset(self._muted),
            shelf=self._shelf,
            tried=self.tried.name,
            is_awaited=self.tried.is_awaited,
            changing=self.output.is_changing,
            is_playing=self._sessions.practice.is_playing,
            output=self.output.chosen,
            sounding=self._engine.sound,
            rate_hz=self._engine.rate_hz,
            track=self.track.view(),
        )

    def look(self) -> None:
        """Look which kits and outputs there are, unless a look is on its way."""
        if self._looking is None:
            self._looking = self._around.start(sound_shelf)

    def leave(self) -> None:
        """The page is no longer seen: nothing is tried, and no channel is heard alone."""
        self.tried.stop()
        self.track.stop()
        if self._solo:
            self._tell(lambda: self._set_solo(frozenset()))

    def close(self) -> None:
        """End what is looked for and read."""
        self.track.close()
        self._end_look()

    def _end_look(self) -> None:
        if self._looking is not None:
            self._looking.end()
            self._looking = None

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, now_ns: int) -> None:
        """Take what was found, move on with what is tried and with an output that is changed; raises `StationError`."""
        found = None if self._looking is None else self._found(self._looking)
        if found is not None:
            self._shelf = found
            self._end_look()
        self.tried.advance()
        self.output.advance(now_ns)
        self.track.advance(now_ns)

    def _found(self, looking: Work[SoundShelf]) -> SoundShelf | None:
        try:
            return looking.result()
        except StationError as fault:
            return SoundShelf((), (), str(fault))

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine."""
        self.output.handle(event)
        fault = self.tried.handle(event)
        if fault is None:
            return
        if self._chosen_before is not None and not self.tried.name:  # what was chosen cannot be had
            before, self._chosen_before = self._chosen_before, None
            self._store.update(lambda settings: replace(settings, drums=before.drums, click=before.click))
            self._engine.stand(before)
        self._around.notify(f"{fault}; the sounds before play on")

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: SoundAction) -> None:
        """Do what the user asks; raises `StationError`."""
        match action:
            case SetClickPattern(pattern):
                self._store.update(lambda settings: replace(settings, click_pattern=click_text(pattern)))
                self._hear_click(self._store.now.click)
            case HearClick(click):
                self._hear_click(click or self._store.now.click)
            case HearDrums(drums):
                self.tried.hear(drums, replace(self._chosen(), drums=drums), groove())
            case StopHearing():
                self.tried.stop()
            case ChooseClick(click):
                self._choose(replace(self._chosen(), click=click))
            case ChooseDrums(drums):
                self._choose(replace(self._chosen(), drums=drums))
            case SetChannel() | MuteChannel() | SoloChannel() | SoundOwnStrokes() | SetHeard() as level:
                self._tell(lambda: self._set_level(level))
            case LookForSounds():
                self.look()
            case UseOutput(choice):
                self.tried.stop()
                self.output.ask(choice)
            case _:
                self.track.act(action)

    # --- the click and the drums -------------------------------------------------------------------------------------

    def _chosen(self) -> SetSounds:
        return SetSounds(self._store.now.drums, self._store.now.click)

    def _choose(self, sounds: SetSounds) -> None:
        self._chosen_before = self._chosen()
        self._store.update(lambda settings: replace(settings, drums=sounds.drums, click=sounds.click))
        self._engine.stand(sounds)
        self.tried.chose(sounds)

    def _pattern(self) -> ClickPattern:
        try:
            return parse_click(self._store.now.click_pattern, setting_source("click_pattern"))
        except BadInput:  # said where it is asked for; what is set here takes its place
            return PLAIN

    def _meter(self) -> MeterChange:
        return self._sessions.player.lesson.score.tempo_map.meter_at(0)

    def _hear_click(self, click: str) -> None:
        bar = click_bar(replace(self._pattern(), gap=None), self._meter(), self._around.quarters_a_minute())
        self.tried.hear(click, replace(self._chosen(), click=click), bar)

    # --- levels ------------------------------------------------------------------------------------------------------

    def _tell(self, change: Callable[[], None]) -> None:
        """Make a change, and tell the engine what it comes to."""
        before = desk_commands(self._store.now, self._solo)
        change()
        for command in changed(before, desk_commands(self._store.now, self._solo)):
            self._engine.stand(command)

    def _set_level(self, action: SetChannel | MuteChannel | SoloChannel | SoundOwnStrokes | SetHeard) -> None:
        match action:
            case SetChannel(channel, level):
                self._muted.pop(channel, None)
                self._put(channel, level)
            case MuteChannel(channel):
                self._mute(channel)
            case SoloChannel(channel):
                self._set_solo(self._solo ^ {channel})
            case SoundOwnStrokes(on):
                self._update(lambda settings: replace(settings, own_sound=on))
            case SetHeard(heard):
                self._update(lambda settings: replace(settings, heard=heard))
            case _:
                assert_never(action)

    def _update(self, change: Callable[[Settings], Settings]) -> None:
        self._store.update(change)

    def _put(self, channel: str, level: ChannelLevel) -> None:
        self._update(lambda settings: with_level(settings, channel, level))

    def _mute(self, channel: str) -> None:
        """The words know no other mute than level 0: what it was is kept here, as long as the window is open."""
        now = levels_of(self._store.now).get(channel, USUAL)
        if now.level > 0.0:
            self._muted[channel] = now
            self._put(channel, replace(now, level=0.0))
        else:
            self._put(channel, self._muted.pop(channel, replace(now, level=1.0)))

    def _set_solo(self, solo: frozenset[str]) -> None:
        self._solo = solo
