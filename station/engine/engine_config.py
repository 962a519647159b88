"""What the engine process opens, what it is sent before anything else, and how it says that it cannot go on."""

from dataclasses import dataclass
from typing import Self

from station.core.settings import EVERYTHING, Settings, setting_source
from station.devices.device_ports import DeviceRequest, parse_devices
from station.devices.stick_ports import parse_sticks
from station.engine.levels_option import SILENCED, ChannelLevel, LevelCommand, command_of, parse_levels
from station.engine.messages import Bus, Command, SetAirDrums, SetLevel, SetMidiOut
from station.sync.air.air_drums import AIR_AHEAD_NS
from station.sync.air.air_file import air_path, read_air
from station.sync.air.air_zones import AirKit

_CHOSEN = Settings()

WORN_OUT = 3
"""The exit status of an engine that ended because only a new process will sound again."""


@dataclass(frozen=True, slots=True)
class Prepare:
    """What a process that waits as a spare makes ready meanwhile: the drums and the click of that name at a rate."""

    drums: str
    click: str
    rate_hz: int


@dataclass(frozen=True, slots=True)
class EngineConfig:
    """What the engine process opens.

    `kits` are those to listen to, none for an engine without, `sticks` the sensors on the sticks; `midi_driver` is
    "auto" or one of `station.devices.midi.midi_ports.compiled_drivers()`; `output`, `block_frames`, `rate_hz`, `drums`,
    `click`, `own_sound`, `levels`, `heard` and `midi_out` stand as in `Settings`; without `sound` no card is opened.
    `air` is the kit that the sticks play in the air, None for none.
    """

    kits: tuple[DeviceRequest, ...] = (DeviceRequest(""),)
    sticks: tuple[DeviceRequest, ...] = ()
    midi_driver: str = "auto"
    sound: bool = True
    output: str = ""
    block_frames: int = 0
    rate_hz: int = _CHOSEN.rate_hz
    drums: str = _CHOSEN.drums
    click: str = _CHOSEN.click
    own_sound: bool = True
    levels: tuple[LevelCommand, ...] = ()
    heard: str = EVERYTHING
    midi_out: str = ""
    air: AirKit | None = None

    @classmethod
    def from_settings(cls, settings: Settings) -> Self:
        """What a user has chosen; raises `BadInput` for kits, sticks, levels and an air kit that cannot be meant."""
        return cls(
            kits=parse_devices(settings.kit),
            sticks=parse_sticks(settings.sticks),
            output=settings.output,
            block_frames=settings.block_frames,
            rate_hz=settings.rate_hz,
            drums=settings.drums,
            click=settings.click,
            own_sound=settings.own_sound,
            levels=parse_levels(settings.levels, setting_source("levels")),
            heard=settings.heard,
            midi_out=settings.midi_out,
            air=read_air(air_path()) if settings.air_drums else None,
        )

    @property
    def first_commands(self) -> tuple[Command, ...]:
        """What the engine is sent before anything else."""
        silent = () if self.own_sound else (SetLevel(Bus.STUDENT, 0.0),)
        port = (SetMidiOut(self.midi_out),) if self.midi_out and self.heard == EVERYTHING else ()
        air = (SetAirDrums(self.air, AIR_AHEAD_NS),) if self.air is not None else ()
        unheard = (command_of(channel, ChannelLevel(0.0)) for channel in SILENCED[self.heard])
        return (*self.levels, *silent, *unheard, *port, *air)
