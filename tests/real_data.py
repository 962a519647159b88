"""Files that others made, beside the project's root; a test that needs them skips, and says so, where they are not."""

from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


def real_files(*patterns: str) -> list[ParameterSet]:
    """A test parameter for every file under `DATA` that fits a pattern; one that skips if there is none."""
    paths = sorted(path for pattern in patterns for path in DATA.glob(pattern))
    if not paths:
        return [pytest.param(DATA, id="none", marks=pytest.mark.skip(reason=f"no real data at {DATA}"))]
    return [pytest.param(path, id=str(path.relative_to(DATA))) for path in paths]


def real_file(name: str) -> Path:
    """The file `name` under `DATA`; skips the test if it is not there."""
    path = DATA / name
    if not path.exists():
        pytest.skip(f"no real data at {path}")
    return path
