"""The journal of a draft: what comes back after a crash, at any byte, of any file, and beside other windows."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from random import Random
from threading import Event, get_ident

import pytest

from station.app.editor.draft_journal import DraftJournal, drop_draft, left_drafts
from station.core.errors import DeviceError
from station.drills.editing.draft_records import change_record, read_records, start_record
from station.drills.editing.text_change import TextChange

BASE = 'title = "Grüße"\n'


def _crashed(folder: Path, *texts: str) -> Path:
    """The journal of an editor that was killed after `texts`: a copy that nobody holds."""
    journal = DraftJournal(folder / "of-another", Path("/lessons/first.toml"), BASE)
    for text in texts:
        journal.note(text, "stroke on snare, bar 2")
    assert journal.path is not None
    left = folder / journal.path.name
    left.parent.mkdir(parents=True, exist_ok=True)
    left.write_bytes(journal.path.read_bytes())
    journal.discard()
    return left


def test_what_was_told_comes_back(tmp_path: Path) -> None:
    path = _crashed(tmp_path, BASE + "a", BASE + "ab\ud800", BASE)
    assert left_drafts(tmp_path) == []  # the text is as the editing began: there is nothing to rescue
    path = _crashed(tmp_path, BASE + "a", BASE + "ab")
    (left,) = left_drafts(tmp_path)
    assert left.path == path
    draft = left.draft
    assert (draft.lesson, draft.base, draft.text) == ("/lessons/first.toml", BASE, BASE + "ab")
    assert (draft.name, draft.changes) == ("stroke on snare, bar 2", 2)


def test_nothing_lies_there_before_the_first_change_nor_after_saving(tmp_path: Path) -> None:
    journal = DraftJournal(tmp_path / "drafts", None, BASE)
    journal.note(BASE, "nothing")
    assert not (tmp_path / "drafts").exists()
    journal.note("a", "first")
    assert journal.path is not None
    assert journal.path.exists()
    journal.saved("a")
    assert list((tmp_path / "drafts").iterdir()) == []
    journal.note("ab", "after saving")
    assert journal.path is not None
    records = read_records(journal.path.read_bytes())
    assert records is not None
    assert (records.base, records.text) == ("a", "ab")
    journal.close()
    assert [left.draft.text for left in left_drafts(tmp_path / "drafts")] == ["ab"]


def test_a_draft_that_is_as_it_began_is_not_left(tmp_path: Path) -> None:
    journal = DraftJournal(tmp_path, None, BASE)
    journal.note("a", "there")
    journal.note(BASE, "and back")
    journal.close()
    assert list(tmp_path.iterdir()) == []


def test_two_windows_on_one_lesson_do_not_meet(tmp_path: Path) -> None:
    windows = [DraftJournal(tmp_path, Path("/lessons/first.toml"), BASE) for _ in range(2)]
    for i in range(20):
        for w, window in enumerate(windows):
            window.note(f"{BASE}{w} {i}", "typed")
    assert left_drafts(tmp_path) == []  # both live
    paths = [window.path for window in windows]
    assert all(path is not None and DraftJournal.resumed(path) is None for path in paths)
    for path in paths:
        assert path is not None
        drop_draft(path)
        assert path.exists()
    for window in windows:
        window.close()
    assert sorted(left.draft.text for left in left_drafts(tmp_path)) == [f"{BASE}0 19", f"{BASE}1 19"]


def test_editing_goes_on_in_the_draft_that_was_left(tmp_path: Path) -> None:
    path = _crashed(tmp_path, BASE + "a")
    with path.open("ab") as file:
        file.write(b"1a 0000")  # torn
    resumed = DraftJournal.resumed(path)
    assert resumed is not None
    journal, draft = resumed
    assert draft.text == BASE + "a"
    assert DraftJournal.resumed(path) is None  # one window alone
    journal.note(BASE + "ab", "more")
    journal.close()
    (left,) = left_drafts(tmp_path)
    assert (left.draft.text, left.draft.changes) == (BASE + "ab", 2)
    drop_draft(path)
    assert left_drafts(tmp_path) == []
    assert DraftJournal.resumed(path) is None


def test_a_journal_cut_at_any_byte_gives_the_last_whole_text() -> None:
    lines = [
        start_record("", BASE),
        change_record(TextChange(0, "", "x"), "one"),
        change_record(TextChange(1, "t", ""), ""),
    ]
    texts = [BASE, "x" + BASE, "x" + BASE[1:]]
    data, ends = b"".join(lines), [sum(map(len, lines[: i + 1])) for i in range(3)]
    for cut in range(len(data) + 1):
        draft, whole = read_records(data[:cut]), sum(end <= cut for end in ends)
        assert (draft is None) == (whole == 0)
        assert draft is None or (draft.text, draft.good_bytes) == (texts[whole - 1], ends[whole - 1])


def test_no_bytes_at_all_raise_anything() -> None:
    random = Random(3)
    good = start_record("", BASE) + b"".join(change_record(TextChange(i, "", "x"), "n") for i in range(5))
    for _ in range(500):
        data = bytearray(good)
        for _ in range(random.randrange(1, 4)):
            data[random.randrange(len(data))] = random.randrange(256)
        draft = read_records(bytes(data))
        assert draft is None or draft.text in [i * "x" + BASE for i in range(6)]
    deep = b"[" * 100_000
    assert read_records(deep) is None
    wrong = change_record(TextChange(99, "no", "yes"), "does not fit")
    draft = read_records(good + wrong + good)
    assert draft is not None
    assert draft.changes == 5


def test_a_folder_that_takes_nothing_is_told_and_tried_again(tmp_path: Path) -> None:
    folder = tmp_path / "drafts"
    folder.write_text("in the way")
    journal = DraftJournal(folder, None, BASE)
    with pytest.raises(DeviceError, match="draft cannot be kept"):
        journal.note("a", "first")
    folder.unlink()
    journal.note("ab", "second")
    assert journal.path is not None
    records = read_records(journal.path.read_bytes())
    assert records is not None
    assert records.text == "ab"
    journal.discard()


def test_a_disk_that_fills_up_tears_no_record(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = DraftJournal(tmp_path, None, BASE)
    journal.note("a", "first")
    write = os.write
    monkeypatch.setattr(os, "write", lambda descriptor, data: write(descriptor, data[: len(data) // 2]))
    with pytest.raises(DeviceError, match="full"):
        journal.note("ab", "second")
    monkeypatch.undo()
    journal.note("abc", "third")
    assert journal.path is not None
    records = read_records(journal.path.read_bytes())
    assert records is not None
    assert (records.text, records.changes) == ("abc", 2)
    journal.discard()


def test_the_disk_keeps_up_in_a_thread_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    synced, threads, fsync = Event(), [], os.fsync

    def watched(descriptor: int) -> None:
        fsync(descriptor)
        threads.append(get_ident())
        synced.set()

    monkeypatch.setattr(os, "fsync", watched)
    journal = DraftJournal(tmp_path, None, BASE)
    for i in range(100):
        journal.note(f"a{i}", "typed")
    assert synced.wait(10)
    assert get_ident() not in threads
    assert len(threads) <= 2  # a hundred edits within a second cost the disk one turn or two
    journal.discard()


def test_a_long_journal_begins_anew_with_the_text_as_it_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("station.app.editor.draft_journal.MAX_GROWTH", 2000)
    journal, paths = DraftJournal(tmp_path, Path("/lessons/first.toml"), BASE), set()
    for i in range(200):
        journal.note(f"{BASE}{i}", "typed")
        assert journal.path is not None
        assert journal.path.stat().st_size < 3000
        paths.add(journal.path)
    assert len(paths) > 3
    assert len(list(tmp_path.iterdir())) == 1
    journal.close()
    (left,) = left_drafts(tmp_path)
    assert (left.draft.base, left.draft.text) == (BASE, f"{BASE}199")


_EDITOR = """
import os, sys
from pathlib import Path
from station.app.editor.draft_journal import DraftJournal

journal = DraftJournal(Path(sys.argv[1]), Path("/lessons/first.toml"), "begin\\n")
text = "begin\\n"
for i in range(10**9):
    text += f"stroke {i}\\n" if len(text) < 20_000 else ""
    text = text[6:] if len(text) >= 20_000 else text
    journal.note(text, "stroke")
    os.write(1, b"%d\\n" % i)
"""


def _text_after(edits: int) -> str:
    text = "begin\n"
    for i in range(edits):
        text += f"stroke {i}\n" if len(text) < 20_000 else ""
        text = text[6:] if len(text) >= 20_000 else text
    return text


@pytest.mark.skipif(sys.platform == "win32", reason="Windows knows no SIGKILL")
def test_a_kill_in_the_middle_of_editing_loses_no_edit_that_was_told(tmp_path: Path) -> None:
    """At most the one edit that was under way is missing or more than told, whenever the child is killed."""
    for seed in range(3):
        folder = tmp_path / str(seed)
        child = subprocess.Popen([sys.executable, "-c", _EDITOR, str(folder)], stdout=subprocess.PIPE)
        assert child.stdout is not None
        told = 0
        for _ in range(Random(seed).randrange(1, 4000)):
            told = int(child.stdout.readline()) + 1
        os.kill(child.pid, signal.SIGKILL)
        rest = child.stdout.read().decode().splitlines(keepends=True)
        child.stdout.close()
        child.wait()
        told = max([told, *(int(line) + 1 for line in rest if line.endswith("\n"))])
        (left,) = left_drafts(folder)
        assert left.draft.text in (_text_after(told), _text_after(told + 1))
