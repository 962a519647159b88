"""Files that only save time: what was made once is kept in the system's folder for caches, and may vanish from it.

Whoever keeps something puts into its name a digest of all that it depends on, makes it anew where it is missing or
damaged, and writes it whole or not at all. Every such folder holds a few files; the oldest go.
"""

from contextlib import suppress
from pathlib import Path

from platformdirs import user_cache_path

from station.core.settings import APP_NAME


def cache_folder(kind: str) -> Path:
    """Where files of a kind lie on this system; may be deleted at any time."""
    return user_cache_path(APP_NAME, appauthor=False) / kind


def forget_oldest(folder: Path, ending: str, most: int) -> None:
    """Delete all files with that ending but the `most` that were touched last."""
    ages: list[tuple[int, Path]] = []
    for path in folder.glob(f"*{ending}"):
        with suppress(OSError):  # another process has just deleted it
            ages.append((path.stat().st_mtime_ns, path))
    for _, old in sorted(ages, reverse=True)[most:]:
        with suppress(OSError):
            old.unlink()
