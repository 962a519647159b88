"""A session's page as HTML: hostile words stay words, drawings are sound, and nothing is asked of a network."""

import re
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest

from station.drills.library import find_lesson
from station.practice.session.plan import PlanOptions, plan_practice
from station.render.report.page.html_page import session_html
from station.render.report.page.session_page import (
    Advised,
    BarFigures,
    ExamLine,
    ExamResult,
    GroupFigures,
    JudgedBars,
    LoudnessRow,
    NotePasses,
    NoteState,
    PassRow,
    SessionPage,
    StrokeTiming,
    TempoLine,
    TimingFigures,
    WordList,
)

HOSTILE = (
    "<script>alert(1)</script>",
    "\"'><img src=x onerror=alert(1)>",
    "]]></svg><b>",
    "&lt;i&gt;",
    "שלום عربي {{ 7*7 }}",
)
_VOID = {"meta", "br", "img", "input", "link", "hr"}


def hostile_page(word: str = HOSTILE[0]) -> SessionPage:
    """A page in which every word is `word`."""
    section = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0)).section
    states = list(NoteState)
    notes = tuple(NotePasses(word, states[i % len(states)], 3, 1, 1, 0, -12.0) for i in range(len(section)))
    figures = TimingFigures(9, -6.0, (-9.0, -3.0), 15.0, (12.0, 19.0))
    group = GroupFigures(word, 9, 8, 1, 0, 2, figures)
    return SessionPage(
        title=word,
        student=word,
        when=word,
        labels=((word, word),),
        score=61.0,
        right=8,
        notes=9,
        misses=1,
        wrong=0,
        extras=2,
        unknown=1,
        played_again=7,
        headline=word,
        praise=word,
        next_steps=(Advised(word, (word, word)),),
        choices=(word,),
        remarks=(word,),
        exam=ExamResult("61.0", word, (ExamLine(word, word, word),), word),
        bars=JudgedBars(section, notes, 1, ((0, word),), 80.0, 107520, 25.0, 3),
        timing=StrokeTiming(np.linspace(-30, 30, 9), figures, 25.0, has_own_clock=False),
        pieces=(group,),
        limbs=(group,),
        hands=(group,),
        by_bar=(BarFigures(1, group, 8, 2),),
        loudness=(LoudnessRow(word, word, 80.0, np.array([70.0, 80.0])),),
        tempo=TempoLine(
            np.array([0.0, 3.0]), np.array([79.0, 81.0]), np.zeros(1), np.array([80.0]), 6.0, word, 80.0, 0.1, None
        ),
        passes_heading=word,
        passes=(PassRow(word, word, word, word, word),),
        lists=(WordList(word, (word,)),),
        foot=(word,),
    )


class _Seen(HTMLParser):
    """What a browser would make of a page: its elements in order, its text, and whether they close as they open."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.text: list[str] = []
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def seen(html: str) -> _Seen:
    parser = _Seen()
    parser.feed(html)
    parser.close()
    assert parser.open == []
    return parser


@pytest.mark.parametrize("word", HOSTILE)
def test_words_stay_words(word: str) -> None:
    html = session_html(hostile_page(word))
    plain, found = seen(session_html(hostile_page("word"))), seen(html)
    drawn = {"use", "g", "path"}  # a longer word is more letters
    assert [tag for tag in found.tags if tag not in drawn] == [tag for tag in plain.tags if tag not in drawn]
    assert {name for name, _ in found.attributes} == {name for name, _ in plain.attributes}
    assert word in "".join(found.text)


def test_every_drawing_is_sound_xml_and_uses_what_is_there() -> None:
    html = session_html(hostile_page())
    svgs = [ElementTree.fromstring(svg) for svg in re.findall(r"<svg.*?</svg>", html, re.DOTALL)]
    assert len(svgs) > 8
    known = {each.get("id") for svg in svgs for each in svg.iter()} - {None}
    used = {each.get("href", "")[1:] for svg in svgs for each in svg.iter("use")}
    assert used <= known
    numbers = re.findall(r' (?:x|y|cx|cy|width|height|r|rx|ry)="([^"]*)"', html)
    assert all(np.isfinite(float(number)) for number in numbers if number != "device-width")


def test_nothing_is_asked_of_a_network() -> None:
    html = unescape(session_html(hostile_page("word")))
    assert "default-src 'none'" in html
    assert not re.search(r"https?:|//[a-z]|@import|url\(", html)
    assert not {"script", "img", "link", "iframe", "object"} & set(seen(html).tags)


def test_the_engraved_bars_keep_their_contract() -> None:
    """Each note is a group that says which it is and what became of it; each line says where time stands."""
    page = hostile_page("word")
    html = session_html(page)
    lines = [ElementTree.fromstring(svg) for svg in re.findall(r'<svg class="bars".*?</svg>', html, re.DOTALL)]
    assert lines
    groups = [each for line in lines for each in line.iter("g") if each.get("data-note") is not None]
    assert sorted(int(each.get("data-note", "")) for each in groups) == [*range(len(page.bars.section))]
    for each in groups:
        state = page.bars.notes[int(each.get("data-note", ""))].state
        assert each.get("class") == f"note {state}"
        assert "played 1 of 3 times" in (each.findtext("title") or "")
    for line in lines:
        places = re.findall(r"\[(\d+),([\d.]+)\]", line.get("data-line", ""))
        assert len(places) > 1
        assert len([each for each in line.iter("line") if each.get("class") == "play-line"]) == 1


def test_a_take_has_its_place_and_leaves_no_hole() -> None:
    page = hostile_page("word")
    assert 'id="take"' not in session_html(page)
    assert '<canvas id="stage"></canvas>' in session_html(page, '<canvas id="stage"></canvas>')


def test_a_session_in_which_nothing_was_heard_is_a_page() -> None:
    page = hostile_page("word")
    nothing = TimingFigures(0)
    empty = GroupFigures("snare", 4, 0, 4, 0, 0, nothing)
    page = replace(
        page,
        score=None,
        praise=None,
        exam=None,
        timing=StrokeTiming(np.zeros(0), nothing, 25.0, has_own_clock=False),
        pieces=(empty,),
        limbs=(),
        hands=(),
        by_bar=(BarFigures(1, empty, 0, 0),),
        loudness=(),
        tempo=TempoLine(np.zeros(0), np.zeros(0), np.zeros(1), np.array([80.0]), 6.0, "click", None, None, None),
    )
    html = session_html(page)
    assert "How far from the beat" not in html
    assert "Piece by piece" not in html
    assert "Bar by bar" in html
