"""An air kit in the engine: bytes of a stick's sensor in, hits and sounds out, in the engine's own time."""

from math import degrees, radians

import numpy as np

from station.core.events import Hit, SensorMounted, SensorSamples, SensorStatus
from station.core.imu import STANDARD_GRAVITY_M_S2, Mounting
from station.core.pieces import Limb, Piece, Zone
from station.engine.engine import Engine
from station.engine.messages import SetAirDrums
from station.sync.air.air_zones import AIR_DEVICE, AirKit, AirZone
from station.sync.sticks import Sticks
from tests.fakes.air_stick import Stroke, play
from tests.fakes.impulse_kit import impulse_mixer

STICK = "/dev/ttyACM3"
RIGHT = Mounting(Limb.RIGHT_HAND, learnt=True)
HEADINGS = {Piece.SNARE: 0.0, Piece.HIHAT: 35.0}
KIT = AirKit(
    tuple(
        AirZone(Limb.RIGHT_HAND, piece, Zone.HEAD, radians(heading), 0.0, radians(6.0), radians(8.0))
        for piece, heading in HEADINGS.items()
    )
)


def strokes(pieces: list[Piece]) -> tuple[Stroke, ...]:
    return tuple(Stroke(0.8 + 0.5 * n, 3.5, heading_deg=HEADINGS[piece]) for n, piece in enumerate(pieces))


def lines(pieces: list[Piece]) -> list[tuple[bytes, int]]:
    """What a sensor prints while these are struck (PROTOCOLS § 4), each line with when it comes."""
    played = play(strokes(pieces), 200.0, 1.2 + 0.5 * len(pieces))
    told = []
    for sample in played.samples():
        parts = [part / STANDARD_GRAVITY_M_S2 for part in sample.acceleration_m_s2]
        parts += [degrees(part) for part in sample.rate_rad_s or ()]
        numbers = ",".join(f"{part:.4f}" for part in parts)
        told.append((f"{sample.at_ns // 1000},{numbers}\n".encode(), sample.at_ns))
    return told


def struck(engine: Engine, pieces: list[Piece], pad_at_ns: int | None = None) -> tuple[list[Hit], int]:
    """The hits in the air, and how many frames sounded; at `pad_at_ns` a kit's snare is struck."""
    engine.handle(SetAirDrums(KIT))
    engine.sensor_found(STICK, 0)
    hits: list[Hit] = []
    frames = 0
    for line, at_ns in lines(pieces):
        if pad_at_ns is not None and at_ns >= pad_at_ns:
            engine.feed("TD-17", bytes.fromhex("99 26 7f"), at_ns)
            pad_at_ns = None
        engine.feed(STICK, line, at_ns)
        frames += int(np.count_nonzero(engine.render(240, at_ns)[:, 0]))
        hits += [event for event in engine.advance(at_ns) if isinstance(event, Hit) and event.device == AIR_DEVICE]
    return hits, frames


def engine_with_a_stick() -> Engine:
    return Engine(impulse_mixer(), own_stick=lambda _: RIGHT)


def test_strokes_in_the_air_are_hits_that_sound() -> None:
    pieces = [Piece.SNARE, Piece.HIHAT, Piece.HIHAT, Piece.SNARE]
    hits, frames = struck(engine_with_a_stick(), pieces)
    assert [hit.piece for hit in hits] == pieces
    assert {hit.limb for hit in hits} == {Limb.RIGHT_HAND}
    assert frames == len(pieces)


def test_a_piece_whose_pad_is_struck_sounds_by_its_pad() -> None:
    hits, frames = struck(engine_with_a_stick(), [Piece.SNARE, Piece.HIHAT, Piece.SNARE], pad_at_ns=1_600_000_000)
    assert [hit.piece for hit in hits] == [Piece.SNARE, Piece.HIHAT]
    assert frames == 3


def test_an_unknown_hand_plays_no_air_kit() -> None:
    assert struck(Engine(impulse_mixer()), [Piece.SNARE]) == ([], 0)


def test_the_status_of_a_sensor_says_what_an_air_drummer_should_know() -> None:
    sticks, status = Sticks(), SensorStatus(0, STICK, "csv")
    assert sticks.handle(status) == [status], "who plays no air kit need know nothing of it"
    sticks.play_air(KIT)
    sticks.handle(SensorMounted(0, STICK, RIGHT))
    samples = play(strokes([Piece.SNARE]), 200.0, 1.6).samples()
    (before,) = sticks.handle(status)
    assert isinstance(before, SensorStatus)
    assert "first piece once" in before.air[0]
    for sample in samples:
        sticks.handle(SensorSamples(sample.at_ns, STICK, (sample,)))
    assert sticks.handle(status) == [status]
