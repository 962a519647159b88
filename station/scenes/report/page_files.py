"""A page about a session as a file: HTML that stands alone, or PDF."""

from station.core.settings import Settings
from station.scenes.report.kept_session import kept_session
from station.scenes.report.page_facts import session_page
from station.scenes.report.session_place import session_place


def page_bytes(named: str, settings: Settings, ending: str) -> bytes:
    """The page about the session that `named` means, by the `ending` of its file; raises `BadInput`."""
    from station.render.report.page.html_page import session_html
    from station.render.report.page.paper_page import session_pdf

    place = session_place(named, settings)
    page = session_page(kept_session(place, settings), place.source)
    return session_pdf(page) if ending == ".pdf" else session_html(page).encode()
