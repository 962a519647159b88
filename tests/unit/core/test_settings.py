"""Settings from TOML and back."""

import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.settings import Settings, load_settings, read_settings, save_settings, with_said


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "settings.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_no_file_means_defaults(tmp_path: Path) -> None:
    assert load_settings(tmp_path / "none.toml") == Settings()


def test_what_is_not_written_keeps_its_default(tmp_path: Path) -> None:
    assert load_settings(written(tmp_path, 'kit = "TD-17"\n')) == Settings(kit="TD-17")


def test_a_whole_number_does_where_a_fraction_is_expected(tmp_path: Path) -> None:
    assert load_settings(written(tmp_path, "input_latency_ms = 5\n")).input_latency_ms == 5.0


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("kti = 1", "line 1, column 1: no such setting: kti; did you mean kit?"),
        ("rate_hz = true", "line 1, column 11: rate_hz: expected a whole number from 8000 to 384000, found true"),
        ('block_frames = "64"', 'block_frames: expected a whole number from 0 to 8192, found "64"'),
        ("student = 3", 'student: expected text in quotes, such as "…", found 3'),
        ('output_latency_ms = "8"', 'output_latency_ms: expected a number from -1000 to 1000, found "8"'),
        ("own_sound = 1", "own_sound: expected true or false, found 1"),
        ("block_frames = -1", "block_frames: expected a whole number from 0 to 8192, found -1"),
        ("block_frames = 15", "block_frames: expected 0 (the driver's choice) or 16 to 8192, found 15"),
        ("rate_hz = 0", "rate_hz: expected a whole number from 8000 to 384000, found 0"),
        ("input_latency_ms = nan", "input_latency_ms: expected a number from -1000 to 1000, found nan"),
        ("output_latency_ms = 1e9", "output_latency_ms: expected a number from -1000 to 1000, found 1000000000.0"),
        ("mask_ms = 101", "mask_ms: expected a number from 0 to 100, found 101"),
        ('thresholds = "snaer=20"', 'thresholds: expected PIECE=1…127, such as snare=20, found "snaer=20"'),
        ('thresholds = "snare=128"', 'thresholds: expected PIECE=1…127, such as snare=20, found "snare=128"'),
        ('thresholds = "snare"', 'thresholds: expected PIECE=1…127, such as snare=20, found "snare"'),
        ('heard = "drums"', 'heard: expected everything, click or nothing, found "drums"'),
        ("track_bpm = 4000", "track_bpm: expected a number from 0 to 400, found 4000"),
        ("kit = 7x\nrate_hz = 48000\n", "line 1, column 8: "),
    ],
)
def test_a_fault_names_the_file_the_key_and_what_was_expected(tmp_path: Path, text: str, fault: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(BadInput) as raised:
        load_settings(path)
    assert str(raised.value).startswith(f"{path}: ")
    assert fault in str(raised.value)


def test_a_fault_loses_neither_the_file_nor_what_its_other_keys_say(tmp_path: Path) -> None:
    text = 'student = "Ada"\nrate_hz = "fast"\nkti = 3\ntheme = \nown_sound = false\n'
    path = written(tmp_path, text)
    settings, faults = read_settings(path)
    assert settings == Settings(student="Ada", own_sound=False)
    assert [(one.line, one.column) for one in faults] == [(2, 11), (3, 1), (4, 9)]
    with pytest.raises(BadInput, match=r"line 2, column 11: rate_hz: .* \(and 2 more: `station lesson check .*` lists"):
        load_settings(path)
    assert path.read_text(encoding="utf-8") == text


def test_what_the_command_line_says_is_checked_like_the_file() -> None:
    assert with_said(Settings(), {"mask_ms": 5, "kit": "TD"}, "practice") == Settings(mask_ms=5.0, kit="TD")
    with pytest.raises(BadInput, match=r"^practice: mask_ms: expected a number from 0 to 100, found 101$"):
        with_said(Settings(), {"mask_ms": 101}, "practice")


def test_a_file_that_is_not_text_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "settings.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(BadInput, match=r"settings\.toml"):
        load_settings(path)


def test_a_folder_in_its_place_is_refused_in_few_words(tmp_path: Path) -> None:
    with pytest.raises(BadInput) as raised:
        load_settings(tmp_path)
    assert str(raised.value) == f"{tmp_path}: cannot be read: Is a directory"


any_text = st.text(st.characters(exclude_categories=["Cs"]))


@given(
    settings=st.builds(
        Settings,
        student=any_text,
        kit=any_text,
        output=any_text,
        block_frames=st.one_of(st.just(0), st.integers(16, 8192)),
        rate_hz=st.integers(8000, 384_000),
        input_latency_ms=st.floats(-1000, 1000),
        own_sound=st.booleans(),
    )
)
def test_what_is_saved_is_toml_and_is_loaded_alike(
    settings: Settings, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = save_settings(settings, tmp_path_factory.mktemp("settings") / "settings.toml")
    assert tomllib.loads(path.read_text(encoding="utf-8"))["student"] == settings.student
    assert load_settings(path) == settings


def test_sessions_go_where_the_user_says() -> None:
    assert Settings(sessions="/music/drums").sessions_dir == Path("/music/drums")
    assert Settings().sessions_dir.name == "Drum station"


def test_thresholds_are_read_pad_by_pad() -> None:
    assert Settings(thresholds="snare=20 floor_tom_1=35").threshold_of == {Piece.SNARE: 20, Piece.FLOOR_TOM_1: 35}
    assert Settings().threshold_of == {}


@pytest.mark.parametrize("folder", ["~no-such-user/x", "a\0b"])
def test_a_folder_that_cannot_be_is_the_settings_fault(folder: str) -> None:
    with pytest.raises(BadInput, match=r"settings\.toml: sessions: "):
        Settings(sessions=folder).sessions_dir  # noqa: B018 - it raises
