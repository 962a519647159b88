import tomllib
from datetime import date
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.measured_latency import (
    DeviceLatency,
    MeasuredLatency,
    StoredCalibration,
    load_calibration,
    save_calibration,
)
from station.core.pieces import Piece

DAY = date(2026, 1, 31)
LATE = MeasuredLatency(4.25, 0.5, "strike", DAY)


def written(folder: Path, text: str) -> Path:
    path = folder / "calibration.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_no_file_says_nothing(tmp_path: Path) -> None:
    assert load_calibration(tmp_path / "none.toml") == StoredCalibration()


def test_a_file_by_hand_is_understood(tmp_path: Path) -> None:
    text = """
        [outputs."USB Audio (hw:1,0)"]
        latency_ms = -3
        half_ms = 0.1
        by = "loopback"
        on = 2026-01-31
        [kits.TD-17]
        latency_ms = 4.25
        half_ms = 0.5
        by = "strike"
        on = 2026-01-31
        [kits.TD-17.pads.snare]
        latency_ms = 6.0
        half_ms = 0.5
        by = "strike"
        on = 2026-01-31
        doubts = "scatter"
    """
    read = load_calibration(written(tmp_path, text))
    assert read.outputs["USB Audio (hw:1,0)"].latency_ms == -3.0
    assert read.kits["TD-17"].of_pad(Piece.SNARE) == MeasuredLatency(6.0, 0.5, "strike", DAY, "scatter")
    assert read.kits["TD-17"].of_pad(Piece.RIDE) == LATE


GOOD = 'latency_ms = 1\nhalf_ms = 1\nby = "tap"\non = 2026-01-31\n'


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("[inputs.x]\n" + GOOD, "line 1, column 1: no such table: inputs; did you mean outputs?"),
        ("outputs = 3", "outputs: expected a table"),
        ("[outputs]\nx = 3", "outputs.x: expected a table"),
        (
            "[outputs.x]\n" + GOOD.replace("= 1\n", "= 1001\n", 1),
            "line 2, column 14: outputs.x.latency_ms: expected a number",
        ),
        (
            "[outputs.x]\n" + GOOD.replace("= 1\n", "= nan\n", 1),
            "line 2, column 14: outputs.x.latency_ms: expected a number",
        ),
        ("[outputs.x]\n" + GOOD.replace("= 1\n", "= true\n", 1), "outputs.x.latency_ms: expected"),
        (
            "[outputs.x]\n" + GOOD.replace("half_ms = 1", "half_ms = -1"),
            "outputs.x.half_ms: expected a number from 0",
        ),
        ("[outputs.x]\n" + GOOD.replace('"tap"', "7"), 'outputs.x.by: expected text in quotes, such as "…", found 7'),
        ("[outputs.x]\n" + GOOD.replace("2026-01-31", "2026-01-31T10:00:00"), "outputs.x.on: expected a day"),
        ("[outputs.x]\n" + GOOD + "late = 1", "line 6, column 1: no such key: late; there are latency_ms, half_ms"),
        ("[kits.x.pads.snaer]\n" + GOOD, "line 1, column 1: no such piece: snaer; did you mean snare?"),
        ("[kits.x.pads.snare]\n" + GOOD, "line 1, column 1: kits.x.latency_ms is missing"),
        ("[kits.x]\n" + GOOD + "pads = 1", "kits.x.pads: expected a table"),
        ("[outputs.x] 7\n", "line 1, column 13: "),
    ],
)
def test_a_fault_is_named_with_its_place(tmp_path: Path, text: str, fault: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(BadInput) as raised:
        load_calibration(path)
    assert str(raised.value).startswith(f"{path}: ")
    assert fault in str(raised.value)


any_text = st.text(st.characters(exclude_categories=["Cs"]))
measured = st.builds(
    MeasuredLatency, st.floats(-1000, 1000), st.floats(0, 1000), any_text, st.dates(), st.one_of(st.just(""), any_text)
)


@given(
    outputs=st.dictionaries(any_text, measured, max_size=3),
    kits=st.dictionaries(
        any_text,
        st.builds(DeviceLatency, measured, st.dictionaries(st.sampled_from(Piece), measured, max_size=3)),
        max_size=3,
    ),
)
def test_what_is_saved_is_toml_and_is_loaded_alike(
    outputs: dict[str, MeasuredLatency], kits: dict[str, DeviceLatency], tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = save_calibration(StoredCalibration(outputs, kits), tmp_path_factory.mktemp("config") / "calibration.toml")
    assert set(tomllib.loads(path.read_text(encoding="utf-8")).get("outputs", {})) == set(outputs)
    assert load_calibration(path) == StoredCalibration(outputs, kits)


def test_a_pad_that_is_not_measured_again_keeps_its_latency() -> None:
    snare, ride = MeasuredLatency(6.0, 0.5, "strike", DAY), MeasuredLatency(3.0, 0.5, "strike", DAY)
    once = StoredCalibration().with_kit("TD-17", DeviceLatency(LATE, {Piece.SNARE: snare, Piece.RIDE: snare}))
    again = once.with_kit("TD-17", DeviceLatency(LATE, {Piece.RIDE: ride}))
    assert dict(again.kits["TD-17"].pads) == {Piece.SNARE: snare, Piece.RIDE: ride}
    assert once.kits["TD-17"].pads[Piece.RIDE] == snare
