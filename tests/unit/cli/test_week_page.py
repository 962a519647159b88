"""`station report --week`: what parents read says what the list says, escapes everything, and shames nobody."""

import html
import json
import random
import re
from datetime import date, datetime, timedelta
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.store.rows import TeacherNoteRow
from tests.fakes.kept_sessions import kept, users_history

HOSTILE = (
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "{{ 7*7 }}",
    "</style>",
    "x" * 200,
    "\u202eשלום",
    "🥁",
)
_MONDAY = datetime(2026, 11, 23)


@pytest.fixture(autouse=True)
def _own_history(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for kind in ("DATA", "CONFIG"):
        monkeypatch.setenv(f"XDG_{kind}_HOME", str(tmp_path / kind))
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path / "documents"))


def page(tmp_path: Path, *words: str) -> str:
    out = tmp_path / "week.html"
    assert main(["report", "--out", str(out), "--week", *words]) == 0
    return out.read_text(encoding="utf-8")


def words_of(text: str) -> str:
    """What a reader sees."""
    body = re.sub(r"<(style|svg).*?</\1>", " ", text.partition("<body>")[2], flags=re.DOTALL)
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", body)).split())


def test_its_sums_are_those_of_the_list(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    history, dice = users_history(), random.Random(5)
    for number in range(18):
        started = _MONDAY + timedelta(days=dice.randrange(-3, 10), hours=dice.randrange(24), seconds=number)
        lesson = dice.choice(["rock-1", "swing-1", "waltz-1"])
        history.keep(kept("Ann", started, lesson, title=f"Title {lesson}", played_s=dice.uniform(10, 900)))
    assert main(["history", "--json", "--student", "Ann", "--since", "2026-11-23", "--until", "2026-11-29"]) == 0
    listed = json.loads(capsys.readouterr().out)
    minutes = round(sum(each["played_s"] for each in listed["sessions"]) / 60)
    text = page(tmp_path, "2026-11-27", "--student", "Ann")
    told = words_of(text)
    assert f"Ann played on {listed['totals']['days']} days of this week" in told
    assert f", {minutes} minutes in all." in told
    assert "Monday, 23 November to Sunday, 29 November 2026" in told
    bars = re.findall(r"<title>(\w+day): (\d+|less than 1) minutes?</title>", text)
    of_day: dict[str, float] = {}
    for each in listed["sessions"]:
        day = f"{datetime.fromisoformat(each['started']):%A}"
        of_day[day] = of_day.get(day, 0.0) + each["played_s"]
    assert {name: int(count) for name, count in bars if count.isdigit()} == {
        day: round(seconds / 60) for day, seconds in of_day.items() if seconds >= 30
    }
    assert {name for name, _ in bars} == {
        f"{datetime.fromisoformat(each['started']):%A}" for each in listed["sessions"]
    }
    table = re.findall(r"<td>(Title [\w-]+)</td><td class=\"number\">(\d+) minutes?(?:, in (\d+) sessions)?</td>", text)
    assert abs(sum(int(each) for _, each, _ in table) - minutes) <= len(table) / 2
    assert sum(int(times or 1) for _, _, times in table) == listed["totals"]["sessions"]


def test_a_week_without_practice_blames_nobody(tmp_path: Path) -> None:
    users_history().keep(kept("Ann", _MONDAY))
    told = words_of(page(tmp_path, "2026-03-04", "--student", "Ann"))
    assert "Ann did not play in this week." in told
    assert "belong to learning" in told
    assert "What got better" not in told
    for word in ("0", "fail", "lazy", "only", "must", "should", "lost", "unfortunately"):
        assert word not in told.replace("2026", "").lower().split()
    assert main(["assignment", "take", str(assignment_in(tmp_path)), "--student", "Zoë"]) == 0
    assert "Zoë did not play" in words_of(page(tmp_path, "--student", "Zoë"))


@pytest.mark.parametrize("name", HOSTILE)
def test_names_titles_and_notes_are_words_and_nothing_else(name: str, tmp_path: Path) -> None:
    history = users_history()
    history.keep(kept(name, _MONDAY, title=name))
    history.keep_note(name, TeacherNoteRow("n", "a", name, name, _MONDAY, f"{name}\n{name}", name, b""))
    text = page(tmp_path, "2026-11-23", "--student", name)
    plain = page(tmp_path, "2025-11-23", "--student", name)
    assert "<script" not in text
    assert "<img" not in text
    assert text.count("<style") == text.count("</style") == 1
    policy = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
    for each in (text, plain):
        assert html.unescape(each).count(f'content="{policy}"') == 1
    seen = " ".join("".join(c if c.isprintable() else " " for c in name).split())
    times = words_of(text).casefold().count(seen.casefold())
    assert times >= 6, "heading, headline, the lesson, the note's two lines and its teacher"
    out = tmp_path / "week.pdf"
    assert main(["report", "--week", "2026-11-23", "--student", name, "--out", str(out)]) == 0
    assert out.read_bytes().startswith(b"%PDF")


def assignment_in(folder: Path) -> Path:
    """One for rock-1 until tomorrow."""
    given, due = folder / "week3.drum-assignment", (date.today() + timedelta(days=1)).isoformat()
    words = ["--lesson", "rock-1", "--due", due, "--title", "Week <3>", "--teacher", "Carla", "--out", str(given)]
    assert main(["assignment", "new", *words]) == 0
    return given


def test_what_comes_next_and_what_the_teacher_wrote(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    today = date.today()
    assert main(["assignment", "take", str(assignment_in(tmp_path)), "--student", "Ann"]) == 0
    now = datetime.combine(today, datetime.min.time())
    note = TeacherNoteRow("n", "a", "Week 2", "Carla", now, "Well done.\nSofter now.", "At 90.", b"")
    users_history().keep_note("Ann", note)
    told = words_of(page(tmp_path, "--student", "Ann"))
    assert "“Week <3>”, from Carla, for " in told
    assert ": Rock 1: eighths, backbeat, one and three." in told
    assert "Well done. Softer now. Next: At 90. Carla, " in told
    assert main(["today", "--student", "Ann"]) == 0
    new = re.findall(r" min  New +(.*)", capsys.readouterr().out)
    untold = [title for title in new if f"“{title}” is new to Ann." not in told]
    assert untold == ["Rock 1: eighths, backbeat, one and three"]
    assert told.count("Rock 1") == 1
    assert "Well done" not in words_of(page(tmp_path, "2025-01-01", "--student", "Ann"))


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["last", "--week", "2026-11-23"], "leave last out"),
        ([], "say which session, or --week"),
        (["--week", "yesterday"], "expected a day such as 2026-12-01"),
    ],
)
def test_what_cannot_be_meant_is_told(
    words: list[str], fault: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["report", *words, "--out", str(tmp_path / "x.html")]) == 2
    assert fault in capsys.readouterr().err
    assert not (tmp_path / "x.html").exists()
