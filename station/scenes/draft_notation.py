"""A lesson that is being written as notation: its grids as they stand in the text, ready to be pointed at."""

from dataclasses import dataclass, replace

from station.core.units import PPQ
from station.drills.editing.written_music import WrittenMusic, written_music
from station.render.notation.page.editable_page import EditablePage, PageSetter
from station.render.notation.page.sheet import SheetWords
from station.render.notation.page.sheet_bars import BarRun
from station.render.notation.page.sheet_line import KeptBars
from station.render.text.paper import OutlineAtlas

_LONG = 24
"""Bars that are set in less than a tenth of a second (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class Notation:
    """The music of a text and its page.

    `is_present` is false where the text is none and this was there before; `is_late`: the text has changed just now.
    """

    music: WrittenMusic
    page: EditablePage
    is_present: bool = True
    is_late: bool = False

    @property
    def can_be_edited(self) -> bool:
        """Whether it is what the text says."""
        return self.is_present and not self.is_late


class DraftNotation:
    """Keeps what was set last: a page is set anew for another text or another width alone."""

    def __init__(self) -> None:
        self._atlas, self._kept = OutlineAtlas(), KeptBars()
        self._text: str | None = None
        self._set: tuple[WrittenMusic, PageSetter] | None = None
        self._width = 0.0
        self._shown: Notation | None = None

    def of(self, text: str, width: float, is_settled: bool = True) -> Notation | None:
        """The notation of `text` in lines `width` staff spaces wide; the last that there was where it has none.

        Long music waits until the text `is_settled`: who types shall not have to.
        """
        shown = self._shown
        if text != self._text and shown is not None and not is_settled and len(shown.music.bars) > _LONG:
            self._shown = shown if shown.is_late else replace(shown, is_late=True)
            return self._shown
        if text != self._text:
            self._text = text
            music = written_music(text)
            if music is not None:
                self._set = music, page_setter(music, self._atlas, self._kept)
            self._shown = None if self._set is None else self._page(width, is_present=music is not None)
        elif shown is not None and (width != self._width or shown.is_late):
            self._shown = self._page(width, shown.is_present)
        return self._shown

    def _page(self, width: float, is_present: bool) -> Notation:
        assert self._set is not None, "there was music once"
        music, setter = self._set
        self._width = width
        return Notation(music, setter.page(width), is_present)


def page_setter(music: WrittenMusic, atlas: OutlineAtlas, kept: KeptBars | None = None) -> PageSetter:
    """What sets pages of `music`, each grid once, with its name, how often it is played, and which passes it ends."""
    runs = [BarRun(g.first_bar, g.last_bar, g.times, g.passes, g.has_endings) for g in music.grids]
    beats = round(music.score.tempo_map.tempos[0].short_bpm(music.beat_ticks / PPQ), 1)
    names = tuple((g.first_bar, g.name) for g in music.grids if g.name)
    words = SheetWords("", beats_a_minute=beats, beat_ticks=music.beat_ticks, sections=names)
    return PageSetter(music.score, runs, words, atlas, kept)
