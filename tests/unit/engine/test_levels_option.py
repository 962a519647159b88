import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.settings import Settings
from station.engine.engine_config import EngineConfig
from station.engine.levels_option import parse_levels
from station.engine.messages import Bus, SetLevel, SetMidiOut, SetPiece


def test_words_make_levels() -> None:
    assert parse_levels("click=0 demonstration=0.5@-1 student=1@0.25 track=.7") == (
        SetLevel(Bus.CLICK, 0.0),
        SetLevel(Bus.DEMONSTRATION, 0.5, -1.0),
        SetLevel(Bus.STUDENT, 1.0, 0.25),
        SetLevel(Bus.BACKING, 0.7),
    )
    assert parse_levels("crash_1=0.6@-0.4 kick=2") == (
        SetPiece(Piece.CRASH_1, 0.6, -0.4),
        SetPiece(Piece.KICK, 2.0),
    )
    assert parse_levels("") == ()


@pytest.mark.parametrize(
    "word", ["drums=1", "click", "click=2", "click=-0.1", "click=nan", "click=1@2", "click=1@", "kick=2.1", "kcik=1"]
)
def test_a_word_that_cannot_be_is_named(word: str) -> None:
    with pytest.raises(BadInput, match="--levels"):
        parse_levels(f"student=1 {word}", "--levels")


def test_the_settings_reach_the_engine_and_a_module_that_sounds_itself_has_the_last_word() -> None:
    settings = Settings(levels="student=0.8 click=0.5", own_sound=False, midi_out="TD-17")
    assert EngineConfig.from_settings(settings).first_commands == (
        SetLevel(Bus.STUDENT, 0.8),
        SetLevel(Bus.CLICK, 0.5),
        SetLevel(Bus.STUDENT, 0.0),
        SetMidiOut("TD-17"),
    )
