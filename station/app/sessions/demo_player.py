"""The demonstration of the chosen lesson on its player: its picture at any time, and its sound through the engine.

Whatever the user does gives a new `SongPlayer`; where that one is heard, the engine gets its cues and the player waits
for the moment at which the engine says that they sound, so that picture and sound stay together. Backwards, wound and
stepped through, it is silent: drums cannot sound backwards.
"""

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import replace
from typing import assert_never

from station.app.actions.player_actions import (
    GoToFlag,
    KeepFlag,
    PlayerAction,
    PlayOrStop,
    Seek,
    SetCountIn,
    SetDemoClick,
    SetReverse,
    SetSpeed,
    SetStep,
    StepOnce,
    Wind,
)
from station.app.sessions.demo_drummer import DemoDrummer, DemonstratedLesson
from station.app.sessions.demo_picture import Counting, PlayerView, demo_bar_numbers, demo_snapshot
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.lesson import Lesson
from station.engine.messages import Command, Play, Stop
from station.motion.drummer import Drummer
from station.practice.demonstration.song_cues import SOUNDED_NS, CountIn, after, count_in_of, song_cues
from station.practice.demonstration.song_player import FLAGS, Song, SongPlayer, SongStep
from station.render.snapshot import Snapshot
from station.scenes.curves import ScoreCurves
from station.scenes.demonstrator import Demonstrator

LEAD_NS = 50 * NS_PER_MS
"""How long after a change the sound begins: the engine's way and a block of sound fit in (our choice)."""

_WAITING_NS = 1 << 62
"""A session time that never comes: until its sound is asked for, the player stands."""

_Controls = Seek | GoToFlag | KeepFlag | StepOnce | Wind | SetReverse

Control = Callable[[SongPlayer, int], SongPlayer]
"""What a control does with a player at a session time."""


class DemoPlayer:
    """One lesson's demonstration by `demonstrator`; commands for the engine go through `send`, which may not raise.

    `step`, `click` and `counts_in` are what the user has chosen for steps and sound; flags are kept for every lesson.
    The drummer of a lesson that is revised is made by `maker`, beside what goes on; without one when it is asked for.
    """

    def __init__(
        self,
        send: Callable[[Command], None],
        watched: DemonstratedLesson,
        demonstrator: Demonstrator | None = None,
        maker: Executor | None = None,
    ) -> None:
        self._send = send
        self._watched = watched
        self._drummer = DemoDrummer(watched, demonstrator or Demonstrator(), maker)
        self._flags: dict[str, tuple[int | None, ...]] = {}
        self._sounding_until_ns: int | None = None
        self._due = False
        self.now_ns = 0
        self._counting: CountIn | None = None  # what is counted before it goes on
        self.step, self.click = SongStep.BEAT, True
        self.counts_in = False
        """Whether a bar is counted before it plays."""
        self.player = SongPlayer(Song.of(watched.score))

    # --- what it plays -----------------------------------------------------------------------------------------------

    @property
    def lesson(self) -> Lesson:
        """What is demonstrated."""
        return self._watched.lesson

    def load(self, watched: DemonstratedLesson, bars: tuple[int, int] | None) -> None:
        """Take a lesson, its `bars` (first, last, from 1) as the loop; the same lesson stays where it is."""
        before, self._watched = self._watched, watched
        self._drummer.take(watched)
        if watched.lesson is not before.lesson:
            self.halt()
            self._flags[before.lesson.name] = self.player.flags
            flags = self._flags.get(watched.lesson.name, (None,) * FLAGS)
            self.player = SongPlayer(Song.of(watched.score), speed_percent=self.player.speed_percent, flags=flags)
        self.repeat(bars)

    def revise(self, watched: DemonstratedLesson, bars: tuple[int, int] | None) -> None:
        """Take the lesson as it was changed, its `bars` (first, last, from 1) as the loop: it goes on where it is.

        What sounds changes at once; who plays it changes when a drummer is ready.
        """
        counts, is_heard = self._left_ns > 0, self._sounding_until_ns is not None and self.player.is_heard
        at_ns = self.now_ns + (LEAD_NS if is_heard and not counts else 0)
        tick = self.player.song.tick_at(self.player.position_ns(at_ns))
        self._watched = watched
        song, loop = Song.of(watched.score), None if bars is None else (bars[0] - 1, bars[1] - 1)
        there_ns = int(song.tempo_map.ns_at(min(tick, song.end_tick)))
        self.player = replace(self.player, song=song, at_ns=there_ns, since_ns=at_ns).looped(at_ns, loop)
        self._drummer.revise(watched)
        if counts:
            self._sound_on()
        elif is_heard:
            self._counting = None
            self._send(Stop())
            self._begin_sound()

    def repeat(self, bars: tuple[int, int] | None) -> None:
        """Repeat these bars (first, last, from 1), None for the whole lesson once."""
        loop = None if bars is None else (bars[0] - 1, bars[1] - 1)
        if loop != self.player.loop:
            self.do(lambda player, now_ns: player.looped(now_ns, loop))

    def perform_as(self, demonstrator: Demonstrator) -> None:
        """Let another body or manner demonstrate from now on."""
        self._drummer.perform_as(demonstrator)

    @property
    def drummer(self) -> Drummer:
        """Who plays the whole lesson, in the present style."""
        return self._drummer.now()

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: PlayerAction) -> None:
        """Do what the user asks of the player."""
        match action:
            case SetStep(step):
                self.step = step
            case SetDemoClick(click):
                self.click = click
                self._sound_on()
            case SetCountIn(counts_in):
                self.counts_in = counts_in
            case PlayOrStop():
                self.do(_play_or_stop)
            case SetSpeed(percent, held):
                self.do(lambda player, now_ns: player.at_speed(now_ns, percent), held)
            case _:
                self.do(lambda player, now_ns: self._controlled(action, player, now_ns))

    def _controlled(self, action: _Controls, player: SongPlayer, now_ns: int) -> SongPlayer:
        match action:
            case Seek(at_ns):
                return player.sought(now_ns, at_ns)
            case GoToFlag(slot):
                return player.at_flag(now_ns, slot)
            case KeepFlag(slot):
                return player.flagged(now_ns, slot)
            case StepOnce(way):
                return player.stepped(now_ns, self.step, way)
            case Wind(way):
                return player.wound(now_ns, way)
            case SetReverse(reverse):
                return player.reversed(now_ns, reverse)
            case _:
                assert_never(action)

    def do(self, control: Control, held: bool = False) -> None:
        """Use a control; while it is `held` (a slider that is dragged), nothing sounds."""
        before, left_ns = self.player, self._left_ns
        self.player = control(before, self.now_ns)
        begins = self.player.is_heard and (left_ns > 0 or not before.is_heard)
        self._counting = self._count_in() if begins else None
        if held or self._sounding_until_ns is None or _course(self.player) != _course(before):
            self._sound(held)

    def halt(self) -> None:
        """Stop, where the user turns to something else."""
        if self.player.playing or self.player.wind:
            self.do(lambda player, now_ns: player.stopped(now_ns))

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, now_ns: int) -> None:
        """Move to `now_ns`; once a frame."""
        self.now_ns = now_ns
        self._drummer.advance()
        if self._due:
            self._begin_sound()
        self.player = self.player.stopped_at_end(now_ns)
        if not self.player.playing:
            self._sounding_until_ns = None
        elif self._sounding_until_ns is not None and now_ns >= self._sounding_until_ns:
            self._sound_on()

    def started(self, zero_ns: int) -> None:
        """The engine's transport runs from `zero_ns`: what was asked for sounds from then on."""
        if self._sounding_until_ns is not None:
            self.player = self.player.started(zero_ns + self._counted_ns)

    def _sound_on(self) -> None:
        """The same once more from where it is: only a count-in that still runs begins anew."""
        self._counting = self._counting if self._left_ns else None
        self._sound(held=False)

    def _sound(self, held: bool) -> None:
        """Let sound what the player plays from where it is, from the next frame on, or nothing."""
        if self._sounding_until_ns is not None:
            self._sounding_until_ns = None
            self._send(Stop())
        self._due = self.player.is_heard and not held
        if self._due:
            at_ns = self.player.position_ns(self.now_ns)
            self.player = replace(self.player, at_ns=at_ns, since_ns=_WAITING_NS)
            self._drummer.now()  # who may have to be made: then sound and picture begin together

    def _begin_sound(self) -> None:
        self._due = False
        cues = song_cues(self._watched.score, self.player, self._watched.click if self.click else None)
        cues = cues if self._counting is None else after(self._counting, cues)
        lead_ns = LEAD_NS + max(-int(cues["at_ns"].min(initial=0)), 0)  # a counted word begins before its beat
        self.player = self.player.started(self.now_ns + lead_ns + self._counted_ns)
        self._sounding_until_ns = self.now_ns + SOUNDED_NS + self._counted_ns
        self._send(Play(cues, lead_ns))

    # --- the count-in ------------------------------------------------------------------------------------------------

    def _count_in(self) -> CountIn | None:
        return count_in_of(self.player, self._watched.click) if self.counts_in else None

    @property
    def _counted_ns(self) -> int:
        return 0 if self._counting is None else self._counting.length_ns

    @property
    def _left_ns(self) -> int:
        """How much of the count-in is left."""
        return 0 if self._counting is None else min(max(self.player.since_ns - self.now_ns, 0), self._counted_ns)

    # --- the picture -------------------------------------------------------------------------------------------------

    @property
    def is_shown(self) -> bool:
        """Whether the player has been used: it runs, or stands elsewhere than at the start."""
        return bool(self.player.rate_percent) or self.player.position_ns(self.now_ns) > 0

    def view(self) -> PlayerView:
        """What its controls show."""
        return PlayerView(self.lesson, self.player, self.now_ns, self.step, self.click, self.counts_in, self.is_shown)

    def snapshot(self) -> Snapshot:
        """The picture of the demonstration."""
        drummer = self.drummer
        return demo_snapshot(self.view(), Counting(self._counting, self._left_ns), drummer, self._drummer.score)

    def curves(self) -> ScoreCurves:
        """The same for the graph."""
        return ScoreCurves(self.drummer, self.player.position_ns(self.now_ns) / NS_PER_S, demo_bar_numbers(self.lesson))


def _course(player: SongPlayer) -> tuple[object, ...]:
    """What makes up the sound; a flag does not."""
    return player.at_ns, player.since_ns, player.rate_percent, player.loop


def _play_or_stop(player: SongPlayer, now_ns: int) -> SongPlayer:
    return player.stopped(now_ns) if player.playing else player.played(now_ns)
