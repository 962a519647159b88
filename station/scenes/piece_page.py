"""A whole piece on one page of the screen, its bars counted through."""

from station.core.units import PPQ
from station.music.score import Score
from station.render.notation.page.editable_page import PageSetter
from station.render.notation.page.sheet import SheetWords
from station.render.notation.page.sheet_bars import BarRun
from station.render.text.paper import OutlineAtlas


def piece_setter(score: Score, beat_ticks: int) -> PageSetter:
    """What sets pages of a score whose beat is so long."""
    beats = round(score.tempo_map.tempos[0].short_bpm(beat_ticks / PPQ), 1)
    words = SheetWords("", beats_a_minute=beats, beat_ticks=beat_ticks)
    return PageSetter(score, [BarRun(0, score.bar_count - 1)], words, OutlineAtlas())
