"""Stick files: what is written reads back, every fault at its place."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.imu import Mounting
from station.core.pieces import Limb
from station.devices.mapping.stick_file import own_stick, parse_stick, save_stick, stick_path, stick_text

lengths = st.floats(0.0, 1.0)


@given(
    st.sampled_from([Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.UNKNOWN]),
    st.sampled_from([(1.0, 0.0, 0.0, 0.0), (0.5, -0.5, 0.5, 0.5), (0.1, 0.7, -0.7, 0.1), (0.0, 1e-9, -1.0, 0.0)]),
    lengths,
    lengths,
    st.booleans(),
)
def test_what_is_written_reads_back(
    limb: Limb, turn: tuple[float, float, float, float], tip_m: float, butt_m: float, learnt: bool
) -> None:
    mounting = Mounting(limb, turn, tip_m, butt_m, learnt)
    assert parse_stick(stick_text(mounting), "x") == mounting


def test_each_device_has_a_file_of_its_own(tmp_path: Path) -> None:
    left, right = Mounting(Limb.LEFT_HAND), Mounting(Limb.RIGHT_HAND, learnt=True)
    save_stick(left, "WT901 ble:AA:00", tmp_path)
    save_stick(right, "WT901 ble:BB:00", tmp_path)
    assert own_stick("WT901 ble:AA:00", tmp_path) == left
    assert own_stick("WT901 ble:BB:00", tmp_path) == right
    assert own_stick("WT901 ble:CC:00", tmp_path) == Mounting()
    assert stick_path("WT901 ble:AA:00", tmp_path).parent == tmp_path


def test_devices_whose_long_names_differ_at_the_end_have_files_of_their_own(tmp_path: Path) -> None:
    """As the paths in /dev/serial/by-id do."""
    names = [f"serial:/dev/serial/by-id/usb-Silicon_Labs_CP2102N_USB_to_UART_Bridge_Controller_{end}" for end in "ab"]
    save_stick(Mounting(Limb.LEFT_HAND), names[0], tmp_path)
    save_stick(Mounting(Limb.RIGHT_HAND), names[1], tmp_path)
    assert [own_stick(name, tmp_path).limb for name in names] == [Limb.LEFT_HAND, Limb.RIGHT_HAND]


def test_what_is_not_said_is_assumed() -> None:
    assert parse_stick('limb = "left_hand"', "x") == Mounting(Limb.LEFT_HAND)
    assert parse_stick("", "x") == Mounting()


@pytest.mark.parametrize(
    ("text", "place", "fault"),
    [
        ('limb = "right_foot"', "line 1, column 8", "right_hand, left_hand or unknown"),
        ("turn = [1, 1, 0, 0]", "line 1, column 8", "whose squares make 1"),
        ("turn = [1, 0, 0]", "line 1, column 8", "found 3 entries"),
        ("\ntip_m = -1", "line 2, column 9", "from 0 to 1"),
        ("tipp_m = 0.3", "line 1, column 1", "did you mean tip_m"),
        ("learnt = 1", "line 1, column 10", "true or false"),
    ],
)
def test_a_fault_is_named_with_its_place(tmp_path: Path, text: str, place: str, fault: str) -> None:
    path = tmp_path / "one.toml"
    path.write_text(text)
    with pytest.raises(BadInput, match=fault) as found:
        own_stick("one", tmp_path)
    assert (found.value.source, found.value.place) == (str(path), place)
