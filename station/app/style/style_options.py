"""The state of the figure panel: the demonstrator's controls, their lanes over the bars, and the eight slots.

A value: no window, no file, no drummer. Each change gives other options with a `style` that a drummer is renewed with;
what has not changed stays the same object. A share of an arm's joint gives and takes from the other two, which keep
their ratio (thesis § 4.1.1), unless `unconstrained`: then each is set for itself, as half of the thesis's users asked
for.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from station.core.pieces import Piece, word
from station.motion.style.style import JOINTS, NATURAL, NUMBERS, WORDS, Automation, Style, range_of
from station.motion.style.style_file import Slots

KINDS = ("amplitude", "frequency")
_SHARES: Mapping[str, tuple[str, str]] = {f"{kind}_{joint}": (kind, joint) for kind in KINDS for joint in JOINTS}
_WHOLE, _NEARLY = 100.0, 0.5
"""Shares that add up to 100 per cent, but for rounding, are shares; others were set each for itself."""
PIECES: Mapping[str, Piece] = {word(piece): piece for piece in Piece}


@dataclass(frozen=True, slots=True)
class StyleOptions:
    """What the user makes of a style; `base` is the one that was chosen, which a reset goes back to."""

    style: Style = field(default_factory=Style)
    base: Style = field(default_factory=Style)
    unconstrained: bool = False
    slots: Slots = field(default_factory=Slots)

    @classmethod
    def of(cls, style: Style, slots: Slots | None = None) -> "StyleOptions":
        """A style as it was chosen."""
        return cls(slots=slots or Slots()).choose(style)

    # --- styles -------------------------------------------------------------------------------------------------------

    def choose(self, style: Style) -> "StyleOptions":
        """Take a style whole."""
        chosen = replace(self, style=style, base=style)
        return replace(chosen, unconstrained=not all(chosen._is_shared(kind) for kind in KINDS))

    @property
    def is_changed(self) -> bool:
        """Whether anything differs from the style that was chosen."""
        return self.style != self.base

    def store(self, slot: int, name: str = "") -> "StyleOptions":
        """Keep the style in a slot, from 0; it is called `name` there, or as it is."""
        return replace(self, slots=self.slots.stored(slot, replace(self.style, name=name or self.style.name)))

    def recall(self, slot: int) -> "StyleOptions":
        """Take the style of a slot, from 0, if there is one."""
        style = self.slots.styles[slot]
        return self if style is None else self.choose(style)

    # --- controls -----------------------------------------------------------------------------------------------------

    def value(self, name: str) -> float:
        """What a number, or a piece's amplitude, is set to where no lane moves it."""
        if name in PIECES:
            return float(self.style.pieces.get(PIECES[name], NATURAL))
        return float(getattr(self.style, name))

    def put(self, name: str, value: float) -> "StyleOptions":
        """Set a number, or a piece's amplitude; what is out of its range is set to the nearest end."""
        low, high = range_of(name)
        value = min(max(value, low), high)
        if name in PIECES:
            return self._styled(pieces={**self.style.pieces, PIECES[name]: value})
        if name in _SHARES and not self.unconstrained:
            return replace(self, style=self.style.with_share(*_SHARES[name], value))
        assert name in NUMBERS, name
        return self._styled(**{name: value})

    def say(self, name: str, said: str) -> "StyleOptions":
        """Set a control that is a word."""
        assert said in WORDS[name], said
        return self._styled(**{name: said})

    def sow(self, seed: int) -> "StyleOptions":
        """Let chance decide anew what it decides: blinks, looks, spun sticks."""
        return self._styled(seed=max(seed, 0))

    def can_reset(self, name: str) -> bool:
        """Whether a control differs from the style that was chosen."""
        if name in PIECES:
            piece = PIECES[name]
            return self.style.pieces.get(piece) != self.base.pieces.get(piece)
        return bool(getattr(self.style, name) != getattr(self.base, name))

    def reset(self, name: str) -> "StyleOptions":
        """Set one control back to the style that was chosen."""
        if name in PIECES:
            piece = PIECES[name]
            others = {p: v for p, v in self.style.pieces.items() if p is not piece}
            had = self.base.pieces.get(piece)
            return self._styled(pieces=others if had is None else {**others, piece: had})
        if name in NUMBERS:
            return self.put(name, float(getattr(self.base, name)))
        return self._styled(**{name: getattr(self.base, name)})

    def _styled(self, **changed: object) -> "StyleOptions":
        return replace(self, style=replace(self.style, **changed))  # type: ignore[arg-type] # fields of a style

    # --- the arm's shares ---------------------------------------------------------------------------------------------

    def constrain(self, constrained: bool) -> "StyleOptions":
        """Share the gain among the joints, or let each be set for itself.

        Where shares are made of what was set, the gain takes the rest, so that the movement stays while it can.
        """
        options = replace(self, unconstrained=not constrained)
        if constrained:
            for kind in KINDS:
                options = options._share(kind)
        return options

    def factor(self, name: str) -> float | None:
        """What a joint's share comes to: its movement against the natural one in bar 1; None for other controls."""
        if name not in _SHARES:
            return None
        return float(self.style.joint_factor(*_SHARES[name], 1.0))

    def _set_to(self, kind: str) -> dict[str, float]:
        return {f"{kind}_{joint}": self.value(f"{kind}_{joint}") for joint in JOINTS}

    def _is_shared(self, kind: str) -> bool:
        return abs(sum(self._set_to(kind).values()) - _WHOLE) < _NEARLY

    def _share(self, kind: str) -> "StyleOptions":
        had = self._set_to(kind)
        total = sum(had.values())
        if abs(total - _WHOLE) < _NEARLY:
            return self
        gain = f"{kind}_gain"
        natural = {name: float(getattr(Style(), name)) for name in had}
        shares = {name: _WHOLE * value / total for name, value in had.items()} if total else natural
        return self._styled(**shares).put(gain, self.value(gain) * total / _WHOLE)

    # --- lanes --------------------------------------------------------------------------------------------------------

    def lane(self, name: str) -> Automation | None:
        """The lane of a control or a piece; None where it is the same in all bars."""
        return self.style.automation.get(name)

    def draw_lane(self, name: str, lane: Automation) -> "StyleOptions":
        """Put a lane in the place of the control's; a lane without points is none."""
        low, high = range_of(name)
        kept = {other: points for other, points in self.style.automation.items() if other != name}
        if lane:
            kept[name] = tuple((bar, min(max(value, low), high)) for bar, value in lane)
        return self._styled(automation=kept)

    def end_lane(self, name: str) -> "StyleOptions":
        """Let a control be the same in all bars again."""
        return self.draw_lane(name, ())
