import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.midi.midi_encoder import GATE_NS
from station.engine.cue_queue import CueRun
from station.engine.engine import Engine
from station.engine.messages import CUE_DTYPE, Bus, ClickVoice, Notice, Play, SetMidiOut, Stop
from station.engine.midi_player import MidiPlayer

ZERO_NS = 7_000 * NS_PER_MS
KICK_ON, KICK_OFF, ALL_OFF = "99 24 64", "89 24 00", "b9 7b 00"


class Wire:
    """The far end of a cable: every message with nothing changed; `cut` it and sending fails."""

    def __init__(self) -> None:
        self.heard: list[str] = []
        self.is_cut = False
        self.is_closed = False

    def send(self, message: bytes) -> None:
        if self.is_cut:
            raise DeviceError("module: MIDI cannot be sent: it is unplugged")
        self.heard.append(message.hex(" "))

    def close(self) -> None:
        self.is_closed = True


def cues(*rows: tuple[int, Bus, int, int]) -> NDArray[np.void]:
    """Cues of (time in ms, bus, piece, velocity)."""
    table = np.zeros(len(rows), CUE_DTYPE)
    for index, (at_ms, bus, piece, velocity) in enumerate(rows):
        table[index] = (at_ms * NS_PER_MS, bus, piece, Zone.HEAD, 0, velocity, np.nan)
    return table


def run(*rows: tuple[int, Bus, int, int]) -> CueRun:
    return CueRun(cues(*rows))


def sent(*rows: tuple[int, Bus, int, int]) -> list[str]:
    """What goes out in 300 ms."""
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(*rows))
    player.started(ZERO_NS)
    for now_ms in range(300):
        player.advance(at(now_ms))
    return wire.heard


def kick(at_ms: int) -> tuple[int, Bus, int, int]:
    return at_ms, Bus.DEMONSTRATION, Piece.KICK, 100


def at(at_ms: float) -> int:
    return ZERO_NS + round(at_ms * NS_PER_MS)


def test_a_cue_is_sent_at_its_time_and_ended_after_its_gate() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(kick(100)))
    player.started(ZERO_NS)
    player.advance(at(99.9))
    assert wire.heard == []
    player.advance(at(100.3))
    assert wire.heard == [KICK_ON]
    player.advance(at(100) + GATE_NS)
    assert wire.heard == [KICK_ON, KICK_OFF]


def test_only_the_demonstration_is_sent() -> None:
    rows = [(0, Bus.CLICK, ClickVoice.BEAT, 90), (0, Bus.STUDENT, Piece.SNARE, 90), kick(0)]
    assert sent(*rows) == [KICK_ON, KICK_OFF]


def test_strokes_of_one_time_keep_their_order() -> None:
    rows = [(5, Bus.DEMONSTRATION, Piece.SNARE, 1), kick(5), (1, Bus.DEMONSTRATION, Piece.SNARE, 2)]
    assert sent(*rows)[:3] == ["99 26 02", "99 26 01", KICK_ON]


def test_a_cue_of_velocity_zero_chokes() -> None:
    row = (0, Bus.DEMONSTRATION, Piece.CRASH_1, 0)
    assert sent(row) == ["a9 31 7f", "a9 31 00"]


def test_a_stroke_that_is_late_is_left_out() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(kick(0), kick(100)))
    player.started(ZERO_NS)
    player.advance(at(102))
    assert wire.heard == [KICK_ON]


def test_a_note_still_ends_when_that_is_late() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(kick(0)))
    player.started(ZERO_NS)
    player.advance(at(0))
    player.advance(at(900))
    assert wire.heard == [KICK_ON, KICK_OFF]


def test_a_module_is_played_on_where_another_engine_ended() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.resume(run(kick(0), kick(100), kick(200)), ZERO_NS, at(150))
    for now_ms in range(150, 300):
        player.advance(at(now_ms))
    assert [message for message in wire.heard if message.startswith("99")] == [KICK_ON]


def test_while_the_transport_stands_nothing_is_sent() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.advance(at(0))
    player.play(run(kick(0)))
    player.started(ZERO_NS)
    player.stop()
    player.advance(at(0))
    player.stop()
    assert wire.heard == [ALL_OFF]


def test_a_cut_cable_is_told_once_and_left_alone() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(kick(0), kick(10)))
    player.started(ZERO_NS)
    wire.is_cut = True
    player.advance(at(0))
    wire.is_cut = False
    player.advance(at(10))
    assert wire.heard == []
    assert "unplugged" in str(player.fault)


@pytest.mark.parametrize("step_ms", [0.5, 3.0, 5.0])
def test_however_often_it_is_advanced_every_stroke_is_sent(step_ms: float) -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(*(kick(20 * index) for index in range(50))))
    player.started(ZERO_NS)
    for index in range(round(1200 / step_ms)):
        player.advance(at(index * step_ms))
    assert wire.heard.count(KICK_ON) == wire.heard.count(KICK_OFF) == 50


def test_a_start_that_was_stopped_before_it_took_effect_plays_nothing() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(kick(0)))
    player.stop()
    player.started(ZERO_NS)
    player.advance(at(0))
    assert wire.heard == []


# --- in the engine -----------------------------------------------------------------------------------------------


def test_the_engine_plays_the_demonstration_on_the_module() -> None:
    wire = Wire()
    engine = Engine(open_midi_out=lambda port: {"module": wire}[port])
    engine.handle(SetMidiOut("module"))
    engine.advance(0)
    engine.handle(Play(cues(kick(100), kick(200)), start_in_ns=50 * NS_PER_MS))
    times_ms = []
    for now_ms in range(400):
        before = len(wire.heard)
        engine.advance(now_ms * NS_PER_MS)
        times_ms += [now_ms for message in wire.heard[before:] if message.startswith("99")]
    assert times_ms == [150, 250]
    engine.handle(SetMidiOut(None))
    assert wire.is_closed


def test_an_output_that_is_missing_or_cut_is_told() -> None:
    def refuse(port: str) -> Wire:
        raise DeviceError(f"no MIDI output is called {port!r}; there are none")

    engine = Engine(open_midi_out=refuse)
    engine.handle(SetMidiOut("module"))
    assert any(isinstance(event, Notice) and "'module'" in event.text for event in engine.advance(0))

    wire = Wire()
    engine = Engine(open_midi_out=lambda _: wire)
    engine.handle(SetMidiOut("module"))
    engine.handle(Play(cues(kick(0), kick(100)), start_in_ns=0))
    wire.is_cut = True
    told = [event for now_ms in range(200) for event in engine.advance(now_ms * NS_PER_MS)]
    assert sum(isinstance(event, Notice) and "unplugged" in event.text for event in told) == 1


def test_stopping_the_transport_ends_what_sounds() -> None:
    wire = Wire()
    engine = Engine(open_midi_out=lambda _: wire)
    engine.handle(SetMidiOut("module"))
    engine.handle(Play(cues(kick(0), kick(100)), start_in_ns=0))
    engine.advance(1)
    engine.handle(Stop())
    engine.advance(200 * NS_PER_MS)
    assert wire.heard == [KICK_ON, ALL_OFF]


def test_a_start_that_was_stopped_before_it_took_effect_leaves_the_next_its_own_time() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(kick(0)))
    player.stop()
    player.play(run(kick(100)))
    player.started(at(-50))  # the sound takes the two starts in their order
    player.started(ZERO_NS)
    player.advance(at(99))
    assert wire.heard == []
    player.advance(at(100))
    assert wire.heard == [KICK_ON]


def test_added_cues_are_sent_with_those_that_play_and_with_a_start_that_is_awaited() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.add(run(kick(5)))  # nothing plays: it is dropped
    player.play(run(kick(100)))
    player.add(run(kick(20)))
    player.started(ZERO_NS)
    player.advance(at(20))
    assert wire.heard == [KICK_ON]
    player.add(run(kick(60)))
    for now_ms in range(21, 150):
        player.advance(at(now_ms))
    assert wire.heard.count(KICK_ON) == 3


def test_cues_added_after_a_stop_are_of_no_start() -> None:
    wire = Wire()
    player = MidiPlayer(wire)
    player.play(run(kick(0)))
    player.stop()
    player.add(run(kick(0)))
    player.started(ZERO_NS)
    player.advance(at(50))
    assert KICK_ON not in wire.heard
