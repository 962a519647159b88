"""The user's settings: one TOML file, read whole and written whole.

An unknown key or a value of another type is the file's fault and named with its key; a file that does not exist is the
defaults. Writing goes through a temporary file beside it, so that a full disk never leaves half a file.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path

from platformdirs import user_config_path, user_documents_path

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.files import write_whole
from station.core.pieces import Piece, word
from station.core.toml_table import parse_toml
from station.core.toml_write import toml_value

APP_NAME = "drum-station"


SMALLEST_PANELS, LARGEST_PANELS = 0.75, 2.5
"""How small and how large the window's panels may be (our choice: read at arm's length, and from across the room)."""
_RANGES: dict[str, tuple[float, float]] = {
    "panel_scale": (SMALLEST_PANELS, LARGEST_PANELS),
    "block_frames": (0, 8192),
    "rate_hz": (8_000, 384_000),
    "input_latency_ms": (-1000, 1000),
    "output_latency_ms": (-1000, 1000),
    "mask_ms": (0, 100),
}
"""What a sound card or a person could mean; our choice, wide enough for every device on sale."""
LEAST_BLOCK_FRAMES = 16
"""Less is beyond any driver here (our choice); 0 leaves the size to it."""


@dataclass(frozen=True, slots=True)
class Settings:
    """What a user has chosen.

    `kit` part of the MIDI port's name, empty for the first kit found; `output` part of the sound device's name, empty
    for the system's default; `block_frames` the size of one audio block, 0 for the driver's own choice; `rate_hz` its
    sample rate; `drums` the name or the path of the drum kit that sounds, `click` the name of the click,
    `click_pattern` what clicks (`practice.click_word`), `levels` of what sounds (`engine.levels`), `guide` whether the
    demonstration plays along in the passes, `midi_out` part of the name of a MIDI output that gets it, empty for none;
    `own_sound` false where the kit's module sounds itself and the strokes of the student stay silent; latencies in
    milliseconds, subtracted from every hit (input) and added to every written time (output) on devices that nobody has
    measured (`core.calibration`). `thresholds` says of pads
    the least velocity that they send, as measured (`snare=20 tom_1=15`), `mask_ms` how long after a stroke a pad hears
    no other. `ask_first` whether the student is asked for an opinion before a result is shown.
    `kicks_start` whether two kicks start the count-in, `auto_pause` whether a session waits for a student who has
    stopped, `pause` what pauses it: two pads at once, switches (`practice.pause_word`).
    `style` names how the demonstrator moves, a shipped style or a style file, `figure` the body, a shipped one or a
    figure file, and `hands` whose hand leads: `right`, `left`, `open`, empty for as a lesson's kit is built
    (`practice.lead`).
    `view`, `mirrored`, `inset` and `viewpoints` are where the window looks from, `score` how it shows the score,
    `theme` its colours (`app.look`), `panel_scale` how many times as large as designed its panels are, `double` whether
    the student is shown as a second drummer, `double_beside` whether beside the demonstrator and not over him,
    `course` names the course whose lessons are listed, empty for all;
    `welcomed` whether the questions of the first start were asked (`app.welcome`).
    """

    student: str = "student"
    kit: str = ""
    output: str = ""
    block_frames: int = 0
    rate_hz: int = 48_000
    input_latency_ms: float = 0.0
    output_latency_ms: float = 0.0
    own_sound: bool = True
    drums: str = "acoustic"
    click: str = "bar"
    click_pattern: str = ""
    levels: str = ""
    guide: bool = False
    midi_out: str = ""
    sessions: str = ""
    thresholds: str = ""
    mask_ms: float = 9.0
    ask_first: bool = True
    kicks_start: bool = True
    auto_pause: bool = True
    pause: str = "crash_1+crash_2 cc=64"
    style: str = "natural"
    figure: str = "median"
    hands: str = ""
    view: str = "shoulder"
    mirrored: bool = False
    inset: str = ""
    score: str = "scrolling"
    viewpoints: str = ""
    course: str = ""
    theme: str = "night"
    panel_scale: float = 1.0
    welcomed: bool = False
    double: bool = False
    double_beside: bool = False

    @property
    def threshold_of(self) -> dict[Piece, int]:
        """The least velocity that each pad in `thresholds` sends."""
        return _thresholds(self.thresholds, settings_path())

    @property
    def sessions_dir(self) -> Path:
        """Where sessions are kept: `sessions`, or a folder of ours in the user's documents.

        Raises `BadInput` for what no folder can be called.
        """
        if not self.sessions:
            return user_documents_path() / "Drum station"
        if "\0" in self.sessions:
            raise BadInput(settings_path(), "sessions", f"no folder can be called {self.sessions!r}")
        try:
            return Path(self.sessions).expanduser()
        except RuntimeError:
            raise BadInput(settings_path(), "sessions", f"{self.sessions!r}: there is no such user's home") from None

    @property
    def courses_dir(self) -> Path:
        """Where the user's own courses are."""
        return self.sessions_dir / "courses"

    @property
    def styles_dir(self) -> Path:
        """Where the user's own styles are kept."""
        return self.sessions_dir / "styles"


def settings_path() -> Path:
    """Where this user's settings live on this system."""
    return user_config_path(APP_NAME, appauthor=False) / "settings.toml"


def setting_source(key: str) -> str:
    """How a complaint of the setting `key` begins: where it is kept, and which it is."""
    return f"{settings_path()}: {key}"


def load_settings(path: Path | None = None) -> Settings:
    """Settings from `path` (this user's by default); raises `BadInput` for a file that is not ours."""
    source = path or settings_path()
    try:
        data = source.read_bytes()
    except FileNotFoundError:
        return Settings()
    except OSError as fault:
        raise BadInput(source, "", fault.strerror or str(fault)) from fault
    return _checked(parse_toml(data, source), source)


_WORDS: dict[type, str] = {str: "a text in quotes", int: "a whole number", float: "a number", bool: "true or false"}


def _checked(raw: dict[str, object], source: Path) -> Settings:
    types = {f.name: type(getattr(Settings(), f.name)) for f in fields(Settings)}
    values: dict[str, object] = {}
    for key, value in raw.items():
        if key not in types:
            raise BadInput(source, key, f"no such setting{did_you_mean(key, types)}")
        if types[key] is float and type(value) is int:
            value = float(value)  # noqa: PLW2901 - TOML writes 5.0 and 5 alike for a person
        if type(value) is not types[key]:
            raise BadInput(source, key, f"expected {_WORDS[types[key]]}, found {value!r}")
        _check_range(key, value, source)
        values[key] = value
    _thresholds(str(values.get("thresholds", "")), source)
    return Settings(**values)  # type: ignore[arg-type] # each value's type was compared with its field's default


def with_said(settings: Settings, said: Mapping[str, object], source: str) -> Settings:
    """The settings with what `said` has instead; raises `BadInput` that names `source` for a value out of range."""
    for key, value in said.items():
        _check_range(key, value, source)
    return replace(settings, **said)  # type: ignore[arg-type] # whoever says it has parsed it


def _thresholds(text: str, source: str | Path) -> dict[Piece, int]:
    """`snare=20 tom_1=15` as a table; raises `BadInput` that says what is expected."""
    found: dict[Piece, int] = {}
    for entry in text.split():
        name, _, velocity = entry.partition("=")
        if name not in _PIECES or not velocity.isdecimal() or not 1 <= int(velocity) <= _LOUDEST:
            raise BadInput(source, "thresholds", f"expected PIECE=1…{_LOUDEST}, such as snare=20, found {entry!r}")
        found[_PIECES[name]] = int(velocity)
    return found


_PIECES = {word(piece): piece for piece in Piece}
_LOUDEST = 127


def _check_range(key: str, value: object, source: str | Path) -> None:
    if key in _RANGES and isinstance(value, int | float):
        least, most = _RANGES[key]
        if key == "block_frames" and 0 < value < LEAST_BLOCK_FRAMES:
            limits = f"expected 0 (the driver's choice) or {LEAST_BLOCK_FRAMES} to {most}"
            raise BadInput(source, key, f"{limits}, found {value!r}")
        if not least <= value <= most:
            raise BadInput(source, key, f"expected {least} to {most}, found {value!r}")


def save_settings(settings: Settings, path: Path | None = None) -> Path:
    """Write all to `path` (this user's by default) and return it; raises `DeviceError` if the disk refuses."""
    target = path or settings_path()
    lines = [f"{key} = {toml_value(value)}\n" for key, value in asdict(settings).items()]
    write_whole(target, "".join(lines).encode())
    return target
