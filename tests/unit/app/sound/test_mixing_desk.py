"""What each channel is heard at; the expected commands are written out by hand."""

from dataclasses import replace

import pytest

from station.app.sound.mixing_desk import changed, desk_commands, with_level
from station.core.pieces import Piece
from station.core.settings import Settings
from station.engine.levels_option import ChannelLevel
from station.engine.messages import Bus, SetLevel, SetMaster, SetMidiOut, SetPiece

NO_SOLO: frozenset[str] = frozenset()


def said(before: Settings, after: Settings, solo: frozenset[str] = NO_SOLO) -> list[object]:
    return list(changed(desk_commands(before, NO_SOLO), desk_commands(after, solo)))


def test_the_words_are_those_of_the_settings_and_what_is_usual_is_not_said() -> None:
    settings = with_level(Settings(levels="click=0.5 kick=1.3"), "demonstration", ChannelLevel(0.6, -1.0))
    assert settings.levels == "click=0.5 kick=1.3 demonstration=0.6@-1"
    assert with_level(settings, "click", ChannelLevel()).levels == "kick=1.3 demonstration=0.6@-1"


def test_only_what_changes_is_told() -> None:
    before = Settings(levels="click=0.5")
    assert said(before, before) == []
    assert said(before, with_level(before, "crash_1", ChannelLevel(0.6, -0.4))) == [SetPiece(Piece.CRASH_1, 0.6, -0.4)]
    assert said(before, with_level(before, "master", ChannelLevel(0.25))) == [SetMaster(0.25)]


@pytest.mark.parametrize(
    ("heard", "told"),
    [
        ("nothing", [SetMaster(0.0), SetMidiOut(None)]),
        (
            "click",
            [
                SetLevel(Bus.DEMONSTRATION, 0.0, -1.0),
                SetLevel(Bus.STUDENT, 0.0),
                SetLevel(Bus.BACKING, 0.0),
                SetMidiOut(None),
            ],
        ),
    ],
)
def test_silent_practice_keeps_every_level_for_the_morning(heard: str, told: list[object]) -> None:
    day = Settings(levels="demonstration=0.5@-1", midi_out="TD-17")
    night = replace(day, heard=heard)
    assert said(day, night) == told
    assert night.levels == day.levels
    assert SetLevel(Bus.DEMONSTRATION, 0.5, -1.0) in desk_commands(day, NO_SOLO).values()


def test_a_solo_among_pieces_leaves_the_buses_alone_and_the_other_way_round() -> None:
    told = said(Settings(), Settings(), frozenset({"snare"}))
    assert all(isinstance(command, SetPiece) for command in told)
    assert len(told) == len(Piece) - 1
    assert SetPiece(Piece.SNARE, 1.0) not in told
    assert said(Settings(), Settings(), frozenset({"click", "student"})) == [
        SetLevel(Bus.DEMONSTRATION, 0.0),
        SetLevel(Bus.BACKING, 0.0),
    ]


def test_a_module_that_sounds_itself_is_silent_here_whatever_the_level() -> None:
    assert said(Settings(), Settings(levels="student=0.8", own_sound=False)) == [SetLevel(Bus.STUDENT, 0.0)]
