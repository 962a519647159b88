"""What every format keeps and loses: writes docs/formats.md.

python -m tools.format_pages
"""

from pathlib import Path

from station.core.disk.files import write_whole
from station.music.formats.format_table import FORMATS
from station.music.formats.music_format import Feature, MusicFormat

PAGE = Path(__file__).parent.parent / "docs" / "formats.md"

_HEAD = """# Formats: what comes in, what goes out, what is lost

Made by `python -m tools.format_pages` of the tables beside the readers and writers (`station/music/formats`); do not
edit.

```
station lesson import song.mid --out song.toml                   # by ending and content
station lesson import "https://…/groove/?TimeSig=4/4&…" --out groove.toml
station lesson export funk-1 --out funk-1.musicxml               # the ending says the format
station sheet song.gp5 --out song.pdf                            # any of them is a SCORE: sheet, animate, limbs, assess
```

Whatever a file says that a lesson has no place for is told on import, a line each (`lost …`), and so is on export what
the format has no place for. What a table below names comes back from our own file just as it was, unless the export
said otherwise; no file has a text of ours hidden in it. What a format has no word for may come back all the same:
MIDI has none for a flam, but its two strokes are in the file, and the import finds flams by their spacing. What is only
read has no table: [lessons.md](lessons.md#importing) says what each line of an import asks of you.

To hand on all of a lesson, write MusicXML; to play it in a sequencer, MIDI or Hydrogen; to send it in a message, a
GrooveScribe link (the one line of a `.groove` file) or a tab.

| format | endings | read | written |
|---|---|---|---|
"""


def page() -> str:
    """The page."""
    rows = [
        f"| {each.name} | {' '.join(f'`{e}`' for e in each.endings)} | yes | {'yes' if each.write else 'no'} |"
        for each in FORMATS
    ]
    return _HEAD + "\n".join(rows) + "\n" + "".join(_of(each) for each in FORMATS if each.write)


def _of(each: MusicFormat) -> str:
    """The table of one format that is written."""
    keeps = each.keeps or {}
    kept = [f"| {feature.value} | {keeps[feature] or 'all of it'} |" for feature in Feature if feature in keeps]
    lost = ", ".join(feature.value for feature in Feature if feature not in keeps) or "only what the limits above say"
    table = "\n".join(kept)
    first = next(one for one in FORMATS if one.keeps is each.keeps)
    if first is not each:
        return f"\n## {each.name}\n\nKeeps and loses what {first.name} does.\n"
    return f"\n## {each.name}\n\n| keeps | how far |\n|---|---|\n{table}\n\nLoses: {lost}.\n"


if __name__ == "__main__":
    write_whole(PAGE, page().encode())
