"""Where a parcel is written: the place that was typed, which no other file may have."""

from collections.abc import Container
from pathlib import Path

from station.core.errors import BadInput
from station.practice.exchange.parcel import Kind


def parcel_path(typed: str, kind: Kind, ours: Container[Path]) -> Path:
    """The file that is meant, with the ending of its `kind`; raises `BadInput` where one is that is not `ours`."""
    if not typed.strip():
        raise BadInput("file", "", "say where it is to be written")
    path = Path(typed.strip().strip("\"'")).expanduser()
    if not path.name.lower().endswith(kind.ending):
        path = path.with_name(path.name + kind.ending)
    if path not in ours and path.exists():
        raise BadInput(path, "", "is there already: choose another name")
    return path


def proposed_path(name: str, kind: Kind) -> str:
    """Where a file of that name would go, in the user's home ("~"), with a number where it is taken."""
    names = (f"{name}{kind.ending}", *(f"{name}-{number}{kind.ending}" for number in range(2, 100)))
    home = Path("~")
    return str(home / next((each for each in names if not (home / each).expanduser().exists()), names[0]))
