"""Assignments and notes: what is written is what is read, and what a stranger writes is refused in one line."""

import json
import zipfile
from dataclasses import replace
from datetime import UTC, datetime, timedelta, timezone
from typing import Any

import pytest

from station.core.errors import BadInput
from station.practice.exchange.assignment_file import assignment_bytes, lessons_of, parse_assignment
from station.practice.exchange.note_file import note_bytes, parse_note
from station.practice.exchange.parcel import Kind, kind_by_name
from station.practice.exchange.return_file import parse_return
from tests.parcels_made import ASSIGNMENT, NOTE, TEXT, changed, sealed, table_of, unzipped, zipped


@pytest.fixture(scope="module")
def assignment() -> bytes:
    return assignment_bytes(ASSIGNMENT)


def refusal(data: bytes) -> str:
    """The line that says why the assignment in `data`, or a lesson in it, is refused."""
    with pytest.raises(BadInput) as fault:
        lessons_of(parse_assignment(data, "x.drum-assignment"), "x.drum-assignment")
    assert "\n" not in str(fault.value)
    assert str(fault.value).isprintable()
    return str(fault.value)


# --- what is written is read ------------------------------------------------------------------------------------------


def test_an_assignment_comes_back_as_it_was(assignment: bytes) -> None:
    assert parse_assignment(assignment, "x") == ASSIGNMENT
    assert [lesson.title for lesson in lessons_of(ASSIGNMENT, "x")] == ["Three", "Four"]


def test_a_note_comes_back_as_it_was() -> None:
    assert parse_note(note_bytes(NOTE), "x") == NOTE
    assert NOTE.lines == (
        "Well done.",
        "three, session 1: goals reached, score 80, strokes: 1 accepted and 1 not accepted; softer",
        "Next: the same at 100",
    )


def test_what_to_do_next_is_a_line() -> None:
    assert replace(NOTE, words="a\nb", sessions=(), next="one\ntwo").lines == ("a", "b", "Next: one two")


def test_the_same_content_is_the_same_file(assignment: bytes) -> None:
    assert assignment_bytes(ASSIGNMENT) == assignment


def test_people_can_read_it_without_a_station(assignment: bytes) -> None:
    """Any zip program shows the lessons' texts, the table and a page in words."""
    members = unzipped(assignment)
    assert members["lessons/1.toml"].decode() == TEXT
    readme = members["README.txt"].decode()
    for said in ("Week 3", "Ms Okafor, Tuesday group", "Due Tuesday, 1 December 2026", "Slowly first.\nThen at tempo."):
        assert said in readme
    assert "* Three (three): 90 bpm, judged as elementary, 4 passes, 12.5 minutes, hands low" in readme
    assert "* Four (four), to the song Blue Monday, which does not travel with this file" in readme
    assert table_of(assignment)["due"] == "2026-12-01"


def test_times_are_those_of_the_world() -> None:
    noon = datetime(2026, 11, 23, 12, tzinfo=timezone(timedelta(hours=9)))
    data = assignment_bytes(replace(ASSIGNMENT, made=noon))
    assert table_of(data)["made"] == "2026-11-23T03:00:00Z"
    assert parse_assignment(data, "x").made == datetime(2026, 11, 23, 3, tzinfo=UTC)


def test_the_kind_is_told_by_the_name() -> None:
    assert kind_by_name("a/b.DRUM-Return") is Kind.RETURN
    assert kind_by_name("b.toml") is None


def test_what_could_not_be_read_is_not_written() -> None:
    with pytest.raises(BadInput, match=r"title: expected letters that can be printed, found U\+202E"):
        assignment_bytes(replace(ASSIGNMENT, title="\u202egpj.exe"))
    with pytest.raises(BadInput, match="grid is missing"):
        assignment_bytes(replace(ASSIGNMENT, lessons=(replace(ASSIGNMENT.lessons[0], text='title = "x"\n'),)))


# --- what is damaged --------------------------------------------------------------------------------------------------


def test_another_kind_is_named(assignment: bytes) -> None:
    with pytest.raises(BadInput, match="is an assignment, not a return"):
        parse_return(assignment, "x")
    assert "is a note, not an assignment" in refusal(note_bytes(NOTE))


def test_a_later_version_is_one_line(assignment: bytes) -> None:
    line = refusal(changed(assignment, schema="drum-station/assignment/2", swing={"new": "keys"}))
    assert "version 2, and this station reads version 1" in line


def test_every_flipped_bit_is_seen(assignment: bytes) -> None:
    """Of the file's bytes those that zip itself ignores (dates, extra fields) may change; nothing read may differ."""
    for at in range(0, len(assignment), 7):
        broken = bytearray(assignment)
        broken[at] ^= 0x10
        try:
            assert parse_assignment(bytes(broken), "x") == ASSIGNMENT
        except BadInput:
            continue


def test_every_cut_is_seen(assignment: bytes) -> None:
    for length in range(0, len(assignment), 11):
        with pytest.raises(BadInput):
            parse_assignment(assignment[:length], "x")


def test_a_change_without_new_sums_is_seen(assignment: bytes) -> None:
    members = unzipped(assignment)
    assert "lessons/2.toml: does not fit its checksum" in refusal(
        zipped({**members, "lessons/2.toml": members["lessons/2.toml"].replace(b"o", b"x")})
    )
    table = {**json.loads(members["manifest.json"]), "due": "2027-12-01"}
    line = refusal(zipped({**members, "manifest.json": json.dumps(table).encode()}))
    assert "manifest.json: does not fit its checksum" in line


# --- what means harm --------------------------------------------------------------------------------------------------

EVIL_NAMES = (
    *(
        "../../.bashrc",
        "/etc/passwd",
        "C:\\x.toml",
        "lessons/../1.toml",
        "lessons\\1.toml",
        "lessons/1.TOML",
        "Lessons/1.toml",
    ),
    *(
        "lessons/01.toml",
        "lessons/1.toml/",
        "CON",
        "lessons/x\u202elmot",
        "lessons/１.toml",
        "x" * 60_000,
        "lessons/\u0000.toml",
    ),
)


@pytest.mark.parametrize("name", EVIL_NAMES)
def test_a_member_has_a_name_of_ours(name: str, assignment: bytes) -> None:
    assert "has no member" in refusal(changed(assignment, {name: b"x"})) or name.endswith("/") or "\0" in name
    listed = unzipped(assignment)
    assert refusal(zipped([*listed.items(), (name, b"x")]))


def test_a_link_is_no_lesson(assignment: bytes) -> None:
    """What a link's member holds is a path: it is read as a text, and followed by nobody."""
    link = zipfile.ZipInfo("lessons/1.toml")
    link.external_attr = 0o120777 << 16
    members = unzipped(changed(assignment, {"lessons/1.toml": b"/etc/passwd"}))
    rows = [(link if name == link.filename else name, data) for name, data in members.items()]
    assert "three: line 1, column 1" in refusal(zipped(rows))


def test_twins_are_refused(assignment: bytes) -> None:
    rows = list(unzipped(assignment).items())
    assert "two of its members have one name" in refusal(zipped([*rows, rows[-1]]))


def test_a_bomb_stays_packed(assignment: bytes) -> None:
    """Forty megabytes of zeros that are said to be few, to be more than all memory, and said as they are."""
    members = unzipped(assignment)
    bomb = bytes(40 << 20)
    assert "lessons/1.toml: is larger than" in refusal(zipped({**members, "lessons/1.toml": bomb}))
    rows = [{"name": "lessons/1.toml", "bytes": 1 << 60, "sha256": "0" * 64}]
    assert "members[1].bytes: expected a whole number" in refusal(changed(assignment, members=rows))
    assert "holds more than 4 MiB" in refusal(changed(assignment, {"lessons/1.toml": bomb}))


LESSON = {"name": "three", "title": "Three", "file": "lessons/1.toml"}


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"id": "../../x"}, "id: expected 32 hexadecimal digits"),
        ({"revision": 10**30}, "revision: expected a whole number from 1"),
        ({"revision": True}, "revision: expected a whole number from 1"),
        ({"title": ""}, "title: expected a line of text"),
        ({"title": "x" * 100_000}, "title: expected 120 letters at most, found 100000"),
        ({"title": "a\x1b[2Jb"}, "title: expected letters that can be printed, found U+001B"),
        ({"teacher": "Ann\u202eevil"}, "teacher: expected letters that can be printed, found U+202E"),
        ({"teacher": "\ud800"}, "teacher: expected letters that can be printed, found U+D800"),
        ({"words": "\n" * 300 + "x"}, None),
        ({"words": "x\n" * 300}, "words: expected 200 lines at most"),
        ({"due": "2026-02-30"}, "due: expected a day such as 2026-12-01"),
        ({"due": "9999-12-01"}, "due: expected a day such as 2026-12-01"),
        ({"due": 20261201}, "due: expected text in quotes"),
        ({"made": "yesterday"}, "made: expected a time such as"),
        ({"lessons": []}, "lessons: expected 1 to 50, found 0"),
        ({"lessons": [LESSON] * 51}, "lessons: expected 1 to 50, found 51"),
        ({"lessons": [LESSON, {**LESSON, "name": "THREE"}]}, "two lessons have one name"),
        ({"lessons": [{**LESSON, "name": "../three"}]}, "lessons[1].name: expected a lesson's name"),
        ({"lessons": [{**LESSON, "name": "con"}]}, "lessons[1].name: expected a lesson's name"),
        ({"lessons": [{**LESSON, "name": "x.course"}]}, "lessons[1].name: expected a lesson's name"),
        ({"lessons": [{**LESSON, "file": "lessons/9.toml"}]}, '"lessons/9.toml" is missing'),
        (
            {"lessons": [{**LESSON, "goals": {"tempo_bpm": 1e300}}]},
            "goals.tempo_bpm: expected a number from 10 to 1000",
        ),
        ({"lessons": [{**LESSON, "goals": {"tempo_bpm": -1}}]}, "goals.tempo_bpm: expected a number from 10 to 1000"),
        ({"lessons": [{**LESSON, "goals": {"level": "god"}}]}, "goals.level: expected beginner"),
        ({"lessons": [{**LESSON, "goals": {"passes": 0}}]}, "goals.passes: expected a whole number"),
        ({"lessons": [{**LESSON, "sound": "/dev/zero"}]}, "lessons[1].sound: no such key"),
        ({"lessons": {"three": LESSON}}, "lessons: expected a list of lessons"),
        ({"lessons": [7]}, "lessons[1]: expected a table"),
    ],
)
def test_what_the_table_says_is_checked(keys: dict[str, Any], told: str | None, assignment: bytes) -> None:
    if told is None:
        assert parse_assignment(changed(assignment, **keys), "x").words == "x"
    else:
        assert told in refusal(changed(assignment, **keys))


def test_what_is_missing_is_named(assignment: bytes) -> None:
    members = unzipped(assignment)
    table = json.loads(members.pop("manifest.json"))
    del table["title"], table["members"]
    assert "manifest.json, title: is missing" in refusal(sealed(table, members))


@pytest.mark.parametrize(
    "manifest",
    [
        b"",
        b"[" * 500_000,
        b'{"a":' * 100_000,
        b'{"schema": "drum-station/assignment/1", "members": ' + b"9" * 5000 + b"}",
        b'{"schema": "drum-station/assignment/1", "id": 1, "id": 2}',
        b'{"schema": "drum-station/assignment/1", "id": NaN}',
        b'{"schema": "drum-station/assignment/1", "id": 1e400, "members": []}',
        b'{"schema": 7}',
        b"null",
        b"\xff\xfe",
        b'{"schema": "drum-station/assignment/99999999999"}',
        b'{"schema": "drum-station/assignment/1", "members": [' + b"{}," * 200_000 + b"{}]}",
        b" " * (2 << 20),
    ],
    ids=range(13),
)
def test_a_table_is_json_of_ours(manifest: bytes) -> None:
    assert "manifest.json" in refusal(zipped({"manifest.json": manifest}))


def test_ten_million_notes_are_refused(assignment: bytes) -> None:
    """By the lesson's own limits, and by the sum of all lessons."""
    lots = TEXT.replace("[grid]", "[grid]\ntimes = 100").replace("| o - o - |", "| o - o - " * 1000 + "|")
    assert "three: line 5, column 9: grid.snare: 400000 cells; a lesson has at most 200000" in refusal(
        changed(assignment, {"lessons/1.toml": lots.encode()})
    )
    some = TEXT.replace("[grid]", "[grid]\ntimes = 100").replace("| o - o - |", "|" + " oooo oooo oooo oooo |" * 4)
    names = [f"lesson-{number}" for number in range(1, 5)]
    lessons = [{**LESSON, "name": name, "file": f"lessons/{number}.toml"} for number, name in enumerate(names, 1)]
    members = {f"lessons/{number}.toml": some.encode() for number in range(1, 5)}
    line = refusal(changed(assignment, members, lessons=lessons))
    assert line == ("x.drum-assignment: lesson-2: more than 12000 strokes up to here in the lessons of one file")
