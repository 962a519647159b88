"""What a demonstration looks like at one time: the drummer, the score, and what is said of where the player is."""

from dataclasses import dataclass

from station.core.units import NS_PER_S
from station.drills.directions import NO_DIRECTION, Direction, direction_at
from station.drills.lesson import Lesson
from station.motion.drummer import Drummer
from station.music.score import Score
from station.practice.demonstration.song_cues import CountIn
from station.practice.demonstration.song_player import SongPlayer, SongStep
from station.practice.now.tempo_now import demonstration_tempo
from station.practice.now.whereabouts import demonstration_place
from station.render.snapshot import BarNumbers, Hud, Snapshot
from station.scenes.score_words import bar_numbers


@dataclass(frozen=True, slots=True)
class PlayerView:
    """The player at `now_ns`, its `lesson`, and what is chosen for steps and sound; `is_shown` once it is used."""

    lesson: Lesson
    player: SongPlayer
    now_ns: int
    step: SongStep
    click: bool
    counts_in: bool
    is_shown: bool

    @property
    def position_ns(self) -> int:
        """Where in the song it is."""
        return self.player.position_ns(self.now_ns)


@dataclass(frozen=True, slots=True, eq=False)
class Counting:
    """The count-in before it goes on, None for none, and how much of it is left."""

    count_in: CountIn | None
    left_ns: int


def demo_snapshot(view: PlayerView, counting: Counting, drummer: Drummer, seen: Score) -> Snapshot:
    """The picture of the demonstration; `seen` is the score that `drummer` plays."""
    position_s = view.position_ns / NS_PER_S
    raising_s = counting.left_ns / NS_PER_S if position_s == 0 else 0.0  # while the beginning is counted in
    direction = _direction(view)
    return Snapshot(
        score=seen,
        position_s=position_s,
        kit=drummer.kit,
        figure=drummer.figure,
        pose=drummer.pose(position_s - raising_s),
        limbs=drummer.assignment.limbs,
        hud=_hud(view, counting, direction),
        bar_numbers=demo_bar_numbers(view.lesson),
        beat_ticks=view.lesson.beat_ticks,
        view=direction.view,
    )


def demo_bar_numbers(lesson: Lesson) -> BarNumbers:
    """Those of the whole lesson."""
    return bar_numbers(lesson.sections, 0, lesson.score.bar_count)


def _direction(view: PlayerView) -> Direction:
    """What the lesson's cues say of where the player is, once it is used."""
    if not view.is_shown:
        return NO_DIRECTION
    bar = view.player.place(view.now_ns).bar
    return direction_at(view.lesson.cues, min(bar, view.lesson.score.bar_count - 1))


def _hud(view: PlayerView, counting: Counting, direction: Direction) -> Hud:
    player, place, song = view.player, view.player.place(view.now_ns), view.player.song
    tempo = demonstration_tempo(
        song.tempo_map, song.tick_at(view.position_ns), view.lesson.beat_ticks, player.speed_percent
    )
    return Hud(
        title=view.lesson.title,
        phase=demonstration_place(place, player.speed_percent, bool(counting.left_ns)).words,
        count_in=None if counting.count_in is None else counting.count_in.beat(counting.left_ns),
        bar=place.bar + 1,
        beat=place.beat + 1,
        beats=song.tempo_map.meter_at(song.tempo_map.bar_start(place.bar)).beats,
        bar_count=song.bar_count,
        beats_a_minute=tempo.now,
        tempo_words=tempo.words,
        say="" if counting.left_ns else direction.say,
    )
