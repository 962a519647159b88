"""What strokes and switches command. Times in ms, by hand."""

import pytest

from station.core.errors import BadInput
from station.core.events import Hit, Switched
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.control.pad_gestures import FootSwitch, PadsTogether, TwoKicks, is_written
from station.practice.control.pause_options import PauseOptions, parse_pause

K, S = Piece.KICK, Piece.SNARE


@pytest.mark.parametrize(
    ("strokes", "asks_at"),
    [
        ([(0, K), (400, K)], [900]),  # half a second after the second
        ([(0, K), (500, K)], [1125]),  # or a quarter longer than they lie apart
        ([(0, K), (1000, K)], [2250]),
        ([(0, K), (1001, K)], []),
        ([(0, K), (60, K)], [560]),
        ([(0, K), (1500, K), (2000, K)], []),  # a pedal that is tried, again and again
        ([(0, K), (1500, K), (3500, K), (4000, K)], [4625]),
        ([(0, K), (200, S), (400, K)], []),
        ([(0, K), (200, S), (400, K), (700, K)], []),
        ([(0, K), (200, S), (2200, K), (2700, K)], [3325]),
        ([(0, K), (200, S), (2199, K), (2700, K)], []),  # less than two seconds of silence before
        ([(0, K), (30, K)], []),  # one stroke that triggered twice
        ([(0, K), (30, K), (500, K), (530, K)], [1125]),
        ([(0, K), (400, K), (800, K)], []),  # three are a groove
        ([(0, K), (900, K), (1900, K)], []),
        ([(0, K), (400, K), (899, S)], []),
        ([(0, K), (400, K), (900, S)], [900]),
        ([(0, S), (300, S)], []),
    ],
)
@pytest.mark.parametrize("frame_ms", [1, 20, 10_000])
def test_two_kicks_that_stand_alone(strokes: list[tuple[int, Piece]], asks_at: list[int], frame_ms: int) -> None:
    """Whoever looks seldom learns of it at the next stroke, or when they look."""
    kicks, asked, now = TwoKicks(), 0, 0
    for at, piece in [*strokes, (10_000, None)]:
        while now + frame_ms <= at:
            now += frame_ms
            asked += kicks.advance(now * NS_PER_MS)
            assert not asked or now >= asks_at[0]
        if piece is not None:
            asked += kicks.feed(Hit(at * NS_PER_MS, piece, Zone.HEAD, 90))
    assert asked == len(asks_at)


def test_what_was_forgotten_counts_no_more_but_was_struck() -> None:
    kicks = TwoKicks()
    kicks.feed(Hit(0, K, Zone.HEAD, 90))
    kicks.forget()
    for at_ms in (300, 600):
        kicks.feed(Hit(at_ms * NS_PER_MS, K, Zone.HEAD, 90))
    assert not kicks.advance(10_000 * NS_PER_MS)


CRASHES = frozenset({Piece.CRASH_1, Piece.CRASH_2})


def score(*notes: Note) -> Score:
    return Score.from_notes(notes, TempoMap.constant(120))


@pytest.mark.parametrize(
    ("strokes", "pauses_at"),
    [
        ([(0, Piece.CRASH_1), (20, Piece.CRASH_2)], [20]),
        ([(0, Piece.CRASH_2), (0, Piece.CRASH_1)], [0]),
        ([(0, Piece.CRASH_1), (20, Piece.KICK), (50, Piece.CRASH_2)], [50]),
        ([(0, Piece.CRASH_1), (51, Piece.CRASH_2)], []),
        ([(0, Piece.CRASH_1), (20, Piece.CRASH_1)], []),
        ([(0, Piece.CRASH_1), (30, Piece.RIDE)], []),
        ([(0, Piece.CRASH_1), (40, Piece.CRASH_2), (45, Piece.KICK)], [40]),
    ],
)
def test_two_pads_at_once(strokes: list[tuple[int, Piece]], pauses_at: list[int]) -> None:
    together = PadsTogether([CRASHES], score(Note(0, K)))
    assert [at for at, piece in strokes if together.feed(Hit(at * NS_PER_MS, piece, Zone.EDGE, 90))] == pauses_at


def test_what_the_score_asks_for_commands_nothing() -> None:
    """A 16th at 120 is 125 ms: too near to be told apart in an uneven hand; an eighth is not."""
    at_once = score(Note(0, Piece.CRASH_1), Note(0, Piece.CRASH_2))
    assert is_written(CRASHES, at_once)
    assert is_written(CRASHES, score(Note(0, Piece.CRASH_1), Note(PPQ // 4, Piece.CRASH_2)))
    assert not is_written(CRASHES, score(Note(0, Piece.CRASH_1), Note(PPQ // 2, Piece.CRASH_2)))
    assert not is_written(CRASHES, score(Note(0, Piece.CRASH_1)))
    together = PadsTogether([CRASHES], at_once)
    assert not any(together.feed(Hit(0, piece, Zone.EDGE, 90)) for piece in CRASHES)


def test_a_pedal_that_moves_is_pressed_once() -> None:
    switch = FootSwitch({"cc=64"})
    told = [(0, "cc=64"), (20, "cc=64"), (310, "cc=64"), (700, "cc=64"), (800, "program=1")]
    assert [at for at, name in told if switch.feed(Switched(at * NS_PER_MS, name))] == [0, 700]


def test_what_pauses_in_words() -> None:
    wish = parse_pause("crash_1+crash_2 ride+snare cc=064 program=5 key=224 button=10")
    assert wish.pairs == (CRASHES, frozenset({Piece.RIDE, S}))
    assert wish.switches == {"cc=64", "program=5", "key=224", "button=10"}
    assert parse_pause("") == PauseOptions()


@pytest.mark.parametrize(
    "text",
    ["snare", "snare+snare", "snare+cowbells", "cc=128", "key=232", "button=14", "cc=", "cc=-1", "a+b+c", "note=3"],
)
def test_a_word_that_pauses_nothing_is_named(text: str) -> None:
    with pytest.raises(BadInput, match="expected two pads such as"):
        parse_pause(f"cc=64 {text}", "settings: pause")
