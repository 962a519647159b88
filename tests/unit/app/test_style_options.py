"""The figure panel's state, with numbers by hand from the thesis's rules (§ 4.1.1)."""

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from station.app.style.style_controls import CONTROLS, TABS, WORD_LABELS
from station.app.style.style_library import StyleLibrary
from station.app.style.style_options import StyleOptions
from station.core.errors import BadInput, DeviceError
from station.core.pieces import Piece
from station.gui.widgets.lane_frame import LaneFrame
from station.motion.style.style import JOINTS, NUMBERS, WORDS, Style
from station.motion.style.style_file import load_style

JAZZ = load_style("jazz")


def shares(options: StyleOptions, kind: str = "amplitude") -> list[float]:
    return [options.value(f"{kind}_{joint}") for joint in JOINTS]


def test_every_control_of_a_style_is_on_the_page_once() -> None:
    shown = [control.name for tab in TABS for group in tab.groups for control in group.controls]
    assert sorted(shown) == sorted(NUMBERS)
    assert len(CONTROLS) == len(shown)
    assert set(WORD_LABELS) == set(WORDS)
    elsewhere = {"name", "seed", "pieces", "automation"}
    assert {f.name for f in fields(Style)} == {*shown, *WORDS, *elsewhere}
    assert all(control.about for control in CONTROLS.values())


def test_one_share_takes_from_the_other_two_which_keep_their_ratio() -> None:
    options = StyleOptions.of(Style(amplitude_wrist=40, amplitude_elbow=40, amplitude_shoulder=20))
    options = options.put("amplitude_wrist", 70)
    assert shares(options) == pytest.approx([70, 20, 10])
    assert shares(options, "frequency") == [34, 33, 33]


def test_unconstrained_each_is_set_for_itself() -> None:
    options = StyleOptions.of(Style())
    options = options.constrain(False)
    options = options.put("amplitude_wrist", 90)
    assert shares(options) == [90, 30, 30]
    assert StyleOptions.of(options.style).unconstrained, "a style says itself that its shares are none"


def test_made_shares_again_the_movement_stays() -> None:
    """60, 60 and 30 under a gain of 50 are 40, 40 and 20 per cent of a gain of 75."""
    options = StyleOptions.of(Style(amplitude_wrist=60, amplitude_elbow=60, amplitude_shoulder=30))
    before = [options.factor(f"amplitude_{joint}") for joint in JOINTS]
    options = options.constrain(True)
    assert shares(options) == pytest.approx([40, 40, 20])
    assert options.value("amplitude_gain") == pytest.approx(75)
    assert [options.factor(f"amplitude_{joint}") for joint in JOINTS] == pytest.approx(before)
    assert options.factor("whip") is None


def test_three_joints_set_to_nothing_are_shared_as_in_nature() -> None:
    options = StyleOptions.of(Style(amplitude_wrist=0, amplitude_elbow=0, amplitude_shoulder=0))
    options = options.constrain(True)
    assert shares(options) == pytest.approx([40, 30, 30])
    assert options.value("amplitude_gain") == 0, "nothing moved, nothing moves"


def test_values_stay_in_their_ranges() -> None:
    options = StyleOptions.of(Style())
    for name, wanted, found in (("stand", 3.0, 1.0), ("wing_deg", -90.0, -10.0), ("snare", 200.0, 100.0)):
        options = options.put(name, wanted)
        assert options.value(name) == found


def test_a_reset_goes_back_to_the_chosen_style() -> None:
    options = StyleOptions.of(JAZZ)
    options = options.put("amplitude_neck", 99)
    options = options.put("snare", 70)
    options = options.say("grip_left", "french")
    options = options.sow(8)
    for name in ("amplitude_neck", "snare", "grip_left", "seed"):
        assert options.can_reset(name)
        options = options.reset(name)
        assert not options.can_reset(name)
    assert not options.is_changed
    assert options.style == JAZZ


def test_a_piece_s_own_amplitude_of_the_chosen_style_comes_back() -> None:
    options = StyleOptions.of(Style(pieces={Piece.RIDE: 30.0}))
    options = options.put("ride", 80)
    options = options.put("snare", 60)
    options = options.reset("ride")
    assert dict(options.style.pieces) == {Piece.RIDE: 30.0, Piece.SNARE: 60.0}


def test_a_lane_is_held_within_its_range_and_ends_without_a_trace() -> None:
    options = StyleOptions.of(Style(amplitude_back=35.0))
    options = options.draw_lane("amplitude_back", ((1.0, -20.0), (3.0, 400.0)))
    assert options.lane("amplitude_back") == ((1.0, 0.0), (3.0, 100.0))
    options = options.end_lane("amplitude_back")
    assert not options.is_changed


def test_slots_keep_and_give_back() -> None:
    options = StyleOptions.of(JAZZ)
    options = options.put("amplitude_gain", 20)
    options = options.store(2, "small jazz")
    options = options.choose(Style())
    assert options.recall(1) is options, "empty"
    options = options.recall(2)
    assert options.style.name == "small jazz"
    assert options.style.amplitude_gain == 20


# --- files ------------------------------------------------------------------------------------------------------------


def test_saved_styles_are_files_that_are_listed_and_read_again(tmp_path: Path) -> None:
    shelf = StyleLibrary(tmp_path / "styles")
    assert not any(entry.is_own for entry in shelf.entries())
    mine = replace(JAZZ, amplitude_neck=12.0, automation={"stand": ((1.0, 0.0), (2.0, 1.0))})
    saved = shelf.save(mine, " My swing ")
    assert [entry for entry in shelf.entries() if entry.is_own] == [saved]
    read = load_style(saved.source)
    assert replace(read, name=mine.name) == mine
    latest = shelf.keep(mine)
    assert [e.label for e in shelf.entries() if e.is_own] == ["My swing", "latest"]
    assert shelf.load(latest).amplitude_neck == 12.0


def test_slots_stay_in_the_folder_and_are_no_style_of_the_list(tmp_path: Path) -> None:
    shelf = StyleLibrary(tmp_path)
    shelf.keep_slots(shelf.slots().stored(7, JAZZ))
    last = shelf.slots().styles[7]
    assert last is not None
    assert last.name == "jazz"
    assert not any(entry.is_own for entry in shelf.entries())


@pytest.mark.parametrize("name", ["", "  ", "a/b", "..", "slots", "latest", 'say "x"'])
def test_a_name_that_is_no_file_s_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(BadInput, match="expected a name"):
        StyleLibrary(tmp_path).save(JAZZ, name)


def test_a_folder_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    (tmp_path / "styles").write_text("no folder")
    with pytest.raises(DeviceError):
        StyleLibrary(tmp_path / "styles").save(JAZZ, "mine")


# --- the lane's picture -----------------------------------------------------------------------------------------------

FRAME = LaneFrame(bars=2, beats=4, low=0.0, high=100.0)


def test_a_place_is_meant_on_the_nearest_beat_and_within_the_frame() -> None:
    assert FRAME.point(2.5, 25.0) == (2.5, 25.0)
    assert FRAME.point(2.57, 25.0) == (2.5, 25.0)
    assert FRAME.point(99.0, 125.0) == (3.0, 100.0)
    assert FRAME.point(-1.0, -5.0) == (1.0, 0.0)


def test_a_drag_draws_a_point_on_every_beat_that_it_passes() -> None:
    """From the first beat at 0 to the fourth at 75, a line that rises by 25 a beat; drawn back, the same."""
    line = [(1.0, 0.0), (1.25, 25.0), (1.5, 50.0), (1.75, 75.0)]
    assert np.array(FRAME.stroke((1.0, 0.0), (1.75, 75.0))) == pytest.approx(np.array(line))
    assert np.array(FRAME.stroke((1.75, 75.0), (1.0, 0.0))) == pytest.approx(np.array(line[::-1]))
    (one,) = FRAME.stroke((1.02, 50.0), (0.99, 55.0))
    assert one == pytest.approx((1.0, 55.0))
