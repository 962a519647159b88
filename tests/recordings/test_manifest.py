"""Other people's files in `tests/data`: each is as it came, and may be passed on."""

import csv
import hashlib
from pathlib import Path

from tests.real_data import DATA

OURS = {"README.md", "MANIFEST.tsv"}
MOST_BYTES = 5_000_000


def listed() -> dict[str, dict[str, str]]:
    with (DATA / "MANIFEST.tsv").open(encoding="utf-8", newline="") as lines:
        return {row["file"]: row for row in csv.DictReader(lines, delimiter="\t")}


def files() -> dict[str, Path]:
    found = {path.relative_to(DATA).as_posix(): path for path in DATA.rglob("*") if path.is_file()}
    return {name: path for name, path in found.items() if name not in OURS}


def test_every_file_is_listed_as_it_is() -> None:
    is_there = {name: hashlib.sha256(path.read_bytes()).hexdigest() for name, path in files().items()}
    assert is_there == {name: row["sha256"] for name, row in listed().items()}


def test_every_file_may_be_passed_on_with_its_notice() -> None:
    assert {row["licence"] for row in listed().values()} <= {"MIT", "CC-BY-4.0"}
    notices = [path.parent for path in files().values() if path.stem in ("LICENSE", "LICENCE")]
    assert [name for name, path in files().items() if not any(path.is_relative_to(home) for home in notices)] == []


def test_the_folder_stays_small() -> None:
    assert sum(path.stat().st_size for path in files().values()) < MOST_BYTES
