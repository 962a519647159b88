"""Files that others made, in `tests/data`; its README names their sources and licences."""

from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

DATA = Path(__file__).parent / "data"


def files_in(folder: Path, *patterns: str) -> list[ParameterSet]:
    """A test parameter for every file under `folder` that fits a pattern."""
    paths = sorted(path for pattern in patterns for path in folder.glob(pattern))
    return [pytest.param(path, id=path.relative_to(folder).as_posix()) for path in paths]


def real_files(*patterns: str) -> list[ParameterSet]:
    """A test parameter for every file under `DATA` that fits a pattern; there is at least one."""
    found = files_in(DATA, *patterns)
    assert found, f"nothing under {DATA} fits {patterns}"
    return found
