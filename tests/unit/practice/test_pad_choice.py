"""Which pad chooses what on the screen, and when a stroke does. Times in ms, by hand."""

import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS
from station.practice.control.pad_choice import PadChoice, pads_for

K, S, T, H = Piece.KICK, Piece.SNARE, Piece.TOM_1, Piece.HIHAT
PADS = ((S,), (T, H), ())


def chosen(strokes: list[tuple[int, Piece]], until_ms: int = 10_000, frame_ms: int = 10_000) -> list[tuple[int, int]]:
    """What is chosen, each with the time at which it is known; it came up at 0 and is looked at every frame."""
    choice, made = PadChoice(PADS, up_ns=0), []
    for frame in range(frame_ms, until_ms + 1, frame_ms):
        for at, piece in strokes:
            if (
                frame - frame_ms <= at < frame
                and (option := choice.feed(Hit(at * NS_PER_MS, piece, Zone.HEAD, 90))) is not None
            ):
                made.append((at, option))
        if (option := choice.advance(frame * NS_PER_MS)) is not None:
            made.append((frame, option))
    return made


@pytest.mark.parametrize(
    ("strokes", "option"),
    [
        ([(1000, S)], 0),
        ([(1500, H)], 1),
        ([(1500, T)], 1),
        ([(999, S)], None),  # nothing chooses before a second of silence
        ([(400, K), (1300, S)], None),  # and any stroke begins it anew
        ([(400, K), (1400, S)], 0),
        ([(999, S), (1999, S)], 0),
        ([(2000, K)], None),  # kicks start, and choose nothing
        ([(2000, Piece.RIDE)], None),  # no option has it
        ([(2000, S), (2030, T)], None),  # a flam, or crosstalk
        ([(2000, S), (2030, Piece.RIDE)], None),
        ([(2000, S), (2030, K)], None),
        ([(2000, S), (2030, S)], 0),  # one stroke that triggered twice
        ([(2000, S), (2250, S)], None),  # a phrase
        ([(2000, S), (2499, K)], None),
        ([(2000, S), (2500, T)], 0),
        ([(2000, S), (2250, S), (3250, T)], 1),  # after it another second
        ([(2000, S), (2250, S), (3200, T)], None),
    ],
)
def test_a_lone_stroke_after_a_second_of_silence_chooses(strokes: list[tuple[int, Piece]], option: int | None) -> None:
    assert [of for _, of in chosen(strokes)] == ([] if option is None else [option])


def test_it_chooses_once() -> None:
    assert [option for _, option in chosen([(1000, S), (3000, H)])] == [0]


@pytest.mark.parametrize("frame_ms", [4, 16, 100, 500])
def test_any_frame_rate_chooses_the_same(frame_ms: int) -> None:
    strokes = [(300, S), (1200, H), (2300, S), (2340, T), (4000, T), (9000, S)]
    (choice,) = chosen(strokes, frame_ms=frame_ms)
    assert choice[1] == 1


def test_it_is_told_half_a_second_after_the_stroke_and_shown_until_then() -> None:
    choice = PadChoice(PADS, up_ns=0)
    assert not choice.hears(999 * NS_PER_MS)
    assert choice.hears(1000 * NS_PER_MS)
    choice.feed(Hit(1000 * NS_PER_MS, T, Zone.HEAD, 90))
    assert choice.meant == 1
    assert choice.advance(1499 * NS_PER_MS) is None
    assert choice.advance(1500 * NS_PER_MS) == 1
    assert choice.meant is None


def test_the_snare_chooses_first_then_toms_from_left_to_right() -> None:
    kit = {K, H, S, Piece.FLOOR_TOM_1, T, Piece.RIDE, Piece.HIHAT_PEDAL}
    assert pads_for(5, kit) == tuple(map(frozenset, ({S}, {T}, {Piece.FLOOR_TOM_1}, {H}, {Piece.RIDE})))


def test_options_that_have_no_pad_are_left_to_the_keys() -> None:
    assert pads_for(3, {K, S}) == (frozenset({S}), frozenset(), frozenset())
