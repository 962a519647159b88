"""What tempo is it now, where did it begin, where does it lead: one answer for all that show a tempo.

All are beats a minute of the beat that the lesson counts, a dotted quarter in 6/8. Where the music itself changes its
tempo, beginning and target are those of the same place in the music, so that they can be compared.
"""

from dataclasses import dataclass

from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo import TempoMap
from station.practice.session.plan import Phase, Plan
from station.practice.session.session import Session


@dataclass(frozen=True, slots=True)
class TempoNow:
    """The tempo `now`; `began` and `target` None where there is none to tell.

    `percent` of the tempo `of` that is written, 100 where nothing is slower or faster than it. `is_own`: the student's
    own tempo, which the score follows. `played` is the tempo at which a replay was played, None where it is heard at
    that.
    """

    now: float
    began: float | None = None
    target: float | None = None
    percent: int = 100
    of: float | None = None
    is_own: bool = False
    played: float | None = None

    @property
    def words(self) -> str:
        """What explains the number where it is not all that there is to say; empty where it is."""
        parts = ["your own tempo"] if self.is_own else []
        if self.percent != 100 and self.of is not None:
            parts.append(f"{self.percent} % of {self.of:.0f}")
        named = (("played at", self.played), ("from", self.began), ("target", self.target))
        parts += [f"{name} {bpm:.0f}" for name, bpm in named if bpm is not None and round(bpm) != round(self.now)]
        return " · ".join(parts)


def tempo_at(tempo_map: TempoMap, tick: int, beat_ticks: int) -> float:
    """Beats a minute at `tick`, of beats `beat_ticks` long."""
    return tempo_map.bpm_at(tick) * PPQ / beat_ticks


def session_tempo(session: Session) -> TempoNow:
    """The tempo of a session: where the music is, in a count-in where that leads, before and after it the first."""
    plan, beat_ticks = session.plan, session.plan.lesson.beat_ticks
    music, tick, within = _music_now(session)
    share = plan.section.tempo_map.bpm_at(within) / plan.tempo_bpm * PPQ / beat_ticks
    now = tempo_at(music.tempo_map, tick, beat_ticks)
    is_own = plan.click is None and session.state().segment.phase is Phase.PASS
    if is_own:
        now *= session.pace
    band = plan.lesson.band
    if band is not None:
        percent = round(100 * plan.tempo_bpm / plan.lesson.tempo_bpm)
        return TempoNow(now, percent=percent, of=plan.lesson.beats_a_minute)
    began, target = _ends_bpm(session)
    return TempoNow(now, began * share, target * share, is_own=is_own)


def _ends_bpm(session: Session) -> tuple[float, float]:
    """Where the tempo began and where it leads, quarter notes a minute at the lesson's beginning."""
    plan, series = session.plan, session.series
    target = plan.lesson.target_tempo_bpm
    if plan.rise is not None and plan.rise.top_bpm is not None:
        target = plan.rise.top_bpm * plan.lesson.beat_ticks / PPQ
    return plan.tempo_bpm if series is None else series.began_bpm, target


def _music_now(session: Session) -> tuple[Score, int, int]:
    """The music that is played or counted in, the tick in it, and the tick of the section that this is."""
    state, plan = session.state(), session.plan
    if state.transport_ns is None or state.segment.phase is Phase.OVER:
        return plan.section, 0, 0
    segment = state.segment
    at_ns = state.transport_ns
    if segment.phase is Phase.COUNT_IN:
        at_ns, segment = segment.end_ns, plan.segment_at(segment.end_ns)
    music, start_ns = plan.music_of(segment)
    tick = int(music.tempo_map.ticks_at_ns(max(at_ns - start_ns, 0)))
    within = tick - segment.index * plan.section.end_tick if segment.phase is Phase.PASS else tick
    return music, tick, min(max(within, 0), max(plan.section.end_tick - 1, 0))


def demonstration_tempo(written: TempoMap, tick: int, beat_ticks: int, percent: int) -> TempoNow:
    """The tempo of a demonstration at `tick`, so many `percent` as fast as `written`."""
    of = tempo_at(written, tick, beat_ticks)
    return TempoNow(of * percent / 100, percent=percent, of=of)


def replay_tempo(score: Score, bar: int, beat_ticks: int, played: float | None = None) -> TempoNow:
    """The tempo of a `bar` (from 0) of what was played that is heard again; `played` that of another session."""
    return TempoNow(tempo_at(score.tempo_map, score.tempo_map.bar_start(bar), beat_ticks), played=played)


def tempi_in_words(plan: Plan, score: Score) -> str:
    """From which tempo to which the passes of `score` went: "76 bpm", "70 to 76 bpm"."""
    if plan.rounds is None:
        came = [step.tempo_bpm * PPQ / plan.lesson.beat_ticks for step in plan.steps if step.bar < score.bar_count]
        rose = f" to {round(came[-1], 3):g}" if len(came) > 1 else ""
        return f"{round(plan.beats_a_minute, 3):g}{rose} bpm"
    starts = [bar for bar in plan.pass_starts if bar < score.bar_count]
    first, *_, last = (
        round(tempo_at(score.tempo_map, score.tempo_map.bar_start(bar), plan.lesson.beat_ticks), 1)
        for bar in (starts[0], starts[-1])
    )
    return f"{first:g} bpm" if first == last else f"{first:g} to {last:g} bpm"
