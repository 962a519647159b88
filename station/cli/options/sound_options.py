"""The options that say what sounds and how: the same words as in the settings, for this once or to be remembered."""

from dataclasses import dataclass, fields
from pathlib import Path

from station.cli.options.option_fields import choice, number, option, switch, unread, whole_number
from station.core.errors import BadInput
from station.engine.levels_option import LEVELS_HELP, parse_levels
from station.practice.session.backing_track import BackingRequest
from station.practice.session.cues.click_options import CLICK_HELP, parse_click
from station.sound.click_sounds import TIMBRES


@dataclass(frozen=True, slots=True, kw_only=True)
class SoundOptions:
    """What is said of settings, by the settings' names; None where nothing is."""

    output: str | None = option("NAME", "part of the sound output's name (the system's default)", str, None)
    block_frames: int | None = option("N", "frames an audio block (the driver's choice)", whole_number, None)
    rate_hz: int | None = option("--rate HZ", "the sound card's sample rate (48000)", whole_number, None)
    drums: str | None = option(
        "--sounds KIT", "the drum kit that sounds: acoustic, brushes, electronic, yours", str, None
    )
    own_sound: bool | None = switch("sound the strokes here (--no-…: the module does)")
    click_pattern: str | None = option("--click CLICK", CLICK_HELP, str, None)
    click: str | None = choice({name: name for name in TIMBRES}, "how a click sounds", None, name="--click-sound")
    levels: str | None = option("LEVELS", LEVELS_HELP, str, None)
    guide: bool | None = switch("the demonstration plays along in the passes too")
    band_drums: bool | None = switch("hear the drums of a song's own recording (--no-…: their stems are left out)")
    midi_out: str | None = option(
        "PORT", "send the demonstration to the MIDI output whose name contains this", str, None
    )

    def settings(self) -> dict[str, object]:
        """What was said, by the settings' names; raises `BadInput` for words that cannot be."""
        if self.click_pattern is not None:
            parse_click(self.click_pattern, "--click")
        if self.levels is not None:
            parse_levels(self.levels, "--levels")
        everything = {one.name: getattr(self, one.name) for one in fields(self)}
        return {name: value for name, value in everything.items() if value is not None}


def _loop_s(text: str) -> tuple[float, float]:
    first, _, last = text.partition("-")
    try:
        return float(first), float(last)
    except ValueError:
        raise unread("two times in seconds such as 12.5-30", text) from None


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackOptions:
    """What to play along to."""

    track: Path | None = option("FILE", "play along to a sound file (WAV, FLAC, OGG, MP3) in the passes", Path, None)
    track_start: float | None = option("S", "where in the file the first pass begins, in seconds (0)", number, None)
    track_loop: tuple[float, float] | None = option("A-B", "the part of the file to repeat, in seconds", _loop_s, None)
    track_speed: float | None = option("PERCENT", "50-150 (as the tempo to the lesson's own)", number, None)

    def backing(self, adapts: bool) -> BackingRequest | None:
        """What to play along to; raises `BadInput` for a part of no track, and for a track where the tempo `adapts`."""
        parts = {"start": self.track_start, "loop": self.track_loop, "speed": self.track_speed}
        if self.track is None:
            lonely = [f"--track-{name}" for name, value in parts.items() if value is not None]
            if lonely:
                raise BadInput(lonely[0], "", "of what? name a file with --track")
            return None
        if adapts:
            raise BadInput("--track", "--adapt", "a track has one tempo; without --adapt the tempo stays")
        speed = None if self.track_speed is None else self.track_speed / 100.0
        return BackingRequest(self.track, self.track_start or 0.0, self.track_loop, speed)
