"""`station assess SCORE PERFORMANCE`: aligns and scores a recorded performance.

A lesson is a loop: it is taken to have been played as often as its pieces were struck for each stroke that is written.
"""

from dataclasses import dataclass, replace
from pathlib import Path

from station.cli.console import print_json, say, write
from station.cli.input.read_scores import bars_of_gap, is_lesson, is_midi, load_score_and_performance
from station.cli.options.option_fields import Command, argument, choice, flag, option
from station.core.errors import BadInput
from station.core.settings import load_settings
from station.core.units import NS_PER_MS
from station.practice.session.click_pattern import Gap
from station.scoring.matching.hit_windows import DEFAULT_LEVEL, LEVELS, Windows

_BEGINS_AT_ONCE = (
    "{}: its first stroke lies at its very beginning; if the recording was cut there, early and late are told"
    " against that stroke, and not against the time that was played to"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class AssessOptions:
    """What is compared with what, how strictly, and where the result goes."""

    score: str = argument("SCORE", "a lesson or a MIDI file", str)
    performance: str = argument("PERFORMANCE", "a MIDI file or a capture", str)
    level: Windows = choice(LEVELS, f"how strictly ({DEFAULT_LEVEL.name})", DEFAULT_LEVEL)
    gap: Gap | None = option("ON/OFF", "the click it was played to fell silent in turn", bars_of_gap, None)
    pairs: Path | None = option("FILE.csv", "write which hit answers which note", Path, None)
    json: bool = flag("print one JSON document")


def run(options: AssessOptions) -> int:
    """Align, sum up, print."""
    from station.drills.library import find_lesson
    from station.practice.records.session_report import assessment_text, feel_of, kit_facts
    from station.practice.session.click_pattern import silences
    from station.scoring.align import align
    from station.scoring.analysis.summary import SummaryView, summarise
    from station.scoring.following.loops import times_played
    from station.scoring.matching.alignment import Reference
    from station.scoring.report.assessment_document import assessment
    from station.scoring.report.pairs_table import write_pairs

    if options.pairs is not None and not options.pairs.resolve().parent.is_dir():
        raise BadInput(options.pairs, "", "there is no such folder to write it in")
    score, performance = load_score_and_performance(options.score, options.performance)
    view = SummaryView(options.level, kit=kit_facts(load_settings()))
    if is_lesson(options.score):
        lesson = find_lesson(options.score)
        goals = lesson.goals
        view = replace(view, pass_bars=score.bar_count, feel=feel_of(goals), beat_ticks=lesson.beat_ticks)
        view = replace(view, faults=goals.faults)
        score = score.repeated(times_played(score, performance))
    if options.gap is not None:
        view = replace(view, silences=silences(score.tempo_map, score.end_tick, options.gap))
    alignment = align(score, performance, clocked=False, may_share_base=is_midi(options.performance))
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


COMMAND = Command(AssessOptions, run)
