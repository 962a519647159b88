"""`station history show SESSION`: what is kept of a session, and where its files are."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from station.cli.console import print_json, write
from station.cli.history_verbs.list_sessions import title_of
from station.cli.history_verbs.opened_history import opened_history, settings_for
from station.cli.options.option_fields import argument, flag, option
from station.core.counts import counted
from station.core.disk.utf8 import one_line
from station.core.errors import BadInput
from station.core.labels import piece_name
from station.core.pieces import Piece, word
from station.practice.history.kept_rows import figure_fields, session_fields
from station.practice.history.session_choice import HELP, choose_session
from station.store.rows import FigureRow, SessionRow

if TYPE_CHECKING:  # with a library that takes longer to load than all of what asks
    from station.store.history import History


SCHEMA = "drum-station/history-session/1"


@dataclass(frozen=True, slots=True, kw_only=True)
class ShowOptions:
    """Which session is shown, and how."""

    session: str = argument("SESSION", HELP, str)
    student: str | None = option("NAME", "whose last session, or whose session of a day", str, None)
    json: bool = flag("print one JSON document")


@dataclass(frozen=True, slots=True)
class _Kept:
    """What is kept of a session."""

    row: SessionRow
    figures: list[FigureRow]
    labels: Counter[str]
    documents: list[str]
    files: list[Path]


def run(options: ShowOptions) -> int:
    """Show it."""
    settings = settings_for(options.student, must_have_played=False)
    history = opened_history(settings, settings.student)
    chosen = choose_session(history, settings.student, options.session)
    if chosen.row is None:
        raise BadInput(options.session, "", f"the history {history.name} does not know this session")
    kept = _kept(history, chosen.row, chosen.folder)
    if options.json:
        print_json(_document(kept))
    else:
        write("\n".join(_lines(kept)))
    return 0


def _kept(history: History, row: SessionRow, folder: Path | None) -> _Kept:
    files = [] if folder is None else sorted(path for path in folder.iterdir() if path.is_file())
    return _Kept(
        row,
        history.session_figures(row.id),
        Counter(judged.label for judged in history.judgements(row.id)),
        history.document_names(row.id),
        files,
    )


# --- in words ---------------------------------------------------------------------------------------------------------


def _lines(kept: _Kept) -> list[str]:
    row = kept.row
    return [
        f"session {row.id} of {one_line(row.student)}, {row.started.isoformat(' ', 'minutes')}: {title_of(row)}",
        *(f"  {name:12}{words}" for name, words in _facts(kept) if words),
        *(f"  {_figure_name(figure):12}{_figure_words(figure)}" for figure in kept.figures),
        f"  {'files':12}{_where(kept)}",
        *(f"    {one_line(path.name)}" for path in kept.files),
    ]


def _facts(kept: _Kept) -> list[tuple[str, str]]:
    row = kept.row
    tempo = "" if row.beats_a_minute is None else f" at {row.beats_a_minute:g} bpm"
    early = "" if row.complete else ", stopped early"
    return [
        ("played", f"{row.played_s / 60:.1f} minutes{tempo}{early}"),
        ("score", "" if row.score is None else f"{row.score:.1f}{f', judged as {row.level}' if row.level else ''}"),
        ("exam", one_line(row.exam)),
        ("notes", f"{row.right} of {row.notes} right" if row.notes else ""),
        ("strokes", ", ".join(f"{count} {label.replace('_', ' ')}" for label, count in kept.labels.items())),
        ("timing", _timing(row.mean_ms, row.sd_ms, row.strokes)),
        ("device", one_line(row.device)),
        ("capture", "" if row.capture_sha256 is None else f"kept in the history, SHA-256 {row.capture_sha256}"),
        ("documents", f"{', '.join(map(one_line, kept.documents))} (in the history)" if kept.documents else ""),
    ]


def _figure_name(figure: FigureRow) -> str:
    known = {word(piece): piece_name(piece) for piece in Piece}
    return known.get(figure.name) or one_line(figure.name.replace("_", " "))


def _figure_words(figure: FigureRow) -> str:
    return ", ".join(
        filter(
            None,
            (
                f"{figure.matched} of {figure.notes} hit",
                _timing(figure.mean_ms, figure.sd_ms, figure.strokes),
                f"{figure.misses} missed" if figure.misses else "",
                f"{figure.wrong_piece} on a wrong piece" if figure.wrong_piece else "",
            ),
        )
    )


def _timing(mean_ms: float | None, sd_ms: float | None, strokes: int) -> str:
    if mean_ms is None:
        return ""
    spread = "" if sd_ms is None else f", spread {sd_ms:.1f} ms"
    return f"mean {mean_ms:+.1f} ms{spread} ({counted(strokes, 'stroke')})"


def _where(kept: _Kept) -> str:
    folder = one_line(kept.row.folder)
    if kept.files:
        return folder
    rest = "report and replay come from the capture in the history" if kept.row.capture_sha256 else "no capture is kept"
    return f"{folder} is gone; {rest}"


def _document(kept: _Kept) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "session": session_fields(kept.row),
        "figures": [figure_fields(figure) for figure in kept.figures],
        "judgements": dict(kept.labels),
        "documents": kept.documents,
        "files": [str(path) for path in kept.files],
    }
