"""A page about a session or about a week as a file: HTML that stands alone, or PDF."""

from datetime import date

from station.core.errors import StationError
from station.core.settings import Settings
from station.practice.history.session_intake import everything_in
from station.practice.history.student_history import StudentHistory
from station.practice.session.session import SessionResult
from station.scenes.report.kept_session import kept_session
from station.scenes.report.page_facts import session_page
from station.scenes.report.session_place import session_place


def page_bytes(named: str, settings: Settings, ending: str) -> bytes:
    """The page about the session that `named` means, by the `ending` of its file; raises `BadInput`."""
    from station.render.report.page.html_page import session_html
    from station.render.report.page.paper_page import session_pdf

    place = session_place(named, settings)
    kept = kept_session(place, settings)
    page = session_page(kept, place.source)
    return session_pdf(page) if ending == ".pdf" else session_html(page, _take(kept.result, settings)).encode()


def _take(result: SessionResult, settings: Settings) -> str:
    """The take as markup, nothing where nothing was played; where it cannot be made a sentence that says why."""
    from station.render.report.take.take_part import no_take_part, take_part
    from station.scenes.report.take_media import take_media

    if not len(result.performance):
        return ""
    try:
        return take_part(take_media(result, settings))
    except StationError as fault:
        return no_take_part(str(fault))


def week_bytes(settings: Settings, day: date, today: date, ending: str) -> bytes:
    """The page about the week that `day` lies in, by the `ending` of its file; raises `BadInput`, `DeviceError`."""
    from station.render.report.page.week_html import week_html
    from station.render.report.page.week_paper import week_pdf
    from station.scenes.report.week_facts import week_page

    history = StudentHistory.of(settings).open()
    everything_in(history, settings.sessions_dir, settings.student)
    page = week_page(history, settings, day, today)
    return week_pdf(page) if ending == ".pdf" else week_html(page).encode("utf-8", "replace")
