"""The sounds that a drum kit can make, which of them a stroke asks for, and what stands in for one that a kit lacks.

A hi-hat's sound depends on how far it is open (0 closed … 1 open); `HIHAT_STEPS` are the openings that a kit has sounds
for. A cymbal struck on its bow with the tip is darker than on its edge with the shank: `timbre` says how much, as a
factor on the velocity that chooses the layer (the level keeps the true velocity).
"""

from collections.abc import Callable, Mapping
from enum import StrEnum, auto
from types import MappingProxyType
from typing import NamedTuple

from station.core.note_map import NoteMeaning
from station.core.pieces import TOMS, Articulation, Piece, Zone


class SoundName(StrEnum):
    """One sound of a kit."""

    KICK = auto()
    SNARE = auto()
    SNARE_RIM_SHOT = auto()
    SNARE_CROSS_STICK = auto()
    SNARE_BUZZ = auto()
    TOM_1 = auto()
    TOM_2 = auto()
    TOM_3 = auto()
    TOM_4 = auto()
    FLOOR_TOM_1 = auto()
    FLOOR_TOM_2 = auto()
    TOM_1_RIM = auto()
    TOM_2_RIM = auto()
    TOM_3_RIM = auto()
    TOM_4_RIM = auto()
    FLOOR_TOM_1_RIM = auto()
    FLOOR_TOM_2_RIM = auto()
    HIHAT_CLOSED = auto()
    HIHAT_LOOSE = auto()
    HIHAT_HALF = auto()
    HIHAT_WIDE = auto()
    HIHAT_OPEN = auto()
    HIHAT_CHICK = auto()
    HIHAT_FOOT_SPLASH = auto()
    CRASH_1 = auto()
    CRASH_2 = auto()
    SPLASH = auto()
    CHINA = auto()
    RIDE_BOW = auto()
    RIDE_BELL = auto()
    RIDE_EDGE = auto()
    RIDE_2 = auto()
    COWBELL = auto()
    TAMBOURINE = auto()
    CLAP = auto()
    PERCUSSION = auto()


class SoundChoice(NamedTuple):
    """Which sound a stroke asks for, and the factor on the velocity that chooses its layer."""

    sound: SoundName
    timbre: float = 1.0


HIHAT_STEPS = (
    SoundName.HIHAT_CLOSED,
    SoundName.HIHAT_LOOSE,
    SoundName.HIHAT_HALF,
    SoundName.HIHAT_WIDE,
    SoundName.HIHAT_OPEN,
)
"""The hi-hat's sounds from openness 0 to 1 in equal steps."""

TIP_TIMBRE = 0.75
"""Our choice: the stick's tip on a bow sounds as a stroke of three quarters the velocity does on the edge."""

SUBSTITUTES: Mapping[SoundName, tuple[SoundName, ...]] = MappingProxyType(
    {
        SoundName.SNARE_RIM_SHOT: (SoundName.SNARE,),
        SoundName.SNARE_CROSS_STICK: (SoundName.SNARE_RIM_SHOT, SoundName.SNARE),
        SoundName.SNARE_BUZZ: (SoundName.SNARE,),
        SoundName.TOM_1: (SoundName.TOM_2, SoundName.TOM_3, SoundName.FLOOR_TOM_1),
        SoundName.TOM_2: (SoundName.TOM_1, SoundName.TOM_3, SoundName.FLOOR_TOM_1),
        SoundName.TOM_3: (SoundName.TOM_2, SoundName.TOM_4, SoundName.FLOOR_TOM_1, SoundName.TOM_1),
        SoundName.TOM_4: (SoundName.TOM_3, SoundName.FLOOR_TOM_1, SoundName.TOM_2, SoundName.TOM_1),
        SoundName.FLOOR_TOM_1: (SoundName.FLOOR_TOM_2, SoundName.TOM_4, SoundName.TOM_3, SoundName.TOM_2),
        SoundName.FLOOR_TOM_2: (SoundName.FLOOR_TOM_1, SoundName.TOM_4, SoundName.TOM_3, SoundName.TOM_2),
        SoundName.TOM_1_RIM: (SoundName.TOM_2_RIM, SoundName.SNARE_CROSS_STICK, SoundName.TOM_1),
        SoundName.TOM_2_RIM: (SoundName.TOM_1_RIM, SoundName.SNARE_CROSS_STICK, SoundName.TOM_2),
        SoundName.TOM_3_RIM: (SoundName.TOM_2_RIM, SoundName.TOM_1_RIM, SoundName.SNARE_CROSS_STICK, SoundName.TOM_3),
        SoundName.TOM_4_RIM: (SoundName.TOM_3_RIM, SoundName.TOM_1_RIM, SoundName.SNARE_CROSS_STICK, SoundName.TOM_4),
        SoundName.FLOOR_TOM_1_RIM: (SoundName.TOM_1_RIM, SoundName.SNARE_CROSS_STICK, SoundName.FLOOR_TOM_1),
        SoundName.FLOOR_TOM_2_RIM: (SoundName.FLOOR_TOM_1_RIM, SoundName.SNARE_CROSS_STICK, SoundName.FLOOR_TOM_2),
        SoundName.HIHAT_LOOSE: (SoundName.HIHAT_CLOSED, SoundName.HIHAT_HALF),
        SoundName.HIHAT_HALF: (SoundName.HIHAT_OPEN, SoundName.HIHAT_LOOSE, SoundName.HIHAT_CLOSED),
        SoundName.HIHAT_WIDE: (SoundName.HIHAT_OPEN, SoundName.HIHAT_HALF, SoundName.HIHAT_CLOSED),
        SoundName.HIHAT_OPEN: (SoundName.HIHAT_WIDE, SoundName.HIHAT_HALF, SoundName.HIHAT_CLOSED),
        SoundName.HIHAT_CHICK: (SoundName.HIHAT_CLOSED,),
        SoundName.HIHAT_FOOT_SPLASH: (SoundName.HIHAT_OPEN, SoundName.HIHAT_HALF, SoundName.HIHAT_CHICK),
        SoundName.CRASH_1: (SoundName.CRASH_2, SoundName.RIDE_EDGE, SoundName.RIDE_BOW),
        SoundName.CRASH_2: (SoundName.CRASH_1, SoundName.RIDE_EDGE, SoundName.RIDE_BOW),
        SoundName.SPLASH: (SoundName.CRASH_2, SoundName.CRASH_1),
        SoundName.CHINA: (SoundName.CRASH_2, SoundName.CRASH_1),
        SoundName.RIDE_BOW: (SoundName.RIDE_2, SoundName.CRASH_1),
        SoundName.RIDE_BELL: (SoundName.RIDE_BOW, SoundName.COWBELL),
        SoundName.RIDE_EDGE: (SoundName.CRASH_1, SoundName.RIDE_BOW),
        SoundName.RIDE_2: (SoundName.RIDE_BOW,),
        SoundName.COWBELL: (SoundName.RIDE_BELL, SoundName.PERCUSSION),
        SoundName.TAMBOURINE: (SoundName.HIHAT_LOOSE, SoundName.PERCUSSION),
        SoundName.CLAP: (SoundName.SNARE_CROSS_STICK, SoundName.PERCUSSION),
        SoundName.PERCUSSION: (SoundName.COWBELL, SoundName.SNARE_CROSS_STICK),
    }
)
"""What a drummer would reach for instead, best first. Kick, snare and closed hi-hat have none: every kit has them."""

_CRASHES = MappingProxyType(
    {
        Piece.CRASH_1: SoundName.CRASH_1,
        Piece.CRASH_2: SoundName.CRASH_2,
        Piece.SPLASH: SoundName.SPLASH,
        Piece.CHINA: SoundName.CHINA,
        Piece.RIDE_2: SoundName.RIDE_2,
    }
)
_RIDE = MappingProxyType({Zone.BELL: SoundName.RIDE_BELL, Zone.EDGE: SoundName.RIDE_EDGE})
_SNARE = MappingProxyType(
    {
        Articulation.CROSS_STICK: SoundName.SNARE_CROSS_STICK,
        Articulation.RIM_SHOT: SoundName.SNARE_RIM_SHOT,
        Articulation.BUZZ: SoundName.SNARE_BUZZ,
    }
)


def choose_sound(strike: NoteMeaning) -> SoundChoice:
    """The sound that a stroke asks for; every piece, zone and articulation has one.

    A zone that a piece does not have counts as its plain one, a hi-hat of unknown openness as closed.
    """
    if strike.piece in _SPECIAL:
        return _SPECIAL[strike.piece](strike)
    if strike.piece in _CRASHES:
        return SoundChoice(_CRASHES[strike.piece], TIP_TIMBRE if strike.zone is Zone.BOW else 1.0)
    on_rim = strike.piece in TOMS and strike.zone is Zone.RIM
    return SoundChoice(SoundName[f"{strike.piece.name}_RIM" if on_rim else strike.piece.name])


def _snare(strike: NoteMeaning) -> SoundChoice:
    plain = SoundName.SNARE_RIM_SHOT if strike.zone is Zone.RIM else SoundName.SNARE
    return SoundChoice(_SNARE.get(strike.articulation, plain))


def _hihat(strike: NoteMeaning) -> SoundChoice:
    step = HIHAT_STEPS[hihat_step(strike.openness or 0.0)]
    return SoundChoice(step, 1.0 if strike.zone is Zone.EDGE else TIP_TIMBRE)


def _hihat_pedal(strike: NoteMeaning) -> SoundChoice:
    splashes = strike.articulation is Articulation.SPLASH
    return SoundChoice(SoundName.HIHAT_FOOT_SPLASH if splashes else SoundName.HIHAT_CHICK)


def _ride(strike: NoteMeaning) -> SoundChoice:
    return SoundChoice(_RIDE.get(strike.zone, SoundName.RIDE_BOW))


_SPECIAL: Mapping[Piece, Callable[[NoteMeaning], SoundChoice]] = MappingProxyType(
    {Piece.SNARE: _snare, Piece.HIHAT: _hihat, Piece.HIHAT_PEDAL: _hihat_pedal, Piece.RIDE: _ride}
)


def strike_of_sound(sound: SoundName) -> NoteMeaning:
    """The plainest stroke that asks for `sound`."""
    return _STRIKES[sound]


def _of_piece(piece: Piece) -> NoteMeaning:
    return NoteMeaning(piece, Zone.EDGE if piece in _CRASHES and piece is not Piece.RIDE_2 else Zone.HEAD)


_STRIKES: Mapping[SoundName, NoteMeaning] = MappingProxyType(
    {
        **{SoundName[p.name]: _of_piece(p) for p in Piece if p.name in SoundName.__members__},
        **{SoundName[f"{p.name}_RIM"]: NoteMeaning(p, Zone.RIM) for p in TOMS},
        **{
            step: NoteMeaning(Piece.HIHAT, Zone.BOW, openness=i / (len(HIHAT_STEPS) - 1))
            for i, step in enumerate(HIHAT_STEPS)
        },
        SoundName.SNARE_RIM_SHOT: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
        SoundName.SNARE_CROSS_STICK: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
        SoundName.SNARE_BUZZ: NoteMeaning(Piece.SNARE, Zone.HEAD, Articulation.BUZZ),
        SoundName.HIHAT_CHICK: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0),
        SoundName.HIHAT_FOOT_SPLASH: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, 1.0),
        SoundName.RIDE_BOW: NoteMeaning(Piece.RIDE, Zone.BOW),
        SoundName.RIDE_BELL: NoteMeaning(Piece.RIDE, Zone.BELL),
        SoundName.RIDE_EDGE: NoteMeaning(Piece.RIDE, Zone.EDGE),
        SoundName.RIDE_2: NoteMeaning(Piece.RIDE_2, Zone.BOW),
    }
)


def hihat_step(openness: float) -> int:
    """The index into `HIHAT_STEPS` nearest to `openness` (values beyond 0 … 1 are taken as the ends)."""
    last = len(HIHAT_STEPS) - 1
    return min(last, max(0, round(openness * last)))
