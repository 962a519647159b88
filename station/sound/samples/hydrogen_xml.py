"""Hydrogen's `drumkit.xml` as plain values, in every form that it has had.

An instrument's layers lie in components (since 0.9.7), in the instrument itself (0.9.0 to 0.9.6), or the instrument
is a single file (before). `pan` (−1 … 1, since 1.1) was `pan_L` and `pan_R`. Tags may bear the namespace
http://www.hydrogen-music.org/drumkit or none. Source: Hydrogen's drumkit.xsd and Instrument.cpp, by their fields alone.

A kit is refused (`BadInput`, with the instrument's name and the field) where a number is none or out of the range that
makes sense, and with its line where `safe_xml` refuses it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.music.formats.safe_xml import parse_xml, text_of

MAX_INSTRUMENTS = 1000
MAX_LAYERS = 4096
"""Hydrogen's own limits are 1000 instruments of 16 layers; a file beyond ours is no kit."""


@dataclass(frozen=True, slots=True)
class HydrogenLayer:
    """A sound file for velocities `low` … `high` (0–1), its gain and its pitch in semitones."""

    filename: str
    low: float
    high: float
    gain: float
    pitch: float


@dataclass(frozen=True, slots=True)
class HydrogenComponent:
    """One microphone's layers; `takes_turns` where layers of one velocity are played in turn."""

    gain: float
    layers: tuple[HydrogenLayer, ...]
    takes_turns: bool


@dataclass(frozen=True, slots=True)
class HydrogenInstrument:
    """One instrument.

    `gain` is volume × gain, `left` and `right` the factors of its pan, `mute_group` and `hihat_group` None for none,
    `low_cc` … `high_cc` the hi-hat's openings that it is for, `attack` and `decay` in frames, `sustain` 0–1.
    """

    name: str
    kind: str
    midi_note: int | None
    gain: float
    left: float
    right: float
    mute_group: int | None
    hihat_group: int | None
    low_cc: int
    high_cc: int
    follows_velocity: bool
    attack: float
    decay: float
    sustain: float
    components: tuple[HydrogenComponent, ...]


@dataclass(frozen=True, slots=True)
class HydrogenKit:
    """A kit's name and the instruments that are not muted."""

    name: str
    instruments: tuple[HydrogenInstrument, ...]


def parse_kit(data: bytes, source: str) -> HydrogenKit:
    """The kit that `data`, a `drumkit.xml`, describes; raises `BadInput` that names it `source`."""
    root = parse_xml(data, source, ("drumkit_info",))
    instruments = [
        _Fields(node, source, f"instrument {index + 1}").instrument()
        for index, node in enumerate(_instruments(root, source))
        if text_of(node, "isMuted") != "true"
    ]
    return HydrogenKit(text_of(root, "name") or "Hydrogen", tuple(instruments))


def _instruments(root: Element, source: str) -> list[Element]:
    nodes = root.findall("instrumentList/instrument")
    layers = sum(1 for node in nodes for _ in node.iter("layer"))
    if len(nodes) > MAX_INSTRUMENTS or layers > MAX_LAYERS:
        raise BadInput(source, "", f"more than {MAX_INSTRUMENTS} instruments or {MAX_LAYERS} layers is no drum kit")
    return nodes


class _Fields:
    """Reads one instrument; every fault names it and the field."""

    def __init__(self, node: Element, source: str, place: str) -> None:
        self._node = node
        self._source = source
        name = text_of(node, "name")
        self._place = f"{place} ({name})" if name else place

    def instrument(self) -> HydrogenInstrument:
        """The instrument as plain values."""
        node = self._node
        left, right = self._pan()
        note = self._number(node, "midiOutNote", -1.0, -1.0, 1e6)
        return HydrogenInstrument(
            name=text_of(node, "name"),
            kind=text_of(node, "type"),
            midi_note=int(note) if note >= 0.0 else None,
            gain=self._number(node, "volume", 1.0, 0.0, 100.0) * self._number(node, "gain", 1.0, 0.0, 100.0),
            left=left,
            right=right,
            mute_group=self._group("muteGroup"),
            hihat_group=self._group("isHihat"),
            low_cc=int(self._number(node, "lower_cc", 0.0, 0.0, 127.0)),
            high_cc=int(self._number(node, "higher_cc", 127.0, 0.0, 127.0)),
            follows_velocity=text_of(node, "applyVelocity") != "false",
            attack=self._number(node, "Attack", 0.0, 0.0, 1e7),
            decay=self._number(node, "Decay", 0.0, 0.0, 1e7),
            sustain=self._number(node, "Sustain", 1.0, 0.0, 1.0),
            components=tuple(self._components()),
        )

    def _components(self) -> Iterator[HydrogenComponent]:
        inner = self._node.findall("instrumentComponent") or [self._node]
        for node in inner:
            layers = tuple(self._layer(layer) for layer in node.findall("layer") if text_of(layer, "isMuted") != "true")
            if node is self._node and not layers and text_of(node, "filename"):
                layers = (HydrogenLayer(text_of(node, "filename"), 0.0, 1.0, 1.0, self._pitch(node, "pitch")),)
            if not layers or (node is not self._node and text_of(node, "isMuted") == "true"):
                continue
            gain = 1.0 if node is self._node else self._number(node, "gain", 1.0, 0.0, 100.0)
            algorithm = text_of(node, "sampleSelectionAlgo") or text_of(self._node, "sampleSelectionAlgo")
            yield HydrogenComponent(gain, layers, algorithm in ("ROUND_ROBIN", "RANDOM"))

    def _layer(self, node: Element) -> HydrogenLayer:
        filename = text_of(node, "filename")
        if not filename:
            raise self._fault("filename", "a layer names no sound file")
        low = self._number(node, "min", 0.0, 0.0, 1.0)
        high = self._number(node, "max", 1.0, 0.0, 1.0)
        if low > high:
            raise self._fault("min", f"a layer reaches from {low:g} down to {high:g}")
        pitch = self._pitch(node, "pitch")
        return HydrogenLayer(filename, low, high, self._number(node, "gain", 1.0, 0.0, 100.0), pitch)

    def _pitch(self, node: Element, tag: str) -> float:
        offset = self._number(self._node, "pitchOffset", 0.0, -60.0, 60.0)
        return max(-36.0, min(36.0, offset + self._number(node, tag, 0.0, -60.0, 60.0)))

    def _pan(self) -> tuple[float, float]:
        """Factors of left and right: the far side is lowered."""
        if text_of(self._node, "pan"):
            pan = self._number(self._node, "pan", 0.0, -1.0, 1.0)
            return min(1.0, 1.0 - pan), min(1.0, 1.0 + pan)
        left = self._number(self._node, "pan_L", 1.0, 0.0, 1.0)
        right = self._number(self._node, "pan_R", 1.0, 0.0, 1.0)
        near = max(left, right)
        return (left / near, right / near) if near > 0.0 else (1.0, 1.0)

    def _group(self, tag: str) -> int | None:
        number = self._number(self._node, tag, -1.0, -1.0, 1e6)
        return int(number) if number >= 0.0 else None

    def _number(self, node: Element, tag: str, default: float, least: float, most: float) -> float:
        text = text_of(node, tag)
        if not text:
            return default
        try:
            value = float(text)
        except ValueError:
            raise self._fault(tag, f"{text[:40]!r} is no number") from None
        if not isfinite(value) or not least <= value <= most:
            raise self._fault(tag, f"expected {least:g} to {most:g}, found {value:g}")
        return value

    def _fault(self, tag: str, fault: str) -> BadInput:
        return BadInput(self._source, f"{self._place}, {tag}", fault)
