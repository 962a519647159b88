"""Files that ship with the station and are found by their names."""

from difflib import get_close_matches
from pathlib import Path

from station.core.errors import BadInput


def shipped(folder: Path) -> list[str]:
    """The names of the TOML files in `folder`."""
    return sorted(p.stem for p in folder.glob("*.toml"))


def find_shipped(name_or_path: str | Path, folder: Path, what: str) -> Path:
    """The file that is meant: a path that ends in .toml, or the name of one in `folder`.

    Raises `BadInput` that names the nearest there are.
    """
    path = Path(name_or_path)
    if path.suffix == ".toml":
        return path
    names = shipped(folder)
    if str(name_or_path) not in names:
        near = get_close_matches(str(name_or_path), names, n=2) or names
        raise BadInput(str(name_or_path), "", f"no such {what}; {_there(near)}")
    return folder / f"{name_or_path}.toml"


def _there(names: list[str]) -> str:
    """What there is, in words."""
    if len(names) == 1:
        return f"there is {names[0]}"
    return f"there are {', '.join(names[:-1])} and {names[-1]}"
