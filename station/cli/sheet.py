"""`station sheet SCORE --out FILE.pdf`: a score on paper, for the music stand."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path

from station.app.music_files.find_own_lesson import find_any_lesson
from station.app.music_files.named_parts import is_lesson, load_part
from station.cli.console import say
from station.cli.options.option_fields import Command, argument, choice, flag, option, required, whole_number
from station.core.disk.files import write_whole
from station.core.errors import BadInput

ENDING = ".pdf"
PAPERS = ("a4", "letter")
"""Those of `station.render.notation.page.sheet.PAPERS`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetOptions:
    """What is engraved, and how."""

    score: str = argument("SCORE", "a lesson, a file of music or a take", str)
    out: Path = required("FILE.pdf", "the file to write", Path)
    start_bar: int = option("A", "the first bar, from 1 (1)", whole_number, 1)
    end_bar: int | None = option("B", "the last bar (the score's)", whole_number, None)
    paper: str = choice(dict(zip(PAPERS, PAPERS, strict=True)), f"the size of the paper ({PAPERS[0]})", PAPERS[0])
    no_sticking: bool = flag("no R and L below the notes")


def run(options: SheetOptions) -> int:
    """Engrave it and write the file."""
    from station.scenes.sheets import lesson_labels, part_labels, pdf_of, written_down

    out = options.out
    if out.suffix.lower() != ENDING:
        raise BadInput(out, "", f"expected a name that ends in {ENDING}")
    if is_lesson(options.score):
        lesson = find_any_lesson(options.score)
        score, labels = lesson.played_once, partial(lesson_labels, lesson)
    else:
        part = written_down(load_part(options.score))
        score, labels = part.score, partial(part_labels, part, name=Path(options.score).stem)
    first = options.start_bar
    last = score.bar_count if options.end_bar is None else options.end_bar
    if not 1 <= first <= last <= score.bar_count:
        fault = f"expected bars within 1-{score.bar_count}, the first before the last"
        raise BadInput("--start-bar, --end-bar", f"{first}-{last}", fault)
    bars = first - 1, last - 1
    write_whole(out, pdf_of(score, bars, labels(bars), options.paper, not options.no_sticking))
    say(f"sheet  {out}")
    return 0


COMMAND = Command(SheetOptions, run)
