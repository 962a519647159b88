"""`station devices learn --pad PAD` and `--touch PIECE`: one pad with one hit, or its ghosts and accents.

The same desk as the window's page; what was learnt is kept at once.
"""

import argparse
from collections.abc import Callable
from pathlib import Path

from station.app.mapping_editor import MappingEditor
from station.cli.console import say
from station.cli.device_listening import listening, polls
from station.core.clock import monotonic_ns
from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.events import DeviceFound, DeviceLost
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece, word
from station.devices.mapping.device_file import own_kit_path
from station.devices.port_watch import PortPoll
from station.devices.wizard.pad_choices import PADS, pad_named
from station.engine.messages import RawBytes

_PIECES = {word(piece): piece for piece in PADS}


def add_pad_options(parser: argparse.ArgumentParser) -> None:
    """Add what asks for one pad alone."""
    one = parser.add_mutually_exclusive_group()
    one.add_argument(
        "--pad", type=_pad, metavar="PAD", help="learn one pad with one hit: kick, snare/rim_shot, tom_1/rim, ride/bell"
    )
    one.add_argument(
        "--touch", type=_piece, metavar="PIECE", help="learn a pad's velocity curve from five ghosts and five accents"
    )


def _pad(text: str) -> NoteMeaning:
    try:
        return pad_named(text)
    except BadInput as fault:
        raise argparse.ArgumentTypeError(str(fault)) from None


def _piece(text: str) -> Piece:
    if text not in _PIECES:
        raise argparse.ArgumentTypeError(f"{text}: no such piece{did_you_mean(text, _PIECES)}")
    return _PIECES[text]


def learn_one(arguments: argparse.Namespace) -> int:
    """Learn what the options ask for from the first kit that is found."""

    def begin(desk: MappingEditor) -> None:
        if arguments.pad is not None:
            desk.learn_pad(arguments.pad)
        else:
            desk.learn_touch(arguments.touch)

    page = OnePadPage(begin)
    with listening(arguments) as kits:
        for findings in polls(kits, arguments.seconds):
            page.take(findings)
            page.advance(monotonic_ns())
            if page.over:
                break
    say(f"kept in {page.kept}; practice uses it from now on" if page.over else "nothing was kept")
    return 0


class OnePadPage:
    """The first kit that is found, and what is learnt of it; `begin` asks its desk."""

    def __init__(self, begin: Callable[[MappingEditor], None]) -> None:
        self._begin = begin
        self._desk = MappingEditor(lambda _: None)
        self._shown = ""

    @property
    def kept(self) -> Path:
        """Where the kit's own file is."""
        return own_kit_path(self._desk.device)

    @property
    def over(self) -> bool:
        """Whether something was learnt and kept."""
        return bool(self._desk.device) and self._desk.can_undo

    def take(self, findings: PortPoll) -> None:
        """What the kit brought; another kit than the first is not listened to."""
        desk, device = self._desk, findings.device
        if findings.found and not desk.device:
            desk.take(DeviceFound(monotonic_ns(), device))
            say(f"{device} is here, understood as {desk.kit.title}")
            self._begin(desk)
        if device != desk.device:
            return
        for packet in findings.packets:
            desk.take(RawBytes(packet.at_ns, device, packet.data))
        if findings.lost:
            desk.take(DeviceLost(monotonic_ns(), device))
            say(f"{device} is gone; plug it in again")

    def advance(self, now_ns: int) -> None:
        """Say what is asked and what was learnt; ask once more where it could not be."""
        desk = self._desk
        if not desk.device:
            return
        desk.advance(now_ns)
        if desk.learnt:
            print(desk.learnt, flush=True)
        if not desk.learns and not self.over:
            self._begin(desk)
        if desk.asks and desk.asks != self._shown:
            self._shown = desk.asks
            print(desk.asks, flush=True)
