"""`station assess SCORE PERFORMANCE`: aligns and scores a recorded performance.

The capture of a session of that lesson is judged as the session was, by its click. Of anything else only the strokes
are known; a lesson is a loop, and taken to have been played as often as its pieces were struck for each stroke that is
written.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from station.app.music_files.named_parts import is_lesson
from station.app.music_files.read_captures import is_capture
from station.cli.console import print_json, say, write
from station.cli.input.read_scores import bars_of_gap, is_midi, load_score_and_performance
from station.cli.options.option_fields import Command, argument, choice, flag, option
from station.core.errors import BadInput
from station.core.settings import load_settings
from station.core.units import NS_PER_MS
from station.practice.session.cues.quiet_bars import QuietBars
from station.scoring.matching.hit_windows import DEFAULT_LEVEL, LEVELS, Windows

if TYPE_CHECKING:
    from station.practice.session.session import SessionResult

_BEGINS_AT_ONCE = (
    "{}: its first stroke lies at its very beginning; if the recording was cut there, early and late are told"
    " against that stroke, and not against the time that was played to"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class AssessOptions:
    """What is compared with what, how strictly, and where the result goes."""

    score: str = argument("SCORE", "a lesson or a MIDI file", str)
    performance: str = argument("PERFORMANCE", "a MIDI file or a capture", str)
    level: Windows | None = choice(LEVELS, f"how strictly (the lesson's, else {DEFAULT_LEVEL.name})", None)
    gap: QuietBars | None = option("ON/OFF", "the click it was played to fell silent in turn", bars_of_gap, None)
    pairs: Path | None = option("FILE.csv", "write which hit answers which note", Path, None)
    json: bool = flag("print one JSON document")


def run(options: AssessOptions) -> int:
    """Align, sum up, print."""
    from station.app.music_files.find_own_lesson import find_any_lesson
    from station.practice.records.report.session_report import assessment_text, feel_of, kit_facts, session_view
    from station.practice.session.cues.click_pattern import silences
    from station.scoring.align import align
    from station.scoring.analysis.summary import SummaryView, summarise
    from station.scoring.following.passes import times_played
    from station.scoring.matching.alignment import Reference
    from station.scoring.report.assessment_document import assessment
    from station.scoring.report.pairs_table import write_pairs

    if options.pairs is not None and not Path(os.path.realpath(options.pairs)).parent.is_dir():
        raise BadInput(options.pairs, "", "there is no such folder to write it in")
    score, performance = load_score_and_performance(options.score, options.performance)
    view = SummaryView(options.level or DEFAULT_LEVEL, kit=kit_facts(load_settings()))
    if is_lesson(options.score):
        lesson = find_any_lesson(options.score)
        windows = options.level or lesson.levels.level().windows
        view = replace(view, windows=windows, pass_bars=score.bar_count, faults=lesson.goals.faults)
        view = replace(view, feel=feel_of(lesson.goals), beat_ticks=lesson.beat_ticks)
        view = replace(view, hints=lesson.hints, parts=lesson.part_of_bar)
        landing = lesson.landing_after(score.bar_count - 1)
        score = score.repeated(times_played(score, performance)).landing_on(landing)
    session = _session(options)
    if session is not None:
        score, performance, alignment = session.score, session.performance, session.alignment
        view = replace(session_view(session, load_settings()), windows=view.windows)
    else:
        alignment = align(score, performance, clocked=False, may_share_base=is_midi(options.performance))
    if options.gap is not None:
        view = replace(view, silences=silences(score.tempo_map, score.end_tick, options.gap))
    document = assessment(summarise(score, performance, alignment, view))
    answered_ns = alignment.asynchrony_ns[alignment.hit_of_note >= 0]
    is_trimmed = alignment.reference is Reference.FILE and performance.hits["at_ns"][:1].tolist() == [0]
    if is_trimmed and len(answered_ns) and answered_ns.std() > NS_PER_MS:
        say(_BEGINS_AT_ONCE.format(options.performance))
    if options.pairs is not None:
        write_pairs(options.pairs, score, performance, alignment)
        say(f"pairs    {options.pairs}")
    if options.json:
        print_json(document)
    else:
        write(f"{score.title or options.score}\n\n{assessment_text(document)}", end="")
    return 0


def _session(options: AssessOptions) -> SessionResult | None:
    """The session of this lesson that the capture holds; None of anything else."""
    from station.app.music_files.find_own_lesson import find_any_lesson
    from station.devices.capture.capture import read_capture
    from station.practice.records.recovery import session_of

    if not is_lesson(options.score) or not is_capture(options.performance):
        return None
    return session_of(read_capture(Path(options.performance)), find_any_lesson(options.score))


COMMAND = Command(AssessOptions, run)
