"""What a lesson's text says, value by value, as `tomllib` reads it."""

import tomllib
from collections.abc import Iterator

from station.core.toml.toml_places import KeyPath


def toml_leaves(text: str) -> dict[KeyPath, object]:
    """Each value that is no table by its path; a grid or a cycle that stands alone has the index 0."""
    return dict(_leaves(tomllib.loads(text), ()))


def _leaves(raw: object, path: KeyPath) -> Iterator[tuple[KeyPath, object]]:
    if isinstance(raw, dict):
        for key, value in raw.items():
            is_alone = key in ("grid", "cycle") and isinstance(value, dict)
            yield from _leaves(value, (*path, key, 0) if is_alone else (*path, key))
    elif isinstance(raw, list) and raw and isinstance(raw[0], dict):
        for index, value in enumerate(raw):
            yield from _leaves(value, (*path, index))
    else:
        yield path, raw
