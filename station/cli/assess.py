"""`station assess SCORE PERFORMANCE`: aligns and scores a recorded performance.

A lesson is a loop: it is taken to have been played as often as its pieces were struck for each stroke that is written.
"""

import argparse
from dataclasses import replace
from pathlib import Path

from station.cli.console import print_json, say
from station.cli.read_scores import bars_of_gap, is_lesson, is_midi, load_score_and_performance
from station.core.errors import BadInput
from station.core.settings import load_settings
from station.core.units import NS_PER_MS

_BEGINS_AT_ONCE = (
    "{}: its first stroke lies at its very beginning; if the recording was cut there, early and late are told"
    " against that stroke, and not against the time that was played to"
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    from station.scoring.matching.hit_windows import DEFAULT_LEVEL, LEVELS

    parser.add_argument("score", metavar="SCORE", help="a lesson or a MIDI file")
    parser.add_argument("performance", metavar="PERFORMANCE", help="a MIDI file or a capture")
    parser.add_argument("--level", choices=LEVELS, default=DEFAULT_LEVEL.name, help="how strictly (%(default)s)")
    parser.add_argument(
        "--gap", type=bars_of_gap, metavar="ON/OFF", help="the click it was played to fell silent in turn"
    )
    parser.add_argument("--pairs", type=Path, metavar="FILE.csv", help="write which hit answers which note")
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(arguments: argparse.Namespace) -> int:
    """Align, sum up, print."""
    from station.drills.library import find_lesson
    from station.practice.records.session_report import assessment_text, feel_of, kit_facts
    from station.practice.session.click_pattern import silences
    from station.scoring.align import align
    from station.scoring.analysis.summary import SummaryView, summarise
    from station.scoring.following.loops import times_played
    from station.scoring.matching.alignment import Reference
    from station.scoring.matching.hit_windows import find_windows
    from station.scoring.report.assessment_document import assessment
    from station.scoring.report.pairs_table import write_pairs

    if arguments.pairs is not None and not arguments.pairs.resolve().parent.is_dir():
        raise BadInput(arguments.pairs, "", "there is no such folder to write it in")
    score, performance = load_score_and_performance(arguments.score, arguments.performance)
    view = SummaryView(find_windows(arguments.level), kit=kit_facts(load_settings()))
    if is_lesson(arguments.score):
        lesson = find_lesson(arguments.score)
        view = replace(view, pass_bars=score.bar_count, feel=feel_of(lesson.goals), beat_ticks=lesson.beat_ticks)
        score = score.repeated(times_played(score, performance))
    if arguments.gap is not None:
        view = replace(view, silences=silences(score.tempo_map, score.end_tick, arguments.gap))
    alignment = align(score, performance, clocked=False, may_share_base=is_midi(arguments.performance))
    document = assessment(summarise(score, performance, alignment, view))
    answered_ns = alignment.asynchrony_ns[alignment.hit_of_note >= 0]
    is_trimmed = alignment.reference is Reference.FILE and performance.hits["at_ns"][:1].tolist() == [0]
    if is_trimmed and len(answered_ns) and answered_ns.std() > NS_PER_MS:
        say(_BEGINS_AT_ONCE.format(arguments.performance))
    if arguments.pairs is not None:
        write_pairs(arguments.pairs, score, performance, alignment)
        say(f"pairs    {arguments.pairs}")
    if arguments.json:
        print_json(document)
    else:
        print(f"{score.title or arguments.score}\n\n{assessment_text(document)}", end="")
    return 0
