"""Air drumming: the sticks' motion in, hits of the device "air sticks" out.

    drums = AirDrums(kit, ahead_ns=20_000_000)
    drums.mount("stick-r", mounting)
    hits = drums.moved("stick-r", motion)

Each hand finds itself by its first stroke, which counts as one at its first zone; so again where its sensor was away. A
stroke whose zone is unclear makes no hit: it is counted. The feet have no sensors: a foot switch, a pedal or a key
plays the kick. A piece whose pad has been struck sounds by its pad alone from then on, and each such hit tells exactly
where the stick points.

A hit's time is the beat that was meant. It is told when that is certain, or up to `ahead_ns` before the beat where it
is foretold (`air_latency`): its time may then lie in the future, and it should sound at once. It is told once. Without
`ahead_ns` nothing is foretold, and times are as exact as the sensor: right for practice that is judged.
"""

from station.core.events import Hit, PhaseEstimate
from station.core.imu import Mounting
from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS
from station.sync.air.air_hand import AirCall, AirHand
from station.sync.air.air_status import AirStatus
from station.sync.air.air_zones import AIR_DEVICE, AirKit, velocity_of
from station.sync.air.zone_learning import AirAim, ZoneLearning
from station.sync.strokes.stick_orientation import StickMotion

AIR_AHEAD_NS = 20 * NS_PER_MS
"""How long before its beat a stroke in the air may sound where it is foretold; our choice: about the latency of a sound
card and a wireless sensor together."""


class AirDrums:
    """An air kit played by sticks; set `learning` to have strokes taught instead of sounded."""

    def __init__(self, kit: AirKit, ahead_ns: int | None = None) -> None:
        self.kit = kit
        self.learning: ZoneLearning | None = None
        self._ahead_ns = ahead_ns
        self._hands: dict[str, AirHand] = {}
        self._padded: set[Piece] = set()

    def use(self, kit: AirKit) -> None:
        """Plays another kit from now on, such as one just learnt; each hand finds itself anew."""
        self.kit, self.learning = kit, None
        for device, hand in self._hands.items():
            self.mount(device, hand.mounting)

    def mount(self, device: str, mounting: Mounting) -> None:
        """The sensor `device` is mounted so; one that is on no known hand's stick makes no hits."""
        self._hands[device] = AirHand(mounting, self.kit.of(mounting.limb), self._ahead_ns)

    def lost(self, device: str) -> None:
        """The sensor is gone."""
        self._hands.pop(device, None)

    def phase(self, estimate: PhaseEstimate) -> None:
        """Where the loop is that is being played."""
        for hand in self._hands.values():
            hand.phase(estimate)

    def status(self, device: str) -> AirStatus | None:
        """How the hand with that sensor does, None where there is none of that name."""
        hand = self._hands.get(device)
        return None if hand is None else hand.status()

    def words(self, device: str) -> tuple[str, ...]:
        """What the player of the hand with that sensor should know; nothing of one without zones."""
        hand = self._hands.get(device)
        return () if hand is None or not hand.tracker.zones else hand.status().sentences()

    def pad(self, hit: Hit) -> None:
        """A pad was struck; where the limb is known, its stick pointed there, whatever its heading has become."""
        if hit.device == AIR_DEVICE:
            return
        self._padded.add(hit.piece)
        for hand in self._of(hit.limb):
            aimed = (index for index, zone in enumerate(hand.tracker.zones) if zone.piece is hit.piece)
            index = next(aimed, None)
            if index is not None:
                hand.fix(hit.at_ns, index)

    def moved(self, device: str, motion: StickMotion) -> list[Hit]:
        """The hits that this sample of a stick's motion tells, mostly none."""
        hand = self._hands.get(device)
        if hand is None or not hand.mounting.limb.is_hand:
            return []
        beat = hand.feed(motion)
        if self.learning is not None:
            if beat is not None:
                aim = AirAim(beat.heading_rad, beat.elevation_rad, beat.speed_m_s)
                self.learning.strike(hand.mounting.limb, aim)
            return []
        call = hand.foretell() if beat is None else hand.settle(beat)
        return [] if call is None or call.zone.piece in self._padded else [self._hit(call)]

    def _of(self, limb: Limb) -> list[AirHand]:
        return [hand for hand in self._hands.values() if hand.mounting.limb is limb]

    def _hit(self, call: AirCall) -> Hit:
        zone, velocity = call.zone, velocity_of(call.speed_m_s, self.kit.normal_speed_m_s)
        fraction = velocity % 1.0
        return Hit(
            call.at_ns,
            zone.piece,
            zone.zone,
            int(velocity),
            limb=zone.limb,
            device=AIR_DEVICE,
            velocity_fraction=fraction,
        )
