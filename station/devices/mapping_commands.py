"""Changes a kit by words, as a live page offers them.

threshold PIECE VELOCITY      softer is no stroke
mask PIECE MS                 so long after a stroke there is no other
ghost SOURCE VICTIM SHARE     a stroke on SOURCE makes VICTIM send hits up to so loud (0: no longer)
travel OPENNESS               a stomp beside a hi-hat stroke counts if the pedal closed by so much (0: always)
grab VELOCITY                 strokes up to so hard around a grab come from the grabbing hand
curve PIECE SHAPE             strokes count as a curve of `velocity_curve` with a name says: light, firm …
curve PIECE SOFTEST LOUDEST BEND    or as one by its numbers says
note NUMBER PAD               the note is that pad, such as tom_1/rim
"""

from collections.abc import Callable
from dataclasses import replace
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.pieces import Piece, word
from station.core.units import ns_from_ms
from station.devices.mapping.device_map import Crosstalk, DeviceMap, Pad
from station.devices.mapping.velocity_curve import (
    LEAST_SPAN,
    LOUDEST_FROM,
    LOUDEST_TO,
    MOST_BEND,
    SHAPES,
    SOFTEST_FROM,
    SOFTEST_TO,
    VelocityCurve,
)
from station.devices.wizard.one_hit import taught
from station.devices.wizard.pad_choices import pad_named

USAGE = (
    "threshold PIECE VELOCITY | mask PIECE MS | ghost SOURCE VICTIM SHARE | travel OPENNESS | grab VELOCITY"
    " | curve PIECE SHAPE or SOFTEST LOUDEST BEND | note NUMBER PAD"
)
_PIECES = {word(piece): piece for piece in Piece}
_LONGEST_MASK_MS = 100.0


def obey(kit: DeviceMap, line: str) -> DeviceMap:
    """The kit as `line` wants it; raises `BadInput` that says what is expected."""
    name, *words = line.split() or [""]
    order = _ORDERS.get(name)
    if order is None or len(words) not in order[0]:
        raise BadInput(line, "", f"expected {USAGE}")
    return order[1](kit, words)


def _threshold(kit: DeviceMap, words: list[str]) -> DeviceMap:
    piece = _piece(words[0])
    return _with_pad(kit, piece, replace(kit.pad(piece), threshold=int(_number(words[1], 1, 127))))


def _mask(kit: DeviceMap, words: list[str]) -> DeviceMap:
    piece = _piece(words[0])
    return _with_pad(kit, piece, replace(kit.pad(piece), mask_ns=ns_from_ms(_number(words[1], 0, _LONGEST_MASK_MS))))


def _crosstalk(kit: DeviceMap, words: list[str]) -> DeviceMap:
    source, victim, share = _piece(words[0]), _piece(words[1]), _number(words[2], 0, 1)
    if source is victim:
        raise BadInput(words[1], "", "a pad is not its own crosstalk; mask is for that")
    others = [rule for rule in kit.crosstalk if (rule.source, rule.victim) != (source, victim)]
    old = next((rule for rule in kit.crosstalk if rule not in others), Crosstalk(source, victim, share))
    new = [replace(old, share=share)] if share else []
    return replace(kit, crosstalk=(*others, *new))


def _travel(kit: DeviceMap, words: list[str]) -> DeviceMap:
    return replace(kit, foot=replace(kit.foot, least_travel=_number(words[0], 0, 1)))


def _grab(kit: DeviceMap, words: list[str]) -> DeviceMap:
    return replace(kit, grab_velocity=int(_number(words[0], 0, 127)))


def _curve(kit: DeviceMap, words: list[str]) -> DeviceMap:
    piece, shape = _piece(words[0]), words[1]
    if len(words) == 2:
        if shape not in SHAPES:
            raise BadInput(shape, "", f"no such shape{did_you_mean(shape, SHAPES)}")
        return _with_pad(kit, piece, replace(kit.pad(piece), curve=SHAPES[shape]))
    softest = _number(words[1], SOFTEST_FROM, SOFTEST_TO)
    loudest = _number(words[2], max(LOUDEST_FROM, softest + LEAST_SPAN), LOUDEST_TO)
    curve = VelocityCurve(softest, loudest, _number(words[3], -MOST_BEND, MOST_BEND))
    return _with_pad(kit, piece, replace(kit.pad(piece), curve=curve))


def _note(kit: DeviceMap, words: list[str]) -> DeviceMap:
    number = _number(words[0], 0, 127)
    return taught(kit, (_ANY_CHANNEL, int(number)), pad_named(words[1]))


_ANY_CHANNEL = 1
"""A note that is no channel's own means the same on all of them."""

_ORDERS: dict[str, tuple[tuple[int, ...], Callable[[DeviceMap, list[str]], DeviceMap]]] = {
    "threshold": ((2,), _threshold),
    "mask": ((2,), _mask),
    "ghost": ((3,), _crosstalk),
    "travel": ((1,), _travel),
    "grab": ((1,), _grab),
    "curve": ((2, 4), _curve),
    "note": ((2,), _note),
}


def _with_pad(kit: DeviceMap, piece: Piece, pad: Pad) -> DeviceMap:
    return replace(kit, pads=MappingProxyType({**kit.pads, piece: pad}))


def _piece(text: str) -> Piece:
    if text not in _PIECES:
        raise BadInput(text, "", f"no such piece{did_you_mean(text, _PIECES)}")
    return _PIECES[text]


def _number(text: str, low: float, high: float) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not low <= value <= high:
        raise BadInput(text, "", f"expected a number from {low:g} to {high:g}")
    return value
