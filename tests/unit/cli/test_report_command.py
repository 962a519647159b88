"""`station report`: the page as a file, which session is meant, and what is refused."""

import json
import shutil
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.settings import Settings, save_settings
from tests.unit.cli.test_cli import refused


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("kept") / "2026-03-04T17-05-06_rock-1"
    words = ("practice", "rock-1", "--headless", "--virtual-student", "intermediate,seed=4", "--loops", "2")
    assert main([*words, "--no-pictures", "--report", str(folder)]) == 0
    return folder


@pytest.mark.parametrize("ending", ["html", "pdf", "PDF"])
def test_a_session_s_folder_and_its_capture_give_a_page(
    session: Path, tmp_path: Path, ending: str, capsys: pytest.CaptureFixture[str]
) -> None:
    pages = [tmp_path / f"{number}.{ending}" for number in range(2)]
    for named, page in zip((session, session / "session.capture"), pages, strict=True):
        assert main(["report", str(named), "--out", str(page)]) == 0
        assert capsys.readouterr().err == f"report   {page}\n"
    assert pages[0].read_bytes() == pages[1].read_bytes()
    assert pages[0].read_bytes().startswith(b"%PDF-1.7" if ending.lower() == "pdf" else b"<!DOCTYPE html>")


def test_last_and_a_day_are_the_student_s(
    session: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path))
    top, out = Settings(student="Ada").sessions_dir / "Ada", tmp_path / "x.html"
    asked = ("report", "last", "--student", "Ada", "--out", str(out))
    assert "Ada: no such student" in refused(capsys, *asked)
    top.mkdir(parents=True)
    assert "nothing of Ada is kept" in refused(capsys, *asked)
    for day in ("2026-03-01", "2026-03-03", "2026-03-02"):
        shutil.copytree(session, top / f"{day}T08-00-00_rock-1")
    assert main(asked) == 0
    take = top / "2026-03-09T08-00-00_free-play"
    shutil.copytree(session, take)
    (take / "take.json").write_text("{}")
    report = top / "2026-03-03T08-00-00_rock-1" / "report.json"
    report.write_text(report.read_text().replace('"student": "virtual student"', '"student": "the newest"'))
    capsys.readouterr()
    assert "free-play" in refused(capsys, *asked), "the last that was played was no lesson"
    assert main(("report", "2026-03-03", "--student", "Ada", "--out", str(out))) == 0
    assert "the newest" in out.read_text()


def test_a_session_whose_folder_is_gone_comes_from_the_history(
    session: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path))
    folder = Settings(student="Zoe").sessions_dir / "Zoe" / "2026-03-01T08-00-00_rock-1"
    shutil.copytree(session, folder)
    pages = [tmp_path / f"{number}.pdf" for number in range(2)]
    for page in pages:
        assert main(["report", "last", "--student", "Zoe", "--out", str(page)]) == 0
        shutil.rmtree(folder, ignore_errors=True)
    assert pages[0].read_bytes() == pages[1].read_bytes()


def test_what_is_no_session_is_said_in_one_line(
    session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "x.html"

    def said(named: Path) -> str:
        line = refused(capsys, "report", str(named), "--out", str(out))
        assert not out.exists()
        return line

    assert "there is no such file" in said(tmp_path / "nowhere")
    empty = tmp_path / "empty"
    empty.mkdir()
    assert "no session is in this folder" in said(empty)
    battle = tmp_path / "battle"
    battle.mkdir()
    shutil.copy(session / "session.capture", battle / "battle.capture")
    assert "is a battle; station battle --judge-again" in said(battle)
    take = tmp_path / "take"
    shutil.copytree(session, take)
    (take / "take.json").write_text("{}")
    assert "is free play" in said(take)
    assert "station lesson import" in said(take)
    text = tmp_path / "text.capture"
    text.write_text("no capture")
    assert "no capture of a drum kit" in said(text)


def test_a_page_is_named_html_or_pdf(session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line = refused(capsys, "report", str(session), "--out", str(tmp_path / "x.png"))
    assert "expected a name that ends in .html or .pdf" in line


@pytest.mark.parametrize("cut", [0, 9, 200, 4000, -1])
def test_a_capture_that_was_cut_gives_a_page_or_a_line(
    session: Path, tmp_path: Path, cut: int, capsys: pytest.CaptureFixture[str]
) -> None:
    data, path, out = (session / "session.capture").read_bytes(), tmp_path / "cut.capture", tmp_path / "x.html"
    path.write_bytes(data[:cut])
    status = main(["report", str(path), "--out", str(out)])
    said = capsys.readouterr().err
    assert (status, out.exists()) in ((0, True), (2, False))
    assert said.count("\n") == 1
    assert [each.name for each in tmp_path.iterdir() if each.suffix == ".part"] == []


def test_an_exam_has_its_marks_on_the_page(tmp_path: Path) -> None:
    folder, out = tmp_path / "exam", tmp_path / "x.html"
    words = ("exam", "rock-1", "--virtual-student", "intermediate,seed=4", "--report", str(folder))
    assert main(words) == 0
    assert main(["report", str(folder), "--out", str(out)]) == 0
    marks = json.loads((folder / "exam.json").read_text())["marks"]
    page = out.read_text()
    assert f"Exam: {marks['band']}, {int(marks['total'] * 10) / 10:.1f} of 100" in page
    assert page.count("<tr><td>Notes</td>") == 1


def test_a_folder_has_its_page_where_the_history_is_away(
    session: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert main(["report", str(session), "--out", str(tmp_path / "there.pdf")]) == 0
    save_settings(Settings(history="postgresql://nobody@127.0.0.1:1/nothing"))
    assert main(["report", str(session), "--out", str(tmp_path / "away.pdf")]) == 0
    assert (tmp_path / "away.pdf").read_bytes() == (tmp_path / "there.pdf").read_bytes()
    capsys.readouterr()
    assert "127.0.0.1" in refused(capsys, "report", "last", "--out", str(tmp_path / "last.pdf"))


def test_an_edited_report_is_named_with_what_it_lacks(
    session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    edited = tmp_path / "edited"
    shutil.copytree(session, edited)
    report = json.loads((edited / "report.json").read_text())
    del report["tempo"]
    (edited / "report.json").write_text(json.dumps(report))
    line = refused(capsys, "report", str(edited), "--out", str(tmp_path / "x.html"))
    assert f"{edited / 'report.json'}: is no whole report of a session: it lacks tempo" in line


def test_no_page_is_written_over_a_sessions_own_files(
    session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (session / "report.json").read_bytes()
    link = tmp_path / "x.pdf"
    link.symlink_to(session / "report.json")
    assert "is a link to" in refused(capsys, "report", str(session), "--out", str(link))
    assert (session / "report.json").read_bytes() == before


@pytest.mark.parametrize("day", ["9999-12-27", "9999-12-31"])
def test_a_week_that_has_no_end_is_refused(day: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line = refused(capsys, "report", "--week", day, "--out", str(tmp_path / "x.html"))
    assert "ends after the last day" in line
