"""Long names of files and devices, shortened in the middle: what is said in passing has a line, a path has many."""

import re

LONGEST = 34
"""Letters of a path that is shown whole (our choice: half a line of a toast)."""
_PATH = re.compile(r"[^\s(]*/[^\s/]*/[^\s,;)]*")
"""With two strokes at least: `4/4` and `kick/snare` are no paths."""


def short_path(path: str, longest: int = LONGEST) -> str:
    """The path's first part, dots, and as many of its last parts as `longest` letters hold; the last one always."""
    if len(path) <= longest:
        return path
    first, *rest = path.split("/")
    if (not first or first.endswith(":")) and len(rest) > 1:
        first, rest = f"{first}/{rest[0]}", rest[1:]
    last = rest[-1] if rest else ""
    for part in reversed(rest[:-1]):
        if len(f"{first}/…/{part}/{last}") > longest:
            break
        last = f"{part}/{last}"
    return f"{first}/…/{last}"


def short_paths(text: str) -> str:
    """`text`, each long path in it shortened."""
    return _PATH.sub(lambda found: short_path(found[0]), text)
