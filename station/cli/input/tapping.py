"""`--tempo tap`: the tempo that is tapped on the Enter key before a session."""

from typing import Final

from station.cli.console import say
from station.cli.input.enter_keys import NextEnter, enter_keys
from station.core.errors import BadInput
from station.core.units import NS_PER_S
from station.practice.control.tap_tempo import PAUSE_NS, TapTempo

TAP: Final = "tap"
LEAST_TAPS = 4
"""Fewer say too little (our choice: a bar of four)."""
DONE_AFTER_S = 2.0
"""Whoever taps no more for so long has tapped enough (our choice: slower than 30 a minute nobody taps)."""


def tapped_tempo(beat_quarters: float) -> float:
    """The tempo in quarter notes a minute that the user taps, where a beat is `beat_quarters` long.

    Raises `BadInput` where there is nobody who taps.
    """
    say(f"tap the tempo: Enter on every beat, {LEAST_TAPS} times or more; it goes on when you stop")
    tempo_bpm = tempo_of(enter_keys()) * beat_quarters
    say(f"{tempo_bpm:.0f} quarter notes a minute")
    return tempo_bpm


def tempo_of(next_tap: NextEnter) -> float:
    """The beats a minute that the taps mean; raises `BadInput` where they end before there are enough."""
    taps, count = TapTempo(), 0
    while True:
        try:
            at_ns = next_tap(DONE_AFTER_S if count >= LEAST_TAPS else PAUSE_NS / NS_PER_S)
        except EOFError:
            raise BadInput("--tempo", TAP, f"expected {LEAST_TAPS} taps on the Enter key, found {count}") from None
        if at_ns is not None:
            taps.tap(at_ns)
            count += 1
        elif count >= LEAST_TAPS and taps.bpm is not None:
            return taps.bpm
        else:
            count = 0
