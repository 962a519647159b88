"""Every kind of TOML file that the station reads, how a file tells which it is, and the faults of files of any kind."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from station.core import measured_latency, settings
from station.core.errors import BadInput
from station.core.toml.schema import Reader, reading
from station.core.toml.toml_faults import Fault, Noted, placed
from station.core.toml.toml_source import Source
from station.devices.mapping import device_file, stick_file
from station.drills import course
from station.drills.lesson import Lesson
from station.drills.library import course_prerequisites, lesson_prerequisites, lessons_for
from station.drills.prerequisites import order_faults
from station.drills.reading import lesson_fields, lesson_file
from station.drills.songs import song_file
from station.motion.kinematics import figure
from station.motion.kit import kit
from station.motion.style import style_file
from station.sound.samples import kit_folder
from station.sync.air import air_file
from station.sync.phase import model_file

_NAMES = ("*.toml", f"*{song_file.SONG_ENDING}")


@dataclass(frozen=True, slots=True)
class TomlKind:
    """One kind of file: what it is called, the keys of its top table, its schema, and how its files are often named."""

    name: str
    keys: Iterable[str]
    reader: Callable[[Path], Reader[object]]
    names: tuple[str, ...] = ()


def _course(path: Path) -> Reader[object]:
    return course.course_reader(path.name.removesuffix(course.ENDING), lessons_for(path.parent))


LESSON = TomlKind("lesson", lesson_fields.FIELDS, lambda path: lesson_file.lesson_reader(path.stem))
COURSE = TomlKind("course", course.FIELDS, _course)
KINDS = (
    LESSON,
    COURSE,
    TomlKind("song", song_file.FIELDS, song_file.song_reader, (f"*{song_file.SONG_ENDING}",)),
    TomlKind("device kit", device_file.KEYS, lambda path: device_file.kit_reader(path.stem), ("kits/*.toml",)),
    TomlKind("drummer's kit", kit.KEYS, lambda path: kit.kit_reader(path.stem)),
    TomlKind("figure", figure.FIELDS, lambda _: figure.FIGURE),
    TomlKind("style", style_file.FIELDS, lambda path: style_file.style_reader(path.stem), ("styles/*.toml",)),
    TomlKind("slots of styles", style_file.SLOT_FIELDS, lambda _: style_file.SLOTS_FILE, ("slots.toml",)),
    TomlKind("sounds", kit_folder.FIELDS, lambda _: kit_folder.KIT_TABLE, (kit_folder.TABLE_NAME,)),
    TomlKind("settings", settings.FIELDS, lambda _: settings.SETTINGS, ("settings.toml",)),
    TomlKind(
        "calibration", measured_latency.FIELDS, lambda _: measured_latency.CALIBRATION, (measured_latency.FILE_NAME,)
    ),
    TomlKind("stick", stick_file.FIELDS, lambda _: stick_file.STICK, ("sticks/*.toml",)),
    TomlKind("periodic model", model_file.FIELDS, lambda _: model_file.MODEL),
    TomlKind("air kit", air_file.FIELDS, lambda _: air_file.AIR_KIT, (air_file.FILE_NAME,)),
)


def kind_of(path: Path, source: Source) -> TomlKind:
    """The kind that knows most of the file's keys; where several do, the one whose files are named so, or a lesson."""
    if course.is_course(path):
        return COURSE
    return max(KINDS, key=lambda kind: (len(set(kind.keys) & set(source.raw)), any(map(path.match, kind.names))))


def check_files(paths: Sequence[str]) -> tuple[list[Fault], int]:
    """Every fault of the files at `paths` (TOML files of any kind, or folders of them), and how many were read.

    What lessons and courses name as coming before them is looked for among these files and those that ship.
    """
    faults: list[Fault] = []
    read: list[TomlFile] = []
    for given in paths:
        path = Path(given)
        files = sorted(file for name in _NAMES for file in path.rglob(name)) if path.is_dir() else [path]
        if not files:
            faults.append(Fault(given, 0, 0, "no lesson in this folder; expected .toml files"))
        read += map(read_file, files)
    in_order = {
        **_out_of_order(read, LESSON, lesson_prerequisites),
        **_out_of_order(read, COURSE, course_prerequisites),
    }
    for index, file in enumerate(read):
        faults += [*file.faults, *in_order.get(index, [])]
    return faults, len(read)


@dataclass(frozen=True, slots=True)
class TomlFile:
    """A file that was read: its kind and text, None where there is none, what it means, None with faults, and these."""

    path: Path
    kind: TomlKind | None
    source: Source | None
    meant: object
    faults: list[Fault]


def read_file(path: Path) -> TomlFile:
    """The file at `path`, and every fault of it."""
    try:
        source = lesson_file.lesson_source(path)
    except BadInput as fault:
        return TomlFile(path, None, None, None, [Fault(str(path), 0, 0, fault.fault)])
    kind = kind_of(path, source)
    return TomlFile(path, kind, source, *reading(source, kind.reader(path)))


def _out_of_order(
    files: Sequence[TomlFile], kind: TomlKind, shipped: Callable[[], dict[str, tuple[str, ...]]]
) -> dict[int, list[Fault]]:
    """What is wrong with the prerequisites of those of `files` that are of one `kind`, by their indices."""
    ours = {_name(file.path): index for index, file in enumerate(files) if file.kind is kind}
    said = {name: _prerequisites(files[index].meant) for name, index in ours.items()}
    if not any(said.values()):
        return {}
    noted: dict[int, list[Noted]] = {}
    named = {**shipped(), **said}
    for fault in order_faults(named, named.keys(), kind.name):
        if fault.name in ours:
            noted.setdefault(ours[fault.name], []).append(Noted(fault.text, ("prerequisites", fault.index)))
    return {index: _placed(files[index], found) for index, found in noted.items()}


def _name(path: Path) -> str:
    """The name of a lesson or course in a file."""
    return path.name.removesuffix(course.ENDING).removesuffix(".toml")


def _prerequisites(meant: object) -> tuple[str, ...]:
    return meant.prerequisites if isinstance(meant, Lesson | course.Course) else ()


def _placed(file: TomlFile, noted: Sequence[Noted]) -> list[Fault]:
    assert file.source is not None, "it was read"
    return placed(file.source, noted)
