"""`station sheet SCORE --out FILE.pdf`: a score on paper, for the music stand."""

import argparse
from pathlib import Path

from station.cli.console import say
from station.cli.read_scores import is_lesson, load_score
from station.core.errors import BadInput
from station.core.files import write_whole
from station.drills.library import find_lesson

ENDING = ".pdf"
PAPERS = ("a4", "letter")
"""Those of `station.render.notation.sheet.PAPERS`."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    parser.add_argument("score", metavar="SCORE", help="a lesson, a MIDI file, a text score or a take")
    parser.add_argument("--out", metavar="FILE.pdf", type=Path, required=True, help="the file to write")
    parser.add_argument("--start-bar", type=int, metavar="A", default=1, help="the first bar, from 1 (%(default)s)")
    parser.add_argument("--end-bar", type=int, metavar="B", help="the last bar (the score's)")
    parser.add_argument("--paper", choices=PAPERS, default=PAPERS[0], help="the size of the paper (%(default)s)")
    parser.add_argument("--no-sticking", action="store_true", help="no R and L below the notes")


def run(arguments: argparse.Namespace) -> int:
    """Engrave it and write the file."""
    from station.scenes.sheets import pdf_of, words_of_lesson, words_of_score

    out: Path = arguments.out
    if out.suffix.lower() != ENDING:
        raise BadInput(out, "", f"expected a name that ends in {ENDING}")
    lesson = find_lesson(arguments.score) if is_lesson(arguments.score) else None
    score = load_score(arguments.score) if lesson is None else lesson.score
    first = arguments.start_bar
    last = score.bar_count if arguments.end_bar is None else arguments.end_bar
    if not 1 <= first <= last <= score.bar_count:
        fault = f"expected bars within 1-{score.bar_count}, the first before the last"
        raise BadInput("--start-bar, --end-bar", f"{first}-{last}", fault)
    bars = first - 1, last - 1
    words = words_of_score(score, bars, Path(arguments.score).stem) if lesson is None else words_of_lesson(lesson, bars)
    write_whole(out, pdf_of(score, bars, words, arguments.paper, not arguments.no_sticking))
    say(f"sheet  {out}")
    return 0
