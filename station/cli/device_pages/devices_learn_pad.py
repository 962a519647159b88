"""`station devices learn --pad PAD` and `--touch PIECE`: one pad with one hit, or its ghosts and accents.

The same editor as the window's page; what was learnt is kept at once.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from station.app.equipment.mapping_editor import MappingEditor
from station.cli.console import say, write
from station.cli.device_pages.devices_learn import learn
from station.cli.input.device_listening import ListenOptions, listening, polls
from station.cli.options.option_fields import checked, one_of, option
from station.core.clock import monotonic_ns
from station.core.events import DeviceFound, DeviceLost
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece, word
from station.devices.mapping.device_file import own_kit_path
from station.devices.port_watch import PortPoll
from station.devices.wizard.pad_choices import PADS, pad_named
from station.engine.messages import RawBytes

_PIECES = {word(piece): piece for piece in PADS}


@dataclass(frozen=True, slots=True, kw_only=True)
class LearnOptions(ListenOptions):
    """What is learnt: a whole kit, or one pad alone."""

    pad: NoteMeaning | None = option(
        "PAD",
        "learn one pad with one hit: kick, snare/rim_shot, tom_1/rim, ride/bell",
        checked(pad_named),
        None,
        rivals="pad",
    )
    touch: Piece | None = option(
        "PIECE",
        "learn a pad's velocity curve from five ghosts and five accents",
        one_of(_PIECES, "piece"),
        None,
        rivals="pad",
    )


def learn_kit_or_pad(options: LearnOptions) -> int:
    """Learn what the options ask for from the first kit that is found."""
    if options.pad is not None:
        return _learn_one(options, partial(MappingEditor.learn_pad, pad=options.pad))
    if options.touch is not None:
        return _learn_one(options, partial(MappingEditor.learn_velocity, piece=options.touch))
    return learn(options)


def _learn_one(options: ListenOptions, begin: Callable[[MappingEditor], None]) -> int:
    page = OnePadPage(begin)
    with listening(options) as kits:
        for findings in polls(kits, options.seconds):
            page.handle(findings)
            page.advance(monotonic_ns())
            if page.over:
                break
    say(f"kept in {page.kept}; practice uses it from now on" if page.over else "nothing was kept")
    return 0


class OnePadPage:
    """The first kit that is found, and what is learnt of it; `begin` asks its editor."""

    def __init__(self, begin: Callable[[MappingEditor], None]) -> None:
        self._begin = begin
        self._editor = MappingEditor(lambda _: None)
        self._shown = ""

    @property
    def kept(self) -> Path:
        """Where the kit's own file is."""
        return own_kit_path(self._editor.device)

    @property
    def over(self) -> bool:
        """Whether something was learnt and kept."""
        return bool(self._editor.device) and self._editor.can_undo

    def handle(self, findings: PortPoll) -> None:
        """What the kit brought; another kit than the first is not listened to."""
        editor, device = self._editor, findings.device
        if findings.found and not editor.device:
            editor.handle(DeviceFound(monotonic_ns(), device))
            say(f"{device} is here, understood as {editor.kit.title}")
            self._begin(editor)
        if device != editor.device:
            return
        for packet in findings.packets:
            editor.handle(RawBytes(packet.at_ns, device, packet.data))
        if findings.lost:
            editor.handle(DeviceLost(monotonic_ns(), device))
            say(f"{device} is gone; plug it in again")

    def advance(self, now_ns: int) -> None:
        """Say what is asked and what was learnt; ask once more where it could not be."""
        editor = self._editor
        if not editor.device:
            return
        editor.advance(now_ns)
        if editor.learnt:
            write(editor.learnt, flush=True)
        if not editor.learns and not self.over:
            self._begin(editor)
        if editor.asks and editor.asks != self._shown:
            self._shown = editor.asks
            write(editor.asks, flush=True)
