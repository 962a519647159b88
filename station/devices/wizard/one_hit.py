"""A pad is learnt with one hit: which note it sent, and the kit in which that note is the pad.

Times are monotonic ns. A hit's own note is the loudest of those that came together, for a stroke may make others send.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from station.core.note_map import NoteMeaning
from station.devices.mapping.device_map import DeviceMap, Sent
from station.devices.mapping.presets import KNOWN_KITS
from station.devices.message_tokens import tokens_for
from station.devices.wizard.answers import ONE_STROKE_NS
from station.devices.wizard.pad_choices import pad_name

_NOTE_ON, _CHANNEL = 0x9, 0x0F


class PadListener:
    """What one kit sends, as far as learning a pad asks: its notes by channel, and the note of the hit awaited.

    `reports` is how the kit's bytes are read (`DeviceMap.reports`).
    """

    def __init__(self, reports: str = "") -> None:
        self._tokens = tokens_for(reports)
        self._heard: dict[Sent, int] = {}
        self._begun_ns: int | None = None
        self._loudest: tuple[int, Sent] = (0, (1, 0))
        self.awaits = False
        """Whether the next hit is to be learnt."""

    def listen(self, on: bool) -> None:
        """Await a hit from now on, or no longer."""
        self.awaits, self._begun_ns = on, None

    def feed(self, data: bytes, at_ns: int) -> None:
        """What the kit sent."""
        for message in self._tokens.feed(data):
            if message[0] >> 4 == _NOTE_ON and message[2]:
                self._note(((message[0] & _CHANNEL) + 1, message[1]), message[2], at_ns)

    def _note(self, sent: Sent, velocity: int, at_ns: int) -> None:
        self._heard[sent] = velocity
        if not self.awaits:
            return
        if self._begun_ns is None:
            self._begun_ns, self._loudest = at_ns, (velocity, sent)
        elif at_ns - self._begun_ns <= ONE_STROKE_NS and velocity > self._loudest[0]:
            self._loudest = velocity, sent

    def hit(self, now_ns: int) -> Sent | None:
        """The note of the hit that was awaited, once nothing louder can belong to it; said once."""
        if self._begun_ns is None or now_ns - self._begun_ns <= ONE_STROKE_NS:
            return None
        self.listen(on=False)
        return self._loudest[1]

    def unknown(self, kit: DeviceMap) -> list[Sent]:
        """The notes that came and of which `kit` does not know what they are, in the order in which they came."""
        return [sent for sent in self._heard if not kit.knows(*sent)]

    def is_shared(self, sent: Sent) -> bool:
        """Whether the number came on other channels too: then it is another pad there."""
        return any(number == sent[1] and channel != sent[0] for channel, number in self._heard)


def taught(kit: DeviceMap, sent: Sent, strike: NoteMeaning, is_shared: bool = False) -> DeviceMap:
    """The kit in which `sent` is `strike`: on every channel, on its own alone where the number `is_shared`."""
    own = kit if kit.base else replace(kit, base=kit.name if kit.name in KNOWN_KITS else "", port_words=())
    channels = {other: strikes for other, strikes in kit.channel_notes.items() if other != sent}
    chokes = {number: piece for number, piece in kit.choke_notes.items() if number != sent[1]}
    notes: Mapping[int, NoteMeaning] = kit.notes if is_shared else MappingProxyType({**kit.notes, sent[1]: strike})
    channels |= {sent: strike} if is_shared else {}
    return replace(own, notes=notes, channel_notes=MappingProxyType(channels), choke_notes=MappingProxyType(chokes))


def in_words(before: DeviceMap, sent: Sent, strike: NoteMeaning) -> str:
    """What learning a pad changes: which note it is, and what that meant."""
    channel, number = sent
    named = f"note {number} (channel {channel}) is the {pad_name(strike)}"
    if number in before.choke_notes:
        return f"{named} now; it was a grab before"
    if not before.knows(*sent):
        return named
    was = before.strike(*sent)
    return f"{named}, as it was" if was == strike else f"{named} now; it was the {pad_name(was)} before"
