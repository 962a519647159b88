"""In which order bars are played: every expectation is read off by hand, as a musician would."""

import pytest

from station.core.errors import BadInput
from station.music.formats.guitar_pro.play_order import play_order
from station.music.formats.guitar_pro.tab_song import Jump, Sign, TabBar
from station.music.tempo import MeterChange

_METER = MeterChange(0, 4, 4)


def _bar(
    opens: bool = False, plays: int = 0, endings: tuple[int, ...] = (), signs: str = "", jump: Jump | None = None
) -> TabBar:
    return TabBar(
        _METER,
        opens_repeat=opens,
        plays=plays,
        endings=frozenset(endings),
        signs=frozenset({Sign(signs)} if signs else ()),
        jumps=(jump,) if jump else (),
    )


_PLAIN = _bar()
_DC_AL_FINE = Jump(None, Sign.FINE)
_DS_AL_CODA = Jump(Sign.SEGNO, Sign.CODA)
_TO_CODA = Jump(Sign.CODA, is_to_coda=True)

_ORDERS = {
    "straight on": ([_PLAIN, _PLAIN, _PLAIN], [0, 1, 2]),
    "a repeat": ([_PLAIN, _bar(opens=True), _bar(plays=2), _PLAIN], [0, 1, 2, 1, 2, 3]),
    "three times": ([_bar(opens=True, plays=3), _PLAIN], [0, 0, 0, 1]),
    "a repeat that nobody opened": ([_PLAIN, _bar(plays=2), _PLAIN, _bar(plays=2)], [0, 1, 0, 1, 2, 3, 2, 3]),
    "two endings": (
        [_bar(opens=True), _bar(endings=(1,), plays=2), _bar(endings=(2,)), _PLAIN],
        [0, 1, 0, 2, 3],
    ),
    "an ending of two bars": (
        [_bar(opens=True), _bar(endings=(1,)), _bar(plays=2), _bar(endings=(2,)), _PLAIN],
        [0, 1, 2, 0, 3, 4],
    ),
    "three endings, two of them closed": (
        [_bar(opens=True), _bar(endings=(1,), plays=2), _bar(endings=(2,), plays=2), _bar(endings=(3,))],
        [0, 1, 0, 2, 0, 3],
    ),
    "one ending for two passes": (
        [_bar(opens=True), _bar(endings=(1, 2), plays=3), _bar(endings=(3,)), _PLAIN],
        [0, 1, 0, 1, 0, 2, 3],
    ),
    "a repeat after endings": (
        [_bar(opens=True), _bar(endings=(1,), plays=2), _bar(endings=(2,)), _bar(opens=True, plays=2)],
        [0, 1, 0, 2, 3, 3],
    ),
    "D.C. al Fine": ([_PLAIN, _bar(signs="Fine"), _bar(jump=_DC_AL_FINE)], [0, 1, 2, 0, 1]),
    "D.S. al Coda": (
        [_PLAIN, _bar(signs="Segno"), _bar(jump=_TO_CODA), _bar(jump=_DS_AL_CODA), _bar(signs="Coda")],
        [0, 1, 2, 3, 1, 2, 4],
    ),
    "D.C. without repeats": ([_bar(opens=True, plays=2), _bar(jump=Jump(None))], [0, 0, 1, 0, 1]),
    "D.C. takes the last ending": (
        [_bar(opens=True), _bar(endings=(1,), plays=2), _bar(endings=(2,)), _bar(jump=Jump(None))],
        [0, 1, 0, 2, 3, 0, 2, 3],
    ),
    "a jump to a sign that is nowhere": ([_PLAIN, _bar(jump=_DS_AL_CODA), _PLAIN], [0, 1, 2]),
    "no bars": ([], []),
}


@pytest.mark.parametrize("name", _ORDERS)
def test_bars_are_played_as_a_musician_reads_them(name: str) -> None:
    bars, expected = _ORDERS[name]
    assert play_order(bars, "song") == expected


def test_repeats_without_end_are_refused_with_their_bar() -> None:
    bars = [_bar(opens=True), *[_PLAIN] * 200, _bar(plays=99)]
    with pytest.raises(BadInput, match=r"song: bar \d+: repeats make more than 10000 bars"):
        play_order(bars, "song")
