"""MIDI bytes to events of the drum kit: pure, no clock, no port.

A message bears the time of the piece of bytes that completed it. The pedal's controller, the position controllers
and the high-resolution velocity prefix (controller 88: what the velocity is above its whole number, in 128ths) come
before the note that they describe. A position is that of the next stroke on its piece alone, the prefix holds for the
next note on or off of its channel and no longer. Note off, note on with velocity 0, clock and active sensing are
nothing. A program, and a controller of no other meaning at 64 or more, is a switch that is pressed. All channels
count: modules differ in the one they use, and many drum pads can each have their own.

Sources: MIDI 1.0 Detailed Specification 4.2; MMA CA-031 (high-resolution velocity prefix); Roland MIDI implementations:
polyphonic aftertouch `An note 7F` while a cymbal is held and `00` on release, sent for bow and edge alike; VQD106 sends
aftertouch 0 before every hi-hat note, so only a value above 0 is a choke. Position: every snare note of a TD-11 in the
Groove MIDI Dataset has its own, just before it.
"""

from station.core.events import Choke, DeviceEvent, Hit, Switched
from station.core.pieces import CHOKEABLE, Piece
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.hihat_pedal import Hihat
from station.devices.midi.midi_tokens import MidiTokenizer

_NOTE_OFF = 0x8
_NOTE_ON = 0x9
_POLY_AFTERTOUCH = 0xA
_CONTROL_CHANGE = 0xB
_PROGRAM_CHANGE = 0xC
_FIRST_SYSTEM = 0xF0
_VELOCITY_PREFIX = 88
_ON = 64
"""From here on a switch is on (MIDI 1.0 Detailed Specification: 0 to 63 off, 64 to 127 on)."""
_CHANNEL = 0x0F

_GREATEST = 127
_STEPS = 128
_MESSAGE = 3


class MidiDecoder:
    """One kit's state: half messages, the pedal, the stick's position, the cymbals that are held."""

    def __init__(self, preset: DeviceMap, device: str = "") -> None:
        self.preset = preset
        self.device = device
        self._tokens = MidiTokenizer()
        self._hihat = Hihat(preset.pedal, preset.foot, device)
        self._positions: dict[int, bytes] = {}  # the message of each controller that waits for its stroke
        self._held: dict[Piece, set[int]] = {}
        self._prefixes: dict[int, bytes] = {}  # high-resolution velocity prefixes that await their note, by channel
        self._pedal = b""  # the last two messages that moved it: how the pedal stands

    def reset(self) -> None:
        """Start afresh, as after the kit was unplugged."""
        self._tokens.reset()
        self._hihat.reset()
        self._positions.clear()
        self._held.clear()
        self._prefixes.clear()
        self._pedal = b""

    def restart_state(self) -> bytes:
        """Bytes that bring a new decoder to this one's state, as a capture begins; lets go of held cymbals."""
        self._held.clear()
        pedal = self._pedal[-_MESSAGE:] if self.preset.foot.by_controller else self._pedal  # two would be a stomp
        return b"".join((pedal, *self._positions.values(), *self._prefixes.values(), self._tokens.unfinished()))

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
                    events.append(self._note(message, at_ns, 0.0 if prefix is None else prefix[2] / _STEPS))
            elif kind == _CONTROL_CHANGE:
                self._handle_controller(message, at_ns, events)
            elif kind == _PROGRAM_CHANGE:
                events.append(Switched(at_ns, f"program={message[1]}", self.device))
            elif kind == _POLY_AFTERTOUCH:
                self._handle_aftertouch(message, at_ns, events)
        return events

    def _note(self, message: bytes, at_ns: int, velocity_fraction: float) -> Hit | Choke:
        status, note, velocity = message
        choked = self.preset.choke_notes.get(note)
        if choked is not None:
            return Choke(at_ns, choked, self.device)
        strike = self.preset.strike(_channel(status), note)
        self._held.pop(strike.piece, None)
        return Hit(
            at_ns=at_ns,
            piece=strike.piece,
            zone=strike.zone,
            velocity=velocity,
            articulation=strike.articulation,
            openness=self._hihat.openness_of(strike),
            midi_note=note,
            position=self._position(strike.piece),
            device=self.device,
            velocity_fraction=velocity_fraction,
        )

    def _position(self, piece: Piece) -> float | None:
        """Where the stroke on `piece` that now comes lands; said once."""
        for controller, message in self._positions.items():
            if piece in self.preset.position_controllers[controller]:
                del self._positions[controller]
                return message[2] / _GREATEST
        return None

    def _handle_controller(self, message: bytes, at_ns: int, events: list[DeviceEvent]) -> None:
        status, number, value = message
        if number == _VELOCITY_PREFIX:
            self._prefixes[status & _CHANNEL] = message
        elif self._hihat.listens_to(number):
            moved = self._hihat.moved(value, at_ns)
            if moved:
                self._pedal = self._pedal[-_MESSAGE:] + message
            events += moved
        elif number in self.preset.position_controllers:
            self._positions[number] = message
        elif value >= _ON:
            events.append(Switched(at_ns, f"cc={number}", self.device))

    def _handle_aftertouch(self, message: bytes, at_ns: int, events: list[DeviceEvent]) -> None:
        status, note, value = message
        piece = self.preset.strike(_channel(status), note).piece
        if piece not in CHOKEABLE:
            return
        held = self._held.setdefault(piece, set())
        if value < self.preset.choke_from:
            held.discard(note)
            return
        if not held:
            events.append(Choke(at_ns, piece, self.device))
        held.add(note)


def _channel(status: int) -> int:
    """The channel of a message, as people count them: from 1."""
    return (status & _CHANNEL) + 1
