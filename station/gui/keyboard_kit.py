"""The computer's keyboard as a kit, for when there is none.

The window system hands keys over once a frame, so a key's time is known to a frame at best: each stroke is stamped when
it was polled, and the window shows how far apart the polls are. Keys have no velocity.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from imgui_bundle import imgui

from station.app.settings.view_settings import SLOTS
from station.core.labels import piece_name
from station.core.named_view import NamedView
from station.core.pieces import Articulation, Piece, Zone
from station.engine.messages import KeyHit

VELOCITY = 90
"""A plain stroke (HUMANS: normal 60–95); keys cannot tell more."""


@dataclass(frozen=True, slots=True)
class KeyStroke:
    """What a key plays; `cap` is what is written on it."""

    cap: str
    piece: Piece
    zone: Zone = Zone.HEAD
    articulation: Articulation = Articulation.NORMAL
    openness: float | None = None

    @property
    def words(self) -> str:
        """What it plays, in words."""
        if self.articulation is Articulation.CROSS_STICK:
            return f"{piece_name(self.piece)}, cross stick"
        if self.zone is Zone.BELL:
            return f"{piece_name(self.piece)}, bell"
        return f"{piece_name(self.piece)}, open" if self.openness == 1.0 else piece_name(self.piece)


KEYS: Mapping[imgui.Key, KeyStroke] = MappingProxyType(
    {
        imgui.Key.space: KeyStroke("Space", Piece.KICK),
        imgui.Key.b: KeyStroke("B", Piece.KICK),
        imgui.Key.f: KeyStroke("F", Piece.SNARE),
        imgui.Key.j: KeyStroke("J", Piece.SNARE),
        imgui.Key.d: KeyStroke("D", Piece.HIHAT, Zone.BOW, openness=0.0),
        imgui.Key.k: KeyStroke("K", Piece.HIHAT, Zone.BOW, openness=0.0),
        imgui.Key.s: KeyStroke("S", Piece.HIHAT, Zone.BOW, openness=1.0),
        imgui.Key.v: KeyStroke("V", Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0),
        imgui.Key.l: KeyStroke("L", Piece.RIDE, Zone.BOW),
        imgui.Key.semicolon: KeyStroke(";", Piece.RIDE, Zone.BELL),
        imgui.Key.a: KeyStroke("A", Piece.CRASH_1, Zone.EDGE),
        imgui.Key.t: KeyStroke("T", Piece.TOM_1),
        imgui.Key.y: KeyStroke("Y", Piece.TOM_2),
        imgui.Key.h: KeyStroke("H", Piece.FLOOR_TOM_1),
        imgui.Key.g: KeyStroke("G", Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
    }
)
"""Hands rest on F and J; the feet are the thumbs."""


GROOVE_KEYS = ", ".join(
    next(f"{key.cap}: {piece_name(piece)}" for key in KEYS.values() if key.piece is piece)
    for piece in (Piece.KICK, Piece.SNARE, Piece.HIHAT)
)
"""The keys of a first groove, in words."""

COMMANDS: tuple[tuple[str, str], ...] = (
    ("Enter", "start, or the first of what comes next"),
    ("Esc", "stop, no answer, or back to the lessons; a pad is not learnt"),
    ("Backspace", "pause, or go on"),
    ("F1", "help: the page that is open, and these keys"),
    ("F2 to F9", "the named views, in the list's order"),
    ("M", "mirror"),
    ("P", "second picture: hands, feet, none"),
    ("N", "score: scrolling, pages, highway"),
    ("E", "your double over the demonstrator, beside it, or not at all"),
    ("1 to 8", "your own viewpoints; 1 to 4 an answer, or what comes next"),
    ("Ctrl+1 to 8", "keep where you look from"),
    ("Ctrl+= and Ctrl+-", "larger and smaller panels"),
    ("W", "watch the demonstration, or stop it"),
    ("R, C, Q", "backwards; its click; a count-in before it"),
    (", and .", "a step back, a step on"),
    ("X", "how far a step goes"),
    ("[ and ]", "rewind, forward while held"),
    ("Home, End", "to its start, to its end"),
    ("- and =", "slower, faster"),
    ("I, O, U", "repeat from this bar, to it, all bars"),
    ("Shift+1 to 8", "its flags"),
    ("Ctrl+Shift+1 to 8", "keep this place as a flag"),
    ("Tab, arrows", "from control to control"),
)
"""What the other keys do, as the help shows it."""

VIEW_KEYS: Mapping[imgui.Key, NamedView] = MappingProxyType(
    dict(zip((imgui.Key(imgui.Key.f2 + i) for i in range(len(NamedView))), NamedView, strict=True))
)
"""F2 and the keys after it take the named views in order."""
SLOT_KEYS = tuple(imgui.Key(imgui.Key._1 + i) for i in range(SLOTS))
"""The viewpoints' digits."""


def slot_pressed() -> int | None:
    """The viewpoint (from 0) whose digit went down since the last frame, None for none."""
    return next((slot for slot, key in enumerate(SLOT_KEYS) if imgui.is_key_pressed(key, repeat=False)), None)


def view_pressed() -> NamedView | None:
    """The named view whose key went down since the last frame, None for none."""
    return next((view for key, view in VIEW_KEYS.items() if imgui.is_key_pressed(key, repeat=False)), None)


def pressed(now_ns: int) -> list[KeyHit]:
    """The strokes of the keys that went down since the last frame, stamped `now_ns`; none while text is typed."""
    io = imgui.get_io()
    if io.want_text_input or io.key_ctrl or io.key_alt or io.key_super:
        return []
    return [_hit(stroke, now_ns) for key, stroke in KEYS.items() if imgui.is_key_pressed(key, repeat=False)]


def _hit(stroke: KeyStroke, now_ns: int) -> KeyHit:
    return KeyHit(now_ns, stroke.piece, stroke.zone, VELOCITY, stroke.articulation, stroke.openness)
