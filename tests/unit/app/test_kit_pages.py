"""The terminal's pages that teach and watch a kit, with a fake module's bytes; expected lines by hand."""

from pathlib import Path

import pytest

from station.cli.device_pages.devices_learn import LearnPage
from station.cli.device_pages.devices_learn_pad import OnePadPage
from station.cli.device_pages.devices_monitor import MonitorPage
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, ns_from_ms
from station.devices.mapping.device_file import kits_folder, own_kit
from station.devices.mapping.velocity_curve import SHAPES, VelocityCurve
from station.devices.port_watch import PortPoll
from station.devices.transport import Packet
from station.devices.wizard.pad_choices import pad_named
from station.devices.wizard.wizard_steps import STEPS
from tests.fakes.module import FakeModule
from tests.unit.devices.wizard.drummer import answer

DEVICE = "Home-made"
KIT = FakeModule(
    {"kick": 1, "snare": 2, "open": 3, "closed": 4, "half": 3, "crash_1": 5, "ride": 6},
    crosstalk={"kick": [(2, 0.2, 4.0)]},
)


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))


def found() -> PortPoll:
    return PortPoll(DEVICE, [], found=True)


def packets(*sent: tuple[float, str]) -> PortPoll:
    return PortPoll(DEVICE, [Packet(bytes.fromhex(data), ns_from_ms(ms)) for ms, data in sent])


def taught(page: LearnPage, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """Answer all that the page asks; a step that nothing answers is skipped. Returns the questions."""
    page.handle(found())
    now_ms, asked = 1000.0, list[str]()
    page.advance(0)
    for step in STEPS:
        asked.append(capsys.readouterr().out)
        sent = sorted(answer(KIT, step, now_ms))
        page.handle(PortPoll(DEVICE, [Packet(data, ns_from_ms(ms)) for ms, data in sent]))
        now_ms += 9_000
        page.advance(round(now_ms) * NS_PER_MS)
        shown = capsys.readouterr().out
        if not shown.startswith("\n"):
            page.key("")
            now_ms += 1000
            page.advance(round(now_ms) * NS_PER_MS)
            shown = capsys.readouterr().out
        asked[-1] += shown
        now_ms += 1000
    return asked


def test_a_kit_is_taught_tried_and_kept(capsys: pytest.CaptureFixture[str]) -> None:
    page = LearnPage(lambda: True)
    asked = "".join(taught(page, capsys))
    assert f"1/{len(STEPS)}  kick: 3 firm single strokes" in asked
    assert "kick is heard by snare" in asked
    assert page.kept is None
    page.handle(packets((900_000, "99 06 64")))
    assert "ride" in capsys.readouterr().out
    page.key("")
    assert page.over
    kit = own_kit(DEVICE)
    assert kit is not None
    assert [kit.notes[number].piece for number in (1, 2, 5, 6)] == [Piece.KICK, Piece.SNARE, Piece.CRASH_1, Piece.RIDE]
    assert [(rule.source, rule.victim) for rule in kit.crosstalk] == [(Piece.KICK, Piece.SNARE)]


def test_q_keeps_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    page = LearnPage(lambda: True)
    page.handle(found())
    page.key("q")
    assert page.over
    assert not kits_folder().exists()


def test_where_nobody_presses_keys_the_kit_is_kept_in_the_end(capsys: pytest.CaptureFixture[str]) -> None:
    page = LearnPage(lambda: False)
    page.handle(found())
    page.key("f")
    page.advance(NS_PER_MS)
    assert page.over
    assert page.kept == kits_folder() / "Home-made.toml"


# --- the monitor -----------------------------------------------------------------------------------------------------


def test_a_hit_is_shown_with_all_that_it_tells() -> None:
    page = MonitorPage(0)
    page.handle(PortPoll("TD-11", [], found=True))
    (moved, hit) = page.handle(PortPoll("TD-11", [Packet(bytes.fromhex("b9 04 2d"), 0), Packet(b"\x99\x2e\x64", 0)]))
    assert "openness 0.50" in moved
    assert hit.split() == [
        "0.0000",
        "hi-hat",
        "bow,",
        "normal",
        "velocity",
        "100",
        "openness",
        "0.50",
        "99",
        "2e",
        "64",
    ]
    (hit,) = page.handle(PortPoll("TD-11", [Packet(bytes.fromhex("b9 10 7f 99 26 50"), 5)]))
    assert "position 1.00" in hit


def test_bytes_that_make_no_event_are_shown_and_chatter_is_not() -> None:
    page = MonitorPage(0)
    page.handle(found())
    assert page.handle(packets((1, "fe"), (2, "f8"))) == []
    assert [line.split() for line in page.handle(packets((3, "d9 05")))] == [["0.0030", "d9", "05"]]


def test_a_suspect_is_marked_with_the_rule_that_holds_it_back_and_the_rule_is_kept() -> None:
    page = MonitorPage(0)
    page.handle(found())
    shown = page.handle(packets((0, "99 24 64"), (4, "99 26 14")))
    assert shown[-1].strip() == "? crosstalk? snare 4.0 ms after kick, 20% as loud: ghost kick snare 0.25"
    assert page.obey("ghost kick snare 0.25") == ["Home-made: ghost kick snare 0.25"]
    shown = page.handle(packets((1000, "99 24 64"), (1004, "99 26 14")))
    assert "no stroke: crosstalk of kick  99 26 14" in shown[-1]
    assert "kept in" in page.obey("save")[0]
    kit = own_kit(DEVICE)
    assert kit is not None
    assert [(rule.source, rule.victim, rule.share) for rule in kit.crosstalk] == [(Piece.KICK, Piece.SNARE, 0.25)]


def test_a_doubtful_hit_is_shown_when_the_clock_has_cleared_it() -> None:
    page = MonitorPage(0)
    page.handle(found())
    page.obey("ghost kick snare 0.25")
    assert page.handle(packets((10, "99 26 14"))) == []
    assert "snare" in page.settle(30 * NS_PER_MS)[0]


@pytest.mark.parametrize(
    ("order", "rule"),
    [
        ("mask snare 9", "double trigger? snare 8.0 ms after snare, 50% as loud: mask snare 10"),
        ("threshold snare 60", "double trigger? snare 8.0 ms after snare, 50% as loud: mask snare 10"),
    ],
)
def test_typed_rules_hold_at_once(order: str, rule: str) -> None:
    page = MonitorPage(0)
    page.handle(found())
    strokes = ((0.0, "99 26 64"), (8.0, "99 26 32"))
    assert rule in page.handle(packets(*strokes))[-1]
    page.obey(order)
    later = page.handle(packets(*((ms + 1000, data) for ms, data in strokes)))
    assert ["no stroke" in line for line in later] == [False, True]


@pytest.mark.parametrize("order", ["mask", "mask snaer 9", "mask snare 1000", "ghost kick kick 0.3", "jump", ""])
def test_a_rule_that_is_none_is_told_and_changes_nothing(order: str) -> None:
    page = MonitorPage(0)
    page.handle(found())
    (line,) = page.obey(order)
    assert "expected" in line or "no such piece" in line or "its own" in line
    assert not kits_folder().exists()


def test_one_pad_is_learnt_with_one_hit(capsys: pytest.CaptureFixture[str]) -> None:
    page = OnePadPage(lambda editor: editor.learn_pad(pad_named("tom_1/rim")))
    page.handle(found())
    page.advance(0)
    assert capsys.readouterr().out == "hit it now, once: high tom, rim\n"
    page.handle(packets((1000.0, "99 43 60")))
    page.advance(1300 * NS_PER_MS)
    assert capsys.readouterr().out == "note 67 (channel 10) is the high tom, rim\n"
    assert page.over
    assert page.kept.is_file()
    kit = own_kit(DEVICE)
    assert kit is not None
    assert kit.strike(10, 67) == pad_named("tom_1/rim")


def test_a_touch_that_cannot_be_told_is_asked_for_once_more(capsys: pytest.CaptureFixture[str]) -> None:
    page = OnePadPage(lambda editor: editor.learn_velocity(Piece.SNARE))
    page.handle(found())
    page.advance(0)
    velocities = [60] * 10 + [20] * 5 + [100] * 5
    for k, velocity in enumerate(velocities):
        page.handle(packets((1000.0 + 500 * k, f"99 26 {velocity:02x}")))
        page.advance((1400 + 500 * k) * NS_PER_MS)
    shown = capsys.readouterr().out
    assert "told apart" in shown
    assert shown.count("play five ghost strokes, 0 of 5") == 2
    assert page.over
    kit = own_kit(DEVICE)
    assert kit is not None
    assert [kit.pad(Piece.SNARE).curve.table[sent] for sent in (20, 100)] == [32, 116]


def test_a_curve_and_a_note_are_typed(capsys: pytest.CaptureFixture[str]) -> None:
    page = MonitorPage(0)
    page.handle(found())
    for line in ("curve snare light", "curve kick 5 110 -0.5", "note 67 tom_1/rim", "save"):
        page.obey(line)
    (told,) = page.handle(packets((100.0, "99 26 20")))
    assert "velocity  32  counts as 48" in told
    kit = own_kit(DEVICE)
    assert kit is not None
    assert kit.pad(Piece.SNARE).curve == SHAPES["light"]
    assert kit.pad(Piece.KICK).curve == VelocityCurve(5.0, 110.0, -0.5)
    assert kit.strike(4, 67) == pad_named("tom_1/rim")
    for line, fault in (
        ("curve snare softly", "no such shape"),
        ("curve snare 50 40 0", "expected a number from 60 to 400"),
        ("curve snare 5", "no such shape"),
        ("note 200 kick", "expected a number from 0 to 127"),
        ("note 40 kick/rim", "no such zone"),
    ):
        assert fault in page.obey(line)[0]
