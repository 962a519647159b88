"""A session's page on paper: whole pages, numbered, and nothing beyond their edges."""

import re
import zlib
from dataclasses import replace

import pytest

from station.render.report.page.paper_flow import BODY, PaperFlow
from station.render.report.page.paper_page import session_pdf
from station.render.report.page.session_page import Advised, PassRow
from station.render.text.paper import OutlineAtlas
from tests.unit.render.test_session_html import HOSTILE, hostile_page

A4 = (595.28, 841.89)
_FORM = re.compile(r"q (\S+) (\S+) (\S+) (\S+) (\S+) (\S+) cm /F\d+ Do Q")
_BOX = re.compile(r"^(\S+) (\S+) (\S+) (\S+) re$", re.MULTILINE)


def contents(data: bytes) -> list[str]:
    """What paints each page: the streams that turn the page's y upside down."""
    streams = re.findall(rb"stream\n(.*?)\nendstream", data, re.DOTALL)
    return [text for text in (zlib.decompress(each).decode() for each in streams) if text.startswith("1 0 0 -1 0 ")]


def places(text: str) -> list[tuple[float, float]]:
    forms = [(float(match[5]), float(match[6])) for match in _FORM.finditer(text)]
    boxes = [(float(x), float(y)) for x, y, _, _ in _BOX.findall(text)]
    ends = [(float(x) + float(w), float(y) + float(h)) for x, y, w, h in _BOX.findall(text)]
    return forms + boxes + ends


@pytest.mark.parametrize(
    "word",
    [HOSTILE[1], HOSTILE[4], "w" * 300, "many words " * 60],
    ids=["markup", "right to left", "one word", "many words"],
)
def test_nothing_stands_beyond_the_paper(word: str) -> None:
    pages = contents(session_pdf(hostile_page(word)))
    assert pages
    for page in pages:
        for x, y in places(page):
            assert 15.0 <= x <= A4[0] - 15.0
            assert 15.0 <= y <= A4[1] - 15.0


def test_a_long_session_has_more_pages() -> None:
    page = hostile_page("word")
    rows = tuple(PassRow(f"pass {number}", "80 bpm", "bars 1–2", "24 of 24 right", "why") for number in range(90))
    short, long = (session_pdf(each) for each in (page, replace(page, passes=rows)))
    assert len(contents(long)) >= len(contents(short)) + 1
    for data in (short, long):
        assert f"/Count {len(contents(data))} ".encode() in data


def test_advice_is_read_whole() -> None:
    """Words are broken over lines and never cut: with more of them the page has as many more letters."""
    page = hostile_page("word")
    text = "Snares come late. " * 12
    longer = replace(page, next_steps=(Advised(text),))
    shorter = replace(page, next_steps=(Advised(text[:-18]),))
    letters = [sum(map(len, map(_FORM.findall, contents(session_pdf(each))))) for each in (longer, shorter)]
    assert letters[0] - letters[1] == len("Snarescomelate.")


def test_colours_are_those_of_the_day() -> None:
    (first, *_) = contents(session_pdf(hostile_page("word")))
    assert "0 0.404 0.898 rg" in first, "0067E5, which is on time by day"


def test_a_paragraph_goes_on_on_the_next_page() -> None:
    flow = PaperFlow("title", OutlineAtlas())
    for _ in range(200):
        flow.paragraph("words", BODY)
    pages = contents(flow.pdf("author"))
    assert len(pages) > 2
    assert all(len(_FORM.findall(page)) > 50 for page in pages[:-1])
