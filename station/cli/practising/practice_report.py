"""What is printed and drawn of a session that is kept."""

from pathlib import Path

from station.cli.console import print_json, say, write
from station.cli.input.self_estimate_question import ask_first
from station.cli.practising.practice_options import PracticeOptions
from station.core.errors import StationError
from station.core.settings import Settings
from station.practice.headless.guarded_output import GuardedOutput
from station.practice.history.session_files import TEXT_NAME
from station.practice.records.report.session_report import report_text
from station.practice.records.save_session import SessionFolder, SessionRecord
from station.scoring.report.assessment_document import Json


def leave_report(
    folder: SessionFolder,
    saved: SessionRecord,
    options: PracticeOptions,
    settings: Settings,
    may_ask: bool = False,
) -> None:
    """Print the report of what was kept, and draw it; what the disk refused is said after the report was printed.

    `may_ask`: a person played, who may be asked for an opinion before the report is there.
    """
    telling = GuardedOutput()
    if may_ask:
        telling.attempt(ask_first, saved.document)
    telling.attempt(_print_report, saved.document, as_json=options.json)
    if saved.unkept is not None:
        telling.attempt(say, saved.unkept)
    if saved.fault is not None:
        raise saved.fault
    paths = [folder.path / TEXT_NAME]
    if not options.no_pictures:
        paths += _draw(folder, saved, settings, telling)
    if telling.failure is None:
        say("\n" + "\n".join(f"{'picture' if path.suffix == '.png' else 'report':9}{path}" for path in paths))
    if isinstance(telling.failure, BrokenPipeError):  # whoever read has gone, and wants no word of it
        raise telling.failure
    unsaid = telling.fault(f"the session is kept in {folder.path}, but not all could be printed")
    if unsaid is not None:
        raise unsaid


def _print_report(document: dict[str, Json], as_json: bool) -> None:
    if as_json:
        print_json(document)
        return
    write(report_text(document), end="", flush=True)
    if "pairs_csv" in document:
        write(f"\n{document['pairs_csv']}", end="", flush=True)


def _draw(folder: SessionFolder, saved: SessionRecord, settings: Settings, telling: GuardedOutput) -> list[Path]:
    from station.scenes.pictures import draw_record

    try:
        return list(draw_record(saved, folder.path, settings))
    except StationError as error:
        telling.attempt(say, f"no picture: {error}")
        return []
