"""The lesson book in words, for a terminal, and as JSON documents, for programs."""

from collections.abc import Iterator, Sequence
from datetime import date

from station.drills.daily.daily_items import DailyItem
from station.practice.book.day_progress import Block, BlockState
from station.practice.book.lesson_book import DayPage, Returning
from station.practice.book.practised import PractisedSession
from station.practice.session.cues.quiet_bars import gap_of, gap_words
from station.practice.session.rising_tempo import Rise, rise_of
from station.scoring.report.assessment_document import Json

TODAY_SCHEMA = "drum-station/today/1"
BOOK_SCHEMA = "drum-station/book/1"
_MARKS = {BlockState.OPEN: " ", BlockState.DONE: "✓", BlockState.LEFT_OUT: "–"}
MOST_RETURNING = 5
"""So many are named (our choice: more is a list of debts)."""


# --- words ------------------------------------------------------------------------------------------------------------


def how_words(item: DailyItem) -> str:
    """Which bars, at which tempo, with which click."""
    if not item.lesson:
        return "Whatever you like"
    first, last = item.bars[0] + 1, item.bars[1] + 1
    bars = f"Bar {first}" if first == last else f"Bars {first}–{last}"
    tempo = f"{item.beats_a_minute:g} bpm, {item.tempo_pct:.0f} % of the target"
    if item.rise:
        tempo += f", {rise_words(rise_of(item.rise))}"
    elif item.follows:
        tempo += ", then it follows you"
    return f"{bars} at {tempo}" + (f"; {gap_words(gap_of(item.gap))}" if item.gap else "")


def rise_words(rise: Rise) -> str:
    """What a rise does, for people."""
    every = "every bar" if rise.every_bars == 1 else f"every {rise.every_bars} bars"
    return f"+{rise.add_bpm:g} bpm {every}" + ("" if rise.top_bpm is None else f" up to {rise.top_bpm:g}")


def day_in_words(day: date) -> str:
    """A date as people say it."""
    return f"{day:%A}, {day.day} {day:%B}"


def today_text(page: DayPage) -> str:
    """Today's plan, and how far it is."""
    progress, kept = page.progress, page.kept
    head = f"{day_in_words(kept.day)}: {kept.minutes} minutes"
    lines = [line for block in progress.blocks for line in _block_lines(block)]
    played = f"{progress.done} of {len(progress.blocks)} blocks, {progress.minutes:.0f} minutes played"
    after = "Done for today." if progress.is_over else "Next: station practice --today"
    return "\n".join([head, "", *lines, "", f"{played}. {after}", ""])


def _block_lines(block: Block) -> Iterator[str]:
    item = block.item
    yield f"{_MARKS[block.state]} {block.place + 1:2}  {item.minutes:2} min  {item.kind.label:9}  {item.title}"
    yield f"{'':14}{how_words(item)}"
    yield f"{'':14}{item.why}"


def book_text(pages: Sequence[DayPage], returning: Sequence[Returning], today: date) -> str:
    """Days of the book, the newest first, and what returns."""
    parts = [_page_text(page) for page in pages] or ["Nothing in the book yet: station today makes a plan."]
    return "\n".join([*parts, *_returning_lines(returning, today), ""])


def _page_text(page: DayPage) -> str:
    lines = [day_in_words(page.kept.day)]
    progress = page.progress
    if progress.blocks:
        lines.append(f"  planned    {page.kept.minutes} minutes, {len(progress.blocks)} blocks; {progress.done} played")
    lines += [f"  practised  {session_words(one)}" for one in page.sessions] or ["  practised  nothing"]
    lines += [f"  you        {page.kept.line}"] if page.kept.line else []
    lines += [f"  {note.author or 'teacher':9}  {line}" for note in page.notes for line in note.lines]
    return "\n".join([*lines, ""])


def session_words(one: PractisedSession) -> str:
    """A session in a line."""
    score = "" if one.score is None else f", {one.score:.0f} of 100"
    tempo = "" if one.beats_a_minute is None else f" at {one.beats_a_minute:g} bpm"
    said = f", exam: {one.exam}" if one.exam else score
    return f"{one.started:%H:%M}  {one.played_s / 60:4.1f} min  {one.title}{tempo}{said}"


def _returning_lines(returning: Sequence[Returning], today: date) -> list[str]:
    if not returning:
        return []
    lines = [f"  {returns_words(one, today):16}  {one.title}" for one in returning[:MOST_RETURNING]]
    more = [f"  and {len(returning) - MOST_RETURNING} more, later"] if len(returning) > MOST_RETURNING else []
    return ["What returns", *lines, *more]


def returns_words(one: Returning, today: date) -> str:
    """When a review comes, as people say it."""
    days = (one.due - today).days
    if days <= 0:
        return "today"
    return "tomorrow" if days == 1 else f"on {one.due.day} {one.due:%B}"


# --- documents --------------------------------------------------------------------------------------------------------


def today_document(page: DayPage, returning: Sequence[Returning]) -> dict[str, Json]:
    """Today's plan; bars count from 1."""
    following = page.progress.next
    return {
        "schema": TODAY_SCHEMA,
        **_page_document(page),
        "next": None if following is None else following.place,
        "over": page.progress.is_over,
        "returns": _returning_rows(returning),
    }


def book_document(pages: Sequence[DayPage], returning: Sequence[Returning]) -> dict[str, Json]:
    """Days of the book, the newest first."""
    days: list[Json] = [_page_document(page) for page in pages]
    return {"schema": BOOK_SCHEMA, "days": days, "returns": _returning_rows(returning)}


def _page_document(page: DayPage) -> dict[str, Json]:
    kept = page.kept
    return {
        "day": kept.day.isoformat(),
        "minutes": kept.minutes,
        "minutes_played": round(page.progress.minutes, 1),
        "items": [_block_row(block) for block in page.progress.blocks],
        "practised": [_session_row(one) for one in page.sessions],
        "line": kept.line,
        "notes": [{"author": note.author, "text": "\n".join(note.lines)} for note in page.notes],
    }


def _block_row(block: Block) -> dict[str, Json]:
    item = block.item
    return {
        "kind": item.kind.value,
        "state": block.state.value,
        "lesson": item.lesson or None,
        "title": item.title,
        "bars": [item.bars[0] + 1, item.bars[1] + 1] if item.lesson else None,
        "tempo_pct": round(item.tempo_pct, 1),
        "beats_a_minute": item.beats_a_minute,
        "tempo_why": item.tempo_why,
        "follows_the_student": item.follows,
        "minutes": item.minutes,
        "passes": item.passes,
        "gap": item.gap or None,
        "rise": item.rise or None,
        "why": item.why,
        "played_s": round(block.played_s, 1),
    }


def _session_row(one: PractisedSession) -> dict[str, Json]:
    return {
        "started": one.started.isoformat(),
        "lesson": one.lesson or None,
        "title": one.title,
        "played_s": one.played_s,
        "complete": one.complete,
        "score": one.score,
        "beats_a_minute": one.beats_a_minute,
        "exam": one.exam or None,
    }


def _returning_rows(returning: Sequence[Returning]) -> list[Json]:
    return [{"lesson": one.lesson, "due": one.due.isoformat()} for one in returning]
