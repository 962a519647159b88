"""What a student reads of a lag: how much, whose it is as far as anyone can tell, and what to do. Nothing of none."""

from station.core.labels import piece_name
from station.practice.lag.session_lag import LagAnswer, SessionLag
from station.scoring.analysis.device_lag import LagCause, SharedLag

_TELL = "Loopback and Strike (Devices) tell."


def lag_text(lag: SessionLag | None) -> str:
    """In one to four short sentences."""
    if lag is None or not lag.found.counts:
        return ""
    found = lag.found
    if found.cause is LagCause.TEMPO:
        return f"{_by_tempo(found, lag)} So it is a habit, and not your equipment: count the beat in halves."
    if found.cause is LagCause.PADS:
        return f"{_by_pad(found)} A habit, and not your equipment, for that is late on all pads alike."
    return f"{_everything(found)} {_upshot(found, lag.answer)}"


def _upshot(found: SharedLag, answer: LagAnswer) -> str:
    """Whose it is, and what becomes of it."""
    if answer is not LagAnswer.OPEN:
        return _ANSWERED[answer]
    if found.cause is LagCause.EQUIPMENT:
        whose = f"On all pads and at {_tempi(found)} bpm alike: most likely your equipment."
        return f"{whose} This score leaves it out; take it out for good? An even habit looks the same: {_TELL}"
    return f"Your equipment or you? This score leaves it out. {_more(found)}"


_ANSWERED = {
    LagAnswer.TAKEN_OUT: "It is taken out, of this score and from now on.",
    LagAnswer.LEFT: f"You have left it in: it counts as yours. To be sure: {_TELL}",
    LagAnswer.NONE: f"Your devices are measured, or left as they are: it counts as yours. To be sure: {_TELL}",
}


def _everything(found: SharedLag) -> str:
    late = "late" if found.lag_ms > 0 else "early"
    return f"Everything came {abs(found.lag_ms):.0f} ms {late} (±{(found.high_ms - found.low_ms) / 2:.0f})."


def _tempi(found: SharedLag) -> str:
    ends = [f"{bpm:.0f}" for bpm in (found.tempi_bpm[0], found.tempi_bpm[-1])]
    return " and ".join(dict.fromkeys(ends))


def _more(found: SharedLag) -> str:
    """What would tell more."""
    if found.rise_ms is None:
        return "Play at a clearly faster or slower tempo as well, and the station can tell more."
    return "A few more passes, and the station can tell more."


def _by_tempo(found: SharedLag, lag: SessionLag) -> str:
    late = "late" if found.lag_ms > 0 else "early"
    if found.rise_ms is None or len(lag.runs) < 2:
        return f"You are {abs(found.lag_ms):.0f} ms {late} here, and otherwise at other tempi."
    slow, fast = (key(lag.runs, key=lambda run: run.tempo_bpm) for key in (min, max))
    return (
        f"At {slow.tempo_bpm:.0f} bpm you were {abs(slow.whole.mean_ms):.0f} ms {late},"
        f" at {fast.tempo_bpm:.0f} bpm {abs(fast.whole.mean_ms):.0f}: it goes with the beat."
    )


def _by_pad(found: SharedLag) -> str:
    assert found.apart is not None, "a pad is apart"
    pad, by_ms, _, _ = found.apart
    side = "later" if by_ms > 0 else "earlier"
    return f"The {piece_name(pad)} comes {abs(by_ms):.0f} ms {side} than your other strokes."
