"""Pictures of sessions and scores without a window."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.directions import direction_at
from station.drills.lesson import BarCue
from station.motion.drummer import Drummer
from station.motion.style.automation_lanes import in_passes
from station.music.judgement import Label
from station.practice.history.session_files import DRUMMER_NAME, PICTURE_NAME
from station.practice.now.tempo_now import tempo_at
from station.practice.records.save_session import SessionRecord
from station.practice.session.session import SessionResult
from station.render.picture import draw_png
from station.render.report.report_picture import draw_report_png
from station.render.snapshot import ExtraHit, Hud, Snapshot, mark, no_marks
from station.scenes.demonstrator import Demonstrator, as_taught, demonstrator_of
from station.scenes.result_tables import session_facts
from station.scenes.score_words import NO_WORDS, ScoreWords, bar_numbers
from station.scoring.matching.alignment import judgements
from station.scoring.matching.right import right_notes


def draw_record(record: SessionRecord, folder: Path, settings: Settings) -> Iterator[Path]:
    """Draw a session's report and its drummer into `folder`, and say each that is there; raises `DeviceError`."""
    report, drummer = folder / PICTURE_NAME, folder / DRUMMER_NAME
    draw_report_png(session_facts(record.result, record.document), report)
    yield report
    demonstrator = demonstrator_of(settings, lambda _: None)  # a style that is none was reported when practice began
    draw_session(record.result, drummer, demonstrator)
    yield drummer


def drummer_of(result: SessionResult, demonstrator: Demonstrator) -> Drummer:
    """The one who demonstrated it, over all its passes."""
    plan = result.plan
    passes = result.score.bar_count // plan.section.bar_count
    style = in_passes(as_taught(demonstrator.style, plan.lesson.cues), plan.first_bar, plan.section.bar_count, passes)
    return Drummer(result.score, plan.kit, demonstrator.figure, style)


def draw_session(result: SessionResult, path: Path, demonstrator: Demonstrator) -> None:
    """The last pass of a session, half into its first bar, every note with its judgement; raises `DeviceError`."""
    plan = result.plan
    numbers = bar_numbers(plan.lesson.sections, plan.first_bar, plan.section.bar_count, plan.passes)
    tempo_map, last = result.score.tempo_map, plan.pass_starts[-1]
    begin_s, end_s = tempo_map.seconds_at([tempo_map.bar_start(last), tempo_map.bar_start(last + 1)]).tolist()
    snapshot = picture_of(drummer_of(result, demonstrator), (begin_s + end_s) / 2)
    marks = no_marks(result.score)
    extras = []
    for judgement in judgements(result.score, result.performance, result.alignment):
        mark(marks, judgement)
        if judgement.label is Label.EXTRA and judgement.hit_index is not None:
            hit = result.performance[judgement.hit_index]
            extras.append(ExtraHit(hit.at_ns / NS_PER_S, hit.piece))
    right = int(right_notes(result.score, result.alignment, result.plan.level.windows).sum())
    hud = Hud(
        title=plan.lesson.title,
        phase="1 pass played" if plan.passes == 1 else f"{plan.passes} passes played",
        beats_a_minute=tempo_at(tempo_map, tempo_map.bar_start(last), plan.lesson.beat_ticks),
        right=right,
        judged=len(result.score) - result.alignment.count(Label.UNKNOWN),
    )
    shown = replace(
        snapshot,
        marks=marks,
        extras=tuple(extras),
        hud=hud,
        bar_numbers=numbers,
        beat_ticks=plan.lesson.beat_ticks,
    )
    draw_png(shown, path)


def picture_of(drummer: Drummer, at_s: float, words: ScoreWords = NO_WORDS) -> Snapshot:
    """The drummer at `at_s` seconds of the score, `words` by its notes; bar and beat are shown while it is played."""
    score = drummer.score
    hud = Hud(title=score.title, bar_count=score.bar_count)
    if 0 <= at_s * NS_PER_S < score.length_ns:
        place = score.tempo_map.position_at(int(score.tempo_map.ticks_at(at_s)))
        beats = score.tempo_map.meter_at(score.tempo_map.bar_start(place.bar)).beats
        tempo = tempo_at(score.tempo_map, int(score.tempo_map.ticks_at(at_s)), words.beat_ticks)
        hud = replace(hud, bar=place.bar + 1, beat=place.beat + 1, beats=beats, beats_a_minute=tempo)
    pose, limbs = drummer.pose(at_s), drummer.assignment.limbs
    return Snapshot(
        score,
        at_s,
        drummer.kit,
        drummer.figure,
        pose,
        limbs,
        hud=hud,
        bar_numbers=bar_numbers(words.sections, 0, score.bar_count),
        beat_ticks=words.beat_ticks,
        spelling=words.spelling,
    )


def directed(snapshot: Snapshot, cues: Sequence[BarCue]) -> Snapshot:
    """The picture with the words of a teacher's `cues` and from their view, by the bar that it names.

    Before the beginning the first bar's view is taken already, and after the end the last one's stays.
    """
    bar = snapshot.hud.bar
    if bar is None:
        last = snapshot.score.bar_count - 1
        return replace(snapshot, view=direction_at(cues, 0 if snapshot.position_s < 0 else last).view)
    said = direction_at(cues, bar - 1)
    return replace(snapshot, view=said.view, hud=replace(snapshot.hud, say=said.say))
