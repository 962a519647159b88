"""The sound in a song's folder of Clone Hero or YARG: which files belong to the song, and which are its drums.

The names are those of the games' "song folder" page: `song` is the mix or all that has no stem of its own, `guitar`,
`bass`, `rhythm`, `vocals`, `vocals_1` …, `keys` and `crowd` are stems, and `drums` or `drums_1` … `drums_4` the drums.
A `preview` is a piece of the song once more, and is left out.
"""

from pathlib import Path

SOUND_ENDINGS = (".opus", ".ogg", ".mp3", ".wav")
"""In the order in which a file is preferred where a stem is there twice."""
_OTHERS = ("song", "guitar", "bass", "rhythm", "keys", "vocals", "vocals_1", "vocals_2", "crowd")
_DRUMS = ("drums", "drums_1", "drums_2", "drums_3", "drums_4")
CHART_NAMES = frozenset({"notes.chart", "notes.mid"})


def sounds_beside(part: Path) -> tuple[tuple[Path, ...], tuple[Path, ...]]:
    """The files beside the chart at `part` that sound: all others, and the drums; both empty where it is no chart."""
    if part.name.lower() not in CHART_NAMES:
        return (), ()
    return _found(part.parent, _OTHERS), _found(part.parent, _DRUMS)


def _found(folder: Path, stems: tuple[str, ...]) -> tuple[Path, ...]:
    there = {path.name.lower(): path for path in sorted(folder.iterdir()) if path.is_file()}
    best = (next((there[stem + end] for end in SOUND_ENDINGS if stem + end in there), None) for stem in stems)
    return tuple(path for path in best if path is not None)
