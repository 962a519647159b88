"""The one door to every drum kit: a synthesised one by its name, a user's by its name in the kits' folder or its path.

A path may be a folder of sound files, a folder with a `kit.toml` or a `drumkit.xml`, one of these two files, or a
`.h2drumkit`. A name is sought among the synthesised kits first, then in the user's folder of kits.
"""

from pathlib import Path

from platformdirs import user_data_path

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.settings import APP_NAME
from station.sound.drum_kit import DrumKit
from station.sound.samples.hydrogen_kit import ARCHIVE_ENDING, KIT_FILE, hydrogen_archive, hydrogen_folder
from station.sound.samples.kit_folder import TABLE_NAME, folder_kit
from station.sound.synth.synth_cache import cached_kit
from station.sound.synth.synth_kits import KIT_NAME, MODELS

DEFAULT_KIT = KIT_NAME
MIN_RATE_HZ, MAX_RATE_HZ = 8_000, 384_000


def kits_folder() -> Path:
    """Where a user's own kits lie on this system."""
    return user_data_path(APP_NAME, appauthor=False) / "kits"


def kit_names(folder: Path | None = None) -> list[str]:
    """Every kit that has a name: the synthesised ones, then those in `folder` (the user's by default)."""
    home = folder or kits_folder()
    own = sorted(p.stem if p.is_file() else p.name for p in home.iterdir() if _is_kit(p)) if home.is_dir() else []
    return [*MODELS, *(name for name in own if name not in MODELS)]


def load_kit(name_or_path: str = DEFAULT_KIT, rate_hz: int = 48_000, folder: Path | None = None) -> DrumKit:
    """The kit at `rate_hz`; raises `BadInput` that names the file and the fault, or the nearest names there are."""
    assert MIN_RATE_HZ <= rate_hz <= MAX_RATE_HZ, "a sound card's rate"
    path = find_kit(name_or_path, folder)
    return cached_kit(name_or_path, rate_hz) if path is None else read_kit(path, rate_hz)


def find_kit(name_or_path: str, folder: Path | None = None) -> Path | None:
    """Where the kit lies, None for a synthesised one; raises `BadInput` as `load_kit`, but no sound is read."""
    if name_or_path in MODELS:
        return None
    home = folder or kits_folder()
    for path in (home / name_or_path, home / f"{name_or_path}{ARCHIVE_ENDING}", Path(name_or_path)):
        if name_or_path and _exists(path):
            return _home_of(path)
    raise BadInput(name_or_path, "", f"no such drum kit{did_you_mean(name_or_path, kit_names(folder))}")


def read_kit(path: Path, rate_hz: int) -> DrumKit:
    """The kit at `path`; raises `BadInput`."""
    home = _home_of(path)
    if home.is_dir():
        return hydrogen_folder(home, rate_hz) if (home / KIT_FILE).exists() else folder_kit(home, rate_hz)
    return hydrogen_archive(home, rate_hz)


def _home_of(path: Path) -> Path:
    """The kit's folder or archive; raises `BadInput` for a file that is neither, nor the table of a kit."""
    home = path.parent if path.name in (TABLE_NAME, KIT_FILE) else path
    if not _is_kit(home):
        raise BadInput(home, "", f"is no drum kit: expected a folder of sound files or a {ARCHIVE_ENDING}")
    return home


def _exists(path: Path) -> bool:
    try:
        return path.exists()
    except OSError:  # no name that a file can have
        return False


def _is_kit(path: Path) -> bool:
    return path.is_dir() or path.suffix.lower() == ARCHIVE_ENDING
