"""What two stations say to each other: frozen messages with checked types, ranges and lengths, as MessagePack.

`encoded` writes one, `decoded` reads one and refuses whatever does not fit: an unknown type, a key too many, a number
out of its range (NaN is in none), a list or a text too long, letters that nobody sees. Times are ns in turn time; what
they may be in this battle is asked where the battle is known (`linked_battle`).
"""

from typing import Annotated, Literal
from unicodedata import normalize

import msgspec
from msgspec import Meta, Struct

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.practice.battle.battle_rules import MOST_SEED
from station.practice.battle.ground import Feel
from station.scoring.matching.hit_windows import Level

MOST_NAME = 40
"""Letters of a name (our choice: what stands over a figure on stage)."""
MOST_LINE = 120
"""Letters of a line of words (`exchange.plain_words.LONGEST_LINE`)."""
MOST_STROKES = 2048
"""In a message (our choice: sixteen bars of sixteen strokes a beat, and half as many again)."""
MOST_BARS, MOST_ROUNDS = 16, 99
"""Of a turn and of a battle (our choices: what `battle.rules` lets through, and room for more)."""
MOST_SPANS, MOST_FIGURES = 64, 32
"""Times in a turn in which a kit was not heard, and figures of a judgement (our choices)."""
MOST_FRACTION = 1 - 2**-24
"""The greatest number of 32 bits below 1."""
MOST_OFF_MS = 250.0
"""How far a written stroke may sound from its tick (our choice: several times what a drummer's own timing may be)."""
FARTHEST_NS = 10**12
"""Of a time in a turn: sixteen bars of nine slow beats take half of it (our choice)."""

Name = Annotated[str, Meta(max_length=MOST_NAME)]
Line = Annotated[str, Meta(max_length=MOST_LINE)]
TurnNs = Annotated[int, Meta(ge=-FARTHEST_NS, le=FARTHEST_NS)]
Fraction = Annotated[float, Meta(ge=0, le=1)]
Points = Annotated[float, Meta(ge=0, le=100)]
Ticks = Annotated[int, Meta(ge=0, le=1 << 40)]
Round = Annotated[int, Meta(ge=1, le=MOST_ROUNDS)]
Step = Annotated[int, Meta(ge=0, le=1000)]
Number7 = Annotated[int, Meta(ge=0, le=127)]
Velocity = Annotated[int, Meta(ge=1, le=127)]


def shown_name(written: str, instead: str = "") -> str:
    """`written` as a name that can be sent and shown: printable, in Unicode's form C, one line, not too long."""
    letters = "".join(c if c.isprintable() else " " for c in normalize("NFC", written))
    return normalize("NFC", " ".join(letters.split())[:MOST_NAME].strip()) or instead


def _check_texts(said: Struct) -> None:
    """Raises `ValueError` for a text that is not safe to print, or not as we would write it."""
    texts = {field: getattr(said, field) for field in said.__struct_fields__}
    for field, text in texts.items():
        if isinstance(text, str) and not (text.isprintable() and text == normalize("NFC", text.strip())):
            raise ValueError(f"`{field}` has letters that cannot be printed")


class _Checked(Struct, frozen=True, forbid_unknown_fields=True):
    """A message; every text in it must be one that is safe to print."""

    def __post_init__(self) -> None:
        _check_texts(self)


class _Row(Struct, frozen=True, forbid_unknown_fields=True, array_like=True):
    """A row of a table: its values alone, in the order of the fields."""


# --- rows ------------------------------------------------------------------------------------------------------------


class PlayedStroke(_Row, frozen=True):
    """A row of `music.performance.HIT_DTYPE`; None where the kit could not tell."""

    at_ns: TurnNs
    piece: Piece
    zone: Zone
    articulation: Articulation
    velocity: Velocity
    velocity_fraction: Annotated[float, Meta(ge=0, le=MOST_FRACTION)]
    limb: Limb
    midi_note: Number7
    openness: Fraction | None
    position: Fraction | None


class PlayedChoke(_Row, frozen=True):
    """A cymbal was grabbed."""

    at_ns: TurnNs
    piece: Piece


class WrittenStroke(_Row, frozen=True):
    """A row of `music.score.NOTE_DTYPE`."""

    tick: Ticks
    piece: Piece
    zone: Zone
    articulation: Articulation
    velocity: Velocity
    dynamic: Dynamic
    ornament: Ornament
    limb: Limb
    midi_note: Number7
    duration_ticks: Ticks
    choke_ticks: Ticks
    swing_ticks: Ticks
    lead_ms: Annotated[float, Meta(ge=0, le=MOST_OFF_MS)]
    late_ms: Annotated[float, Meta(ge=-MOST_OFF_MS, le=MOST_OFF_MS)]
    openness: Fraction | None


class Figure(_Row, frozen=True):
    """One figure of a judgement by its name: a count, a mean, the points of a component; None where nobody can tell."""

    name: Name
    value: Annotated[float, Meta(ge=-1e9, le=1e9)] | None

    def __post_init__(self) -> None:
        _check_texts(self)


class Claim(_Row, frozen=True):
    """What an end judges a turn to be: points (None where nothing is known), whether it is won (None where none is)."""

    points: Points | None
    won: bool | None
    figures: Annotated[tuple[Figure, ...], Meta(max_length=MOST_FIGURES)]


Strokes = Annotated[tuple[PlayedStroke, ...], Meta(max_length=MOST_STROKES)]
Chokes = Annotated[tuple[PlayedChoke, ...], Meta(max_length=MOST_STROKES)]
Written = Annotated[tuple[WrittenStroke, ...], Meta(max_length=MOST_STROKES)]


# --- messages --------------------------------------------------------------------------------------------------------


class Hello(_Checked, frozen=True, tag="hello"):
    """The first message of either end: who they are, and by which windows they judge their own kit.

    `program` is the station's version: another one may judge otherwise.
    """

    station: Name
    player: Name
    level: Level
    program: Name


class Offer(_Checked, frozen=True, tag="offer"):
    """The host's rules of the battle, and who begins."""

    mode: Literal["repeat", "improvise"]
    tempo_bpm: Annotated[float, Meta(ge=10, le=1000)]
    beats: Annotated[int, Meta(ge=1, le=32)]
    unit: Literal[1, 2, 4, 8, 16, 32]
    feel: Feel
    style: Name
    opponent: Name
    rounds: Annotated[int, Meta(ge=1, le=MOST_ROUNDS)]
    has_final: bool
    bars: Annotated[int, Meta(ge=1, le=MOST_BARS)]
    lives: Annotated[int, Meta(ge=1, le=MOST_ROUNDS)]
    target: Fraction
    first_step: Step | None
    seed: Annotated[int, Meta(ge=0, le=MOST_SEED)]
    keeps_time: bool
    host_begins: bool


class Accept(_Checked, frozen=True, tag="accept"):
    """The joiner plays by the host's rules."""


class Called(_Checked, frozen=True, tag="called"):
    """The phrase that both repeat in a round, at its step of difficulty."""

    round: Round
    step: Step
    bars: Annotated[int, Meta(ge=1, le=MOST_BARS)]
    strokes: Written
    landing: Annotated[tuple[WrittenStroke, ...], Meta(max_length=32)]
    words: Line


class PlayedBar(_Checked, frozen=True, tag="bar"):
    """A bar of a turn, as soon as it is whole: for the other station to play and show, never to judge."""

    round: Round
    bar: Annotated[int, Meta(ge=0, lt=MOST_BARS)]
    strokes: Strokes
    chokes: Chokes


class PlayedTurn(_Checked, frozen=True, tag="turn"):
    """A whole turn or answer, when its kit was not heard, and what its own station judges it to be."""

    round: Round
    strokes: Strokes
    chokes: Chokes
    unheard: Annotated[tuple[tuple[TurnNs, TurnNs], ...], Meta(max_length=MOST_SPANS)]
    claim: Claim


class Checked(_Checked, frozen=True, tag="checked"):
    """What whoever received a turn judges it to be, by the same function; the claims agree, or the turn counts not."""

    round: Round
    claim: Claim


class Pause(_Checked, frozen=True, tag="pause"):
    """A player asked for a pause; both stations stand."""


class Resume(_Checked, frozen=True, tag="resume"):
    """Whoever asked for the pause goes on."""


class Outcome(_Checked, frozen=True, tag="outcome"):
    """What an end has when the battle is over: so many rounds that both finished, and the digest of their record."""

    rounds: Annotated[int, Meta(ge=0, le=MOST_ROUNDS)]
    digest: Annotated[str, Meta(pattern=r"^[0-9a-f]{32}\Z")]


class Bye(_Checked, frozen=True, tag="bye"):
    """An end leaves, and why; nothing comes after it."""

    why: Literal["over", "left", "declined", "fault"]


Message = Hello | Offer | Accept | Called | PlayedBar | PlayedTurn | Checked | Pause | Resume | Outcome | Bye


class Card(_Checked, frozen=True):
    """What a host shows to whoever asks who hosts; no battle is open yet, and anybody may have written it."""

    station: Name
    about: Name
    is_busy: bool


_UNREADABLE = (msgspec.MsgspecError, UnicodeDecodeError, RecursionError)
"""What msgspec raises for bytes that are no message of the type: a tag that is no UTF-8 has an error of its own."""
_ENCODER = msgspec.msgpack.Encoder()
_MESSAGES: msgspec.msgpack.Decoder[Message] = msgspec.msgpack.Decoder(Message)
_CARDS = msgspec.msgpack.Decoder(Card)


def encoded(message: Message | Card) -> bytes:
    """The message as MessagePack."""
    return _ENCODER.encode(message)


def decoded(data: bytes, source: str) -> Message:
    """The message that `data` is; raises `BadInput` of `source` where it does not fit."""
    try:
        return _MESSAGES.decode(data)
    except _UNREADABLE as fault:
        raise BadInput(source, "message", str(fault)) from None


def decoded_card(data: bytes) -> Card | None:
    """The card that `data` is, None where it is none."""
    try:
        return _CARDS.decode(data)
    except _UNREADABLE:
        return None
