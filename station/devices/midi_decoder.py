"""MIDI bytes to events of the drum kit: pure, no clock, no port.

A message bears the time of the piece of bytes that completed it. The hi-hat pedal (controller 4), the position
controllers and the high-resolution velocity prefix (controller 88: what the velocity is above its whole number, in
128ths) come before the note that they describe; the prefix holds for the next note on or off of its channel and no
longer. Note off, note on with velocity 0, clock, active sensing and program changes are no hits. All channels count:
modules differ in the one they use, and many drum pads can each have their own.

Sources: MIDI 1.0 Detailed Specification 4.2; MMA CA-031 (high-resolution velocity prefix); Roland MIDI implementations:
polyphonic aftertouch `An note 7F` while a cymbal is held and `00` on release, sent for bow and edge alike; VQD106 sends
aftertouch 0 before every hi-hat note, so only a value above 0 is a choke.
"""

from station.core.events import Choke, DeviceEvent, Hit, PedalMoved
from station.core.kitmap import strike_of
from station.core.pieces import CYMBALS, Piece
from station.devices.midi_tokens import MidiTokenizer
from station.devices.presets import PEDAL_CONTROLLER, KitPreset

_NOTE_OFF = 0x8
_NOTE_ON = 0x9
_POLY_AFTERTOUCH = 0xA
_CONTROL_CHANGE = 0xB
_FIRST_SYSTEM = 0xF0
_VELOCITY_PREFIX = 88
_CHANNEL = 0x0F

_GREATEST = 127
_STEPS = 128
_CHOKEABLE = CYMBALS | {Piece.HIHAT}
_CONTRADICTION = 0.75
"""Where the pedal's openness and the note's own differ by more, the note is right (our choice: Roland modules change
from the open to the closed note at about a third of the way; a controller that never moves says 0 or 1)."""


class MidiDecoder:
    """One kit's state: half messages, the pedal, the stick's position, the cymbals that are held."""

    def __init__(self, preset: KitPreset, device: str = "") -> None:
        self.preset = preset
        self.device = device
        self._tokens = MidiTokenizer()
        self._openness: float | None = None
        self._positions: dict[Piece, float] = {}
        self._held: dict[Piece, set[int]] = {}
        self._prefixes: dict[int, bytes] = {}  # high-resolution velocity prefixes that await their note, by channel
        self._controllers: dict[int, bytes] = {}  # the newest message of each controller that says how the kit stands

    def reset(self) -> None:
        """Start afresh, as after the kit was unplugged."""
        self._tokens.reset()
        self._openness = None
        self._positions.clear()
        self._held.clear()
        self._prefixes.clear()
        self._controllers.clear()

    def bequeath(self) -> bytes:
        """Bytes that bring a new decoder to this one's state, as a capture begins; lets go of held cymbals."""
        self._held.clear()
        return b"".join([*self._controllers.values(), *self._prefixes.values()]) + self._tokens.unfinished()

    def feed(self, data: bytes, at_ns: int) -> list[DeviceEvent]:
        """The events that `data`, come at `at_ns`, completes; in order, each stamped `at_ns`."""
        events: list[DeviceEvent] = []
        for message in self._tokens.feed(data):
            status = message[0]
            if status >= _FIRST_SYSTEM:
                continue
            kind = status >> 4
            if kind in (_NOTE_ON, _NOTE_OFF):
                prefix = self._prefixes.pop(status & _CHANNEL, None)
                if kind == _NOTE_ON and message[2]:
                    fraction = 0.0 if prefix is None else prefix[2] / _STEPS
                    events.append(self._hit(message[1], message[2], at_ns, fraction))
            elif kind == _CONTROL_CHANGE:
                self._take_controller(message, at_ns, events)
            elif kind == _POLY_AFTERTOUCH:
                self._take_aftertouch(message[1], message[2], at_ns, events)
        return events

    def _hit(self, note: int, velocity: int, at_ns: int, velocity_fraction: float) -> Hit:
        strike = strike_of(note, self.preset.notes)
        self._held.pop(strike.piece, None)
        openness = strike.openness
        if strike.piece is Piece.HIHAT and self._openness is not None:
            written = self._openness if openness is None else openness
            if abs(written - self._openness) <= _CONTRADICTION:
                openness = self._openness
        return Hit(
            at_ns=at_ns,
            piece=strike.piece,
            zone=strike.zone,
            velocity=velocity,
            articulation=strike.articulation,
            openness=openness,
            midi_note=note,
            position=self._positions.get(strike.piece),
            device=self.device,
            velocity_fraction=velocity_fraction,
        )

    def _take_controller(self, message: bytes, at_ns: int, events: list[DeviceEvent]) -> None:
        status, number, value = message
        if number == _VELOCITY_PREFIX:
            self._prefixes[status & _CHANNEL] = message
        elif number == PEDAL_CONTROLLER and self.preset.pedal is not None:
            self._controllers[number] = message
            openness = self.preset.pedal.openness(value)
            if openness != self._openness:
                self._openness = openness
                events.append(PedalMoved(at_ns, openness, self.device))
        elif (piece := self.preset.position_controllers.get(number)) is not None:
            self._controllers[number] = message
            self._positions[piece] = value / _GREATEST

    def _take_aftertouch(self, note: int, value: int, at_ns: int, events: list[DeviceEvent]) -> None:
        piece = strike_of(note, self.preset.notes).piece
        if piece not in _CHOKEABLE:
            return
        held = self._held.setdefault(piece, set())
        if value < self.preset.choke_from:
            held.discard(note)
            return
        if not held:
            events.append(Choke(at_ns, piece, self.device))
        held.add(note)
