from pathlib import Path

import pytest

from station.engine.engine import Engine
from station.engine.engine_main import _clicks, _drums
from station.engine.messages import Notice
from tests.fakes.sound_files import stroke


def test_a_users_own_kit_sounds(tmp_path: Path) -> None:
    for name in ("kick", "snare", "hihat"):
        (tmp_path / f"{name}.wav").write_bytes(stroke())
    engine = Engine()
    assert _drums(engine, str(tmp_path), 48_000).name == tmp_path.name
    assert engine.advance(0) == []


@pytest.mark.parametrize("name", ["nowhere", "\0", "kit.h2drumkit"])
def test_a_kit_that_cannot_be_had_is_told_and_replaced(name: str, tmp_path: Path) -> None:
    (tmp_path / "kit.h2drumkit").write_bytes(b"rubbish")
    engine = Engine()
    kit = _drums(engine, name if name != "kit.h2drumkit" else str(tmp_path / name), 48_000)
    assert kit.name == "acoustic"
    (told,) = [event for event in engine.advance(0) if isinstance(event, Notice)]
    assert "the acoustic kit plays instead" in told.text


def test_a_click_that_there_is_not_is_told_and_replaced() -> None:
    engine = Engine()
    assert len(_clicks(engine, "honk", 48_000)) > 3
    (told,) = [event for event in engine.advance(0) if isinstance(event, Notice)]
    assert "honk: no such click" in told.text
