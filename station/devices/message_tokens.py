"""A kit's bytes as MIDI messages, whatever it speaks: for those who learn which note a pad sends."""

from typing import Protocol

from station.devices.hid.hid_decoder import ReportMessages
from station.devices.midi.midi_tokens import MidiTokenizer


class MessageTokens(Protocol):
    """Bytes in, whole messages out."""

    def feed(self, data: bytes) -> list[bytes]:
        """The messages that `data` completes, in order."""
        ...


def tokens_for(reports: str) -> MessageTokens:
    """What reads the bytes of a kit whose `DeviceMap.reports` are these, empty for MIDI."""
    return ReportMessages(reports) if reports else MidiTokenizer()
