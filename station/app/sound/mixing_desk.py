"""What each channel is heard at: the settings' levels, what is silent for the night, what is heard alone. Pure."""

from collections.abc import Mapping
from dataclasses import replace

from station.core.errors import BadInput
from station.core.settings import EVERYTHING, Settings
from station.engine.levels_option import (
    BUSES,
    CHANNELS,
    PIECES,
    SILENCED,
    USUAL,
    ChannelLevel,
    LevelCommand,
    command_of,
    levels_text,
    read_levels,
)
from station.engine.messages import SetMidiOut

DeskCommand = LevelCommand | SetMidiOut
_STUDENT, _MIDI_OUT = "student", "midi out"


def levels_of(settings: Settings) -> dict[str, ChannelLevel]:
    """What the settings say of channels; nothing where their words mean nothing, which was said when they were read."""
    try:
        return read_levels(settings.levels)
    except BadInput:
        return {}


def with_level(settings: Settings, channel: str, level: ChannelLevel) -> Settings:
    """The settings with the level of one channel; the words of the others stay in their order."""
    return replace(settings, levels=levels_text({**levels_of(settings), channel: level}))


def desk_commands(settings: Settings, solo: frozenset[str]) -> Mapping[str, DeskCommand]:
    """What the engine needs to be told of every channel, by its word, and of the MIDI output.

    Of the buses those of `solo` are heard, all where it has none; of the pieces likewise.
    """
    said = levels_of(settings)
    unheard = {*SILENCED[settings.heard], *([] if settings.own_sound else [_STUDENT])}
    for group in (BUSES, PIECES):
        if alone := solo & group.keys():
            unheard |= group.keys() - alone
    heard = {each: said.get(each, USUAL) for each in CHANNELS}
    heard |= {each: replace(heard[each], level=0.0) for each in unheard}
    port = settings.midi_out if settings.heard == EVERYTHING else ""
    return {each: command_of(each, level) for each, level in heard.items()} | {_MIDI_OUT: SetMidiOut(port or None)}


def changed(before: Mapping[str, DeskCommand], after: Mapping[str, DeskCommand]) -> list[DeskCommand]:
    """The commands of `after` that differ."""
    return [command for each, command in after.items() if command != before.get(each)]
