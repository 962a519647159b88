"""What the editor of the demonstrator's style may be asked. Slots count from 0."""

from dataclasses import dataclass

from station.app.style.style_options import StyleOptions


@dataclass(frozen=True, slots=True)
class EditStyle:
    """The style's controls as they are now; while one is `held` nothing is written."""

    options: StyleOptions
    held: bool = False


@dataclass(frozen=True, slots=True)
class LoadStyle:
    """Take a style from its source: a shipped name, or a file."""

    source: str


@dataclass(frozen=True, slots=True)
class ProposeStyle:
    """Take the style that the lesson's tempo, density and dynamics ask for."""


@dataclass(frozen=True, slots=True)
class SaveStyle:
    """Save what is set as a style of the user's own."""

    name: str


@dataclass(frozen=True, slots=True)
class KeepSlot:
    """Keep what is set in a slot, under `name`, or as it is called where that is empty."""

    slot: int
    name: str = ""


@dataclass(frozen=True, slots=True)
class ListStyles:
    """See anew which styles there are."""


StyleAction = EditStyle | LoadStyle | ProposeStyle | SaveStyle | KeepSlot | ListStyles
