"""Messages: what fits comes back the same, to the last bit; what does not fit is refused by name."""

from dataclasses import replace

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.events import Choke, Hit
from station.core.pieces import Articulation, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.performance import Performance
from station.music.score import NOTE_DTYPE, Note, Score
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.link.link_messages import (
    MOST_NAME,
    Accept,
    Bye,
    Called,
    Checked,
    Claim,
    Figure,
    Hello,
    Message,
    Offer,
    Outcome,
    Pause,
    PlayedBar,
    PlayedTurn,
    Resume,
    decoded,
    encoded,
    shown_name,
)
from station.practice.battle.link.link_strokes import (
    called,
    performance_of,
    phrase_of,
    played_chokes,
    played_strokes,
)
from station.practice.battle.phrase import Phrase
from station.scoring.matching.hit_windows import Level

HIT = Hit(-3_000_001, Piece.HIHAT, Zone.EDGE, 97, Articulation.NORMAL, 0.1, 26, None, Limb.LEFT_HAND, "kit", 0.3)
PLAYED = Performance.from_hits([HIT, replace(HIT, at_ns=5, openness=None, position=0.7)], [Choke(9, Piece.CRASH_1)])
OFFER = Offer("improvise", 92.5, 4, 4, Feel.TRIPLET, "jazz", "mirror", 3, True, 4, 3, 0.9, None, 7, True, True)
CLAIM = Claim(61.5, True, (Figure("right", 12.0), Figure("mean_ms", -3.25), Figure("motifs", None)))
TURN = PlayedTurn(2, played_strokes(PLAYED), played_chokes(PLAYED), ((0, 5), (-7, 9)), CLAIM)
SAID: tuple[Message, ...] = (
    Hello("The shed", "Zoë", Level.STUDIO, "0.1.0"),
    OFFER,
    Accept(),
    PlayedBar(1, 3, TURN.strokes, TURN.chokes),
    TURN,
    Checked(1, Claim(None, None, ())),
    Pause(),
    Resume(),
    Outcome(3, "0123456789abcdef" * 2),
    Bye("left"),
)


@pytest.mark.parametrize("message", SAID, ids=lambda message: type(message).__name__)
def test_each_message_comes_back_as_it_was_sent(message: Message) -> None:
    assert decoded(encoded(message), "them") == message


def test_what_was_played_comes_back_to_the_last_bit() -> None:
    strokes, chokes = played_strokes(PLAYED), played_chokes(PLAYED)
    back = decoded(encoded(PlayedBar(1, 0, strokes, chokes)), "them")
    assert isinstance(back, PlayedBar)
    again = performance_of(back.strokes, back.chokes)
    assert again.hits.tobytes() == PLAYED.hits.tobytes()
    assert again.chokes.tobytes() == PLAYED.chokes.tobytes()


def a_phrase() -> Phrase:
    ground = Ground(100.0, 3, 4)
    notes = [
        Note(0, Piece.KICK, late_ms=-12.5),
        Note(PPQ, Piece.SNARE, velocity=30, ornament=Ornament.FLAM, lead_ms=31.3, limb=Limb.LEFT_HAND),
        Note(PPQ, Piece.SNARE, velocity=110, ornament=Ornament.FLAM, limb=Limb.RIGHT_HAND),
        Note(3 * PPQ, Piece.HIHAT, openness=0.5, choke_ticks=PPQ // 2),
    ]
    landing = Score.from_notes([Note(0, Piece.CRASH_1)], ground.tempo_map).notes
    return Phrase(Score.from_notes(notes, ground.tempo_map, 2 * ground.bar_ticks), landing, "a build")


def test_a_phrase_comes_back_with_its_ornaments_timing_and_landing() -> None:
    phrase, ground = a_phrase(), Ground(100.0, 3, 4)
    back = decoded(encoded(called(phrase, 1, 6)), "them")
    assert isinstance(back, Called)
    again = phrase_of(back, ground, "them")
    assert (back.round, back.step, again.bars, again.words) == (1, 6, 2, "a build")
    assert again.score.notes.tobytes() == phrase.score.notes.tobytes()
    assert again.landing.tobytes() == phrase.landing.tobytes()
    assert np.array_equal(again.score.onset_ns, phrase.score.onset_ns)
    assert phrase.score.notes.dtype == NOTE_DTYPE


def test_a_phrase_with_strokes_outside_its_bars_is_refused() -> None:
    said = called(a_phrase(), 1, 0)
    with pytest.raises(BadInput, match="outside its bars"):
        phrase_of(msgspec.structs.replace(said, bars=1), Ground(100.0, 3, 4), "them")
    late = msgspec.structs.replace(said.landing[0], tick=1)
    with pytest.raises(BadInput, match="outside its bars"):
        phrase_of(msgspec.structs.replace(said, landing=(late,)), Ground(100.0, 3, 4), "them")


@pytest.mark.parametrize("field", ["duration_ticks", "choke_ticks", "swing_ticks"])
def test_a_phrase_with_a_stroke_that_never_ends_is_refused(field: str) -> None:
    said = called(a_phrase(), 1, 0)
    endless = msgspec.structs.replace(said.strokes[0], **{field: 1 << 40})
    with pytest.raises(BadInput, match="outlasts its bars"):
        phrase_of(msgspec.structs.replace(said, strokes=(endless,)), Ground(100.0, 3, 4), "them")


ROW = list(msgspec.structs.astuple(TURN.strokes[0]))


def bar_with(place: int, value: object) -> dict[str, object]:
    return {"type": "bar", "round": 1, "bar": 0, "strokes": [[*ROW[:place], value, *ROW[place + 1 :]]], "chokes": []}


HELLO_RAW = {"type": "hello", "station": "s", "player": "p", "level": "studio", "program": "1"}
OFFER_RAW = msgspec.to_builtins(OFFER) | {"type": "offer"}
WRONG: dict[str, object] = {
    "a type that nobody knows": {"type": "reboot"},
    "no type": {},
    "no table": [1, 2],
    "a key too many": {"type": "accept", "please": 1},
    "a key too few": {"type": "bar", "round": 1},
    "a round past the last": {"type": "bar", "round": 100, "bar": 0, "strokes": [], "chokes": []},
    "a bar before the first": {"type": "bar", "round": 1, "bar": -1, "strokes": [], "chokes": []},
    "too many strokes": {"type": "bar", "round": 1, "bar": 0, "strokes": [ROW] * 2049, "chokes": []},
    "a row too long": {"type": "bar", "round": 1, "bar": 0, "strokes": [[*ROW, 1]], "chokes": []},
    "a far time": bar_with(0, 10**13),
    "a time that is no whole number": bar_with(0, 0.5),
    "a piece that nobody has": bar_with(1, 99),
    "a truth for a piece": bar_with(1, True),
    "no velocity": bar_with(4, 0),
    "a velocity of 128": bar_with(4, 128),
    "a fraction that rounds to 1": bar_with(5, 1 - 2**-30),
    "a limb too many": bar_with(6, 9),
    "an openness that is no number": bar_with(8, float("nan")),
    "an endless openness": bar_with(8, float("inf")),
    "a text for a number": bar_with(9, "0.5"),
    "a name too long": HELLO_RAW | {"player": "x" * 41},
    "a name that rings a bell": HELLO_RAW | {"player": "x\a"},
    "a name that clears a screen": HELLO_RAW | {"player": "\x1b[2J"},
    "a name that turns writing": HELLO_RAW | {"station": "\u202egnp"},
    "a name with blanks about it": HELLO_RAW | {"station": " x"},
    "a name in another form": HELLO_RAW | {"station": "e\u0301"},
    "a level of no table": HELLO_RAW | {"level": "godlike"},
    "a tempo that is no number": OFFER_RAW | {"tempo_bpm": float("nan")},
    "a tempo of nobody": OFFER_RAW | {"tempo_bpm": 1e9},
    "a seed too long": OFFER_RAW | {"seed": 1 << 63},
    "a mode of its own": OFFER_RAW | {"mode": "fight"},
    "a digest that is none": {"type": "outcome", "rounds": 1, "digest": "0" * 31 + "g"},
    "a digest and a line more": {"type": "outcome", "rounds": 1, "digest": "0" * 32 + "\n"},
    "a figure with a bell": {"type": "checked", "round": 1, "claim": [1.0, True, [["\a", 1.0]]]},
    "points that are no number": {"type": "checked", "round": 1, "claim": [float("nan"), True, []]},
    "points beyond all": {"type": "checked", "round": 1, "claim": [101.0, True, []]},
    "a round before the first": {"type": "checked", "round": 0, "claim": [1.0, True, []]},
    "a claim without end": {"type": "checked", "round": 1, "claim": [1.0, True, [["x", 1.0]] * 33]},
}


@pytest.mark.parametrize("raw", WRONG.values(), ids=WRONG.keys())
def test_what_does_not_fit_is_refused(raw: object) -> None:
    with pytest.raises(BadInput, match=r"^them: message: "):
        decoded(msgspec.msgpack.encode(raw), "them")


@pytest.mark.parametrize("data", [b"", b"\xc1", b"\x91" * 5000, b"\xdd\xff\xff\xff\xff", encoded(Accept()) + b"\0"])
def test_bytes_that_are_no_message_are_refused(data: bytes) -> None:
    with pytest.raises(BadInput):
        decoded(data, "them")


@given(st.sampled_from(SAID), st.integers(0, 400), st.binary(min_size=1, max_size=6))
def test_a_bent_message_is_one_that_fits_or_is_refused(message: Message, at: int, noise: bytes) -> None:
    data = encoded(message)
    place = at % len(data)
    try:
        found = decoded(data[:place] + noise + data[place + len(noise) :], "them")
    except BadInput:
        return
    assert decoded(encoded(found), "them") == found


@given(st.text(max_size=200))
def test_any_name_can_be_made_fit_to_be_sent(written: str) -> None:
    name = shown_name(written, instead="somebody")
    assert 1 <= len(name) <= MOST_NAME
    hello = Hello(name, name, Level.STUDIO, "1")
    assert decoded(encoded(hello), "them") == hello


def test_names_lose_what_nobody_should_see() -> None:
    assert shown_name("  Zoe\u0308\n the\x1b[31m great ") == "Zoë the [31m great"
