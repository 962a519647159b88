"""The user's settings: one TOML file, read whole and written whole.

An unknown key or a value of another type is the file's fault and named with its line; a file that does not exist is
the defaults. Writing goes through a temporary file beside it, so that a full disk never leaves half a file.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from types import MappingProxyType

from platformdirs import user_config_path, user_data_path, user_documents_path

from station.core.disk.files import NoSuchFile, write_whole
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.toml.schema import (
    Field,
    Fields,
    Reader,
    checked_values,
    flag,
    list_of,
    members_by_label,
    needed,
    number,
    one_of,
    record,
    shown,
    text,
    whole,
)
from station.core.toml.toml_faults import Fault, Wrong, placed, refused, wrong
from station.core.toml.toml_source import read_source
from station.core.toml.toml_write import toml_value

APP_NAME = "drum-station"


SMALLEST_PANELS, LARGEST_PANELS = 0.75, 2.5
"""How small and how large the window's panels may be (our choice: read at arm's length, and from across the room)."""
LEAST_BLOCK_FRAMES = 16
"""Less is beyond any driver here (our choice); 0 leaves the size to it."""


EVERYTHING, CLICK_ALONE, NOTHING = HEARD = ("everything", "click", "nothing")
"""How much is heard: for a night beside others the click alone, or nothing, and the picture clicks."""


@dataclass(frozen=True, slots=True)
class StudentSettings:
    """What is a student's own while another one plays: who leads, and the course that is listed."""

    name: str
    hands: str = ""
    course: str = ""


@dataclass(frozen=True, slots=True)
class Settings:
    """What a user has chosen.

    `kit` part of the MIDI port's name, empty for the first kit found; `sticks` where the motion sensors are
    (`devices.stick_ports`), empty for none; `output` part of the sound device's name, empty
    for the system's default; `block_frames` the size of one audio block, 0 for the driver's own choice; `rate_hz` its
    sample rate; `drums` the name or the path of the drum kit that sounds, `click` the name of the click,
    `click_pattern` what clicks (`practice.session.cues.click_options`), `levels` of what sounds
    (`engine.levels_option`), `heard` how much of it is heard at all: everything, the click alone, or nothing;
    `track` a sound file to play along to, `with_track` whether sessions whose tempo stays do, `track_bpm` its tempo in
    the lesson's own beat, 0 for the lesson's own tempo, `track_start_s` where in it the first pass begins,
    `track_stretched` whether it is played at the tempo that is practised, not at its own,
    `guide` whether the demonstration plays along in the passes, `band_drums` whether the drums of a song's own
    recording are heard, `midi_out` part of the name of a MIDI output that gets
    it, empty for none; `history` the URL of the database that remembers sessions, empty for a file of the user's;
    `own_sound` false where the kit's module sounds itself and the strokes of the student stay
    silent; latencies in milliseconds, subtracted from every hit (input) and added to every written time (output) on
    devices that nobody has measured (`core.measured_latency`). `thresholds` says of pads the least velocity that they
    send, as measured (`snare=20 tom_1=15`), `mask_ms` how long after a stroke a pad hears no other. `ask_first` whether
    the student is asked for an opinion before a result is shown. `kicks_start` whether two kicks start the count-in,
    `auto_pause` whether a session waits for a student who has stopped, `pause` what pauses it: two pads at once,
    switches (`practice.control.pause_options`). `style` names how the demonstrator moves, a shipped style or a style
    file, `figure` who demonstrates, a shipped drummer or a file, empty for the style's own, `stands` which kit stands
    before them, a shipped one or a file, empty for the lesson's, and `hands` whose hand leads: `right`, `left`, `open`,
    empty for as that kit is built (`practice.session.leading_hand`). `view`, `mirrored`, `inset` and `viewpoints`
    are where the window looks from, `score` how it shows the score, `legend` whether a staff says which line is which
    piece, `theme` its colours (`app.settings.view_settings`), `panel_scale` how many times as large as their window
    asks for its panels are, `quality` how finely it draws, empty for what the machine holds, `double` whether the
    student is shown as a second
    drummer, `double_beside` whether beside the demonstrator and not over them, `air_drums` whether strokes in the air
    are hits of the air kit, `follow_phase` whether the drummer follows the student's phase and not the clock,
    `sound_phase` whether that phase sounds the drill's strokes as it passes them, `course` names the course whose
    lessons are listed, empty for all; `welcomed` whether the questions of the first start were asked
    (`app.settings.first_start`), `students` who has played here, the last one first, with what is their own
    (`app.settings.students`), `pads_switch` whether the kit may ask who plays.
    """

    student: str = "student"
    kit: str = ""
    sticks: str = ""
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
    heard: str = EVERYTHING
    guide: bool = False
    band_drums: bool = True
    track: str = ""
    with_track: bool = False
    track_bpm: float = 0.0
    track_start_s: float = 0.0
    track_stretched: bool = True
    midi_out: str = ""
    sessions: str = ""
    history: str = ""
    thresholds: str = ""
    mask_ms: float = 9.0
    ask_first: bool = True
    kicks_start: bool = True
    auto_pause: bool = True
    pause: str = "crash_1+crash_2 cc=64"
    style: str = "natural"
    figure: str = ""
    stands: str = ""
    hands: str = ""
    view: str = "shoulder"
    mirrored: bool = False
    inset: str = ""
    score: str = "paged"
    legend: bool = True
    viewpoints: str = ""
    course: str = ""
    theme: str = "night"
    panel_scale: float = 1.0
    quality: str = ""
    welcomed: bool = False
    double: bool = False
    double_beside: bool = False
    air_drums: bool = False
    follow_phase: bool = False
    sound_phase: bool = False
    pads_switch: bool = True
    students: tuple[StudentSettings, ...] = ()

    @property
    def threshold_of(self) -> dict[Piece, int]:
        """The least velocity that each pad in `thresholds` sends."""
        try:
            return _thresholds(self.thresholds)
        except Wrong as fault:
            raise BadInput(settings_path(), "thresholds", str(fault)) from None

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
    def own_lessons_dir(self) -> Path:
        """Where the user's own lessons are kept, imports too."""
        return self.sessions_dir / "lessons"

    @property
    def styles_dir(self) -> Path:
        """Where the user's own styles are kept."""
        return self.sessions_dir / "styles"


def data_folder() -> Path:
    """Where this user's data live that are no documents."""
    return user_data_path(APP_NAME, appauthor=False)


def settings_path() -> Path:
    """Where this user's settings live on this system."""
    return user_config_path(APP_NAME, appauthor=False) / "settings.toml"


# --- reading ----------------------------------------------------------------------------------------------------------

_PIECES = members_by_label(Piece)
_LOUDEST = 127


def _thresholds(written: str) -> dict[Piece, int]:
    """`snare=20 tom_1=15` as a table."""
    found: dict[Piece, int] = {}
    for entry in written.split():
        name, _, velocity = entry.partition("=")
        sent = int(velocity) if velocity.isdecimal() and len(velocity) < 4 else 0
        if name not in _PIECES or not 1 <= sent <= _LOUDEST:
            raise wrong(f"expected PIECE=1…{_LOUDEST}, such as snare=20, found {shown(entry)}")
        found[_PIECES[name]] = sent
    return found


def _threshold_text(value: object) -> str:
    """A text that `_thresholds` understands."""
    _thresholds(text(value))
    return text(value)


def _block(value: object) -> int:
    """Frames of one audio block, or 0."""
    frames = whole(0, 8192)(value)
    if 0 < frames < LEAST_BLOCK_FRAMES:
        raise wrong(f"expected 0 (the driver's choice) or {LEAST_BLOCK_FRAMES} to 8192, found {frames}")
    return frames


_STUDENT: Fields = MappingProxyType(
    {"name": needed(text, 'a name such as "Ann"'), "hands": Field(text, ""), "course": Field(text, "")}
)
_SPECIAL: Mapping[str, Reader[object]] = MappingProxyType(
    {
        "panel_scale": number(SMALLEST_PANELS, LARGEST_PANELS),
        "block_frames": _block,
        "rate_hz": whole(8_000, 384_000),
        "input_latency_ms": number(-1000, 1000),
        "output_latency_ms": number(-1000, 1000),
        "mask_ms": number(0, 100),
        "heard": one_of(HEARD, "what is heard"),
        "track_bpm": number(0, 400),
        "track_start_s": number(0, 600),
        "thresholds": _threshold_text,
        "students": list_of(record(StudentSettings, _STUDENT), '[{name = "Ann", hands = "left"}]'),
    }
)
"""What a sound card or a person could mean; our choice, wide enough for every device on sale. The others are texts and
truths."""
FIELDS: Fields = MappingProxyType(
    {
        each.name: Field(_SPECIAL.get(each.name, flag if isinstance(each.default, bool) else text), each.default)
        for each in fields(Settings)
    }
)
SETTINGS: Reader[Settings] = record(Settings, FIELDS, "setting")
"""The schema of the file."""


def setting_source(key: str) -> str:
    """How a complaint of the setting `key` begins: where it is kept, and which it is."""
    return f"{settings_path()}: {key}"


def load_settings(path: Path | None = None) -> Settings:
    """Settings from `path` (this user's by default); raises `BadInput` for a file that is not ours."""
    settings, faults = read_settings(path)
    if faults:
        raise refused(faults)
    return settings


def read_settings(path: Path | None = None) -> tuple[Settings, list[Fault]]:
    """Settings from `path` (this user's by default), the default where one is wrong or not said, and all faults.

    Raises `BadInput` where there is a file that cannot be read.
    """
    try:
        source = read_source(path or settings_path())
    except NoSuchFile:
        return Settings(), []
    values, faults = checked_values(source.raw, FIELDS, "setting")
    return Settings(**values), placed(source, faults.noted)


def with_said(settings: Settings, said: Mapping[str, object], source: str) -> Settings:
    """The settings with what `said` has instead; raises `BadInput` that names `source` for a value out of range."""
    values, faults = checked_values(dict(said), FIELDS, "setting")
    for fault in faults.noted:
        raise BadInput(source, "", fault.words)
    return replace(settings, **{key: values[key] for key in said})


# --- writing ----------------------------------------------------------------------------------------------------------


def save_settings(settings: Settings, path: Path | None = None) -> Path:
    """Write all to `path` (this user's by default) and return it; raises `DeviceError` if the disk refuses."""
    target = path or settings_path()
    lines = [f"{key} = {toml_value(value)}\n" for key, value in asdict(settings).items()]
    write_whole(target, "".join(lines).encode())
    return target
