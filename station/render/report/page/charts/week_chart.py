"""A bar a day: how many minutes were played from Monday to Sunday."""

from collections.abc import Sequence

from station.render.palette import BRAND, INK, INK_SOFT
from station.render.report.page.charts.chart import HAIR, LETTER, WIDTH, Chart, Spot
from station.render.report.page.week_page import WeekDay
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

_LEFT, _RIGHT = 6.0, WIDTH - 6.0
_TOP, _LOW, _HEIGHT = 22.0, 126.0, 150.0
_SHARE = 0.62
_LEAST_BAR = 2.0


def week_chart(days: Sequence[WeekDay], atlas: Atlas) -> Chart:
    """The chart of seven `days`."""
    draw_list = DrawList(atlas)
    wide = (_RIGHT - _LEFT) / len(days)
    most = max([1, *(day.minutes for day in days)])
    draw_list.box((_LEFT, _LOW), (_RIGHT - _LEFT, HAIR), INK_SOFT)
    spots = []
    for index, day in enumerate(days):
        left, middle = _LEFT + index * wide, _LEFT + (index + 0.5) * wide
        high = max((_LOW - _TOP) * day.minutes / most, _LEAST_BAR) if day.was_played else 0.0
        if high:
            draw_list.box((middle - wide * _SHARE / 2, _LOW - high), (wide * _SHARE, high), BRAND)
            minutes = str(day.minutes) if day.minutes else "< 1"
            draw_list.text(minutes, (middle, _LOW - high - 5), TypeStyle(LETTER + 2, INK, Face.BOLD, align=0.5))
        ink = INK_SOFT if day.is_ahead else INK
        draw_list.text(day.name[:3], (middle, _LOW + LETTER + 4), TypeStyle(LETTER, ink, align=0.5))
        spots.append(Spot(_words(day), left, 0.0, wide, _HEIGHT))
    words = ", ".join(spot.words for spot in spots)
    return Chart("Minutes a day", f"{words}.", draw_list.shapes(), (WIDTH, _HEIGHT), tuple(spots))


def _words(day: WeekDay) -> str:
    if day.is_ahead:
        return f"{day.name}: still to come"
    if not day.was_played:
        return f"{day.name}: off"
    return f"{day.name}: {day.minutes or 'less than 1'} minute{'' if day.minutes in (0, 1) else 's'}"
