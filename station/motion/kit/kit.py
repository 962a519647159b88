"""The drum kit: its pieces, its pedals, which piece stands in for one that it lacks, and its TOML file.

A file holds `title`, `handed` ("right" or "left"), `seat_m`, the tables `pedals.kick` and `pedals.hihat`, and a table
for each piece, named as `core.pieces` names it. Angles are degrees in the file. Every fault is named by its key;
`station/motion/data/kits/four_piece.toml` is a commented example.
"""

import difflib
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

import numpy as np

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, Zone, word
from station.core.toml_table import Table, find_shipped, located, read_toml, shipped
from station.motion.kit.piece import SPOTS, KitPiece, Target, ZoneSpot

KITS = Path(__file__).parents[1] / "data" / "kits"
DEFAULT_KIT = "four_piece"


@dataclass(frozen=True, slots=True)
class Pedal:
    """A footboard: its hinge under the heel, its toe end when it lies flat, and how far that is raised at rest."""

    heel_m: tuple[float, float, float]
    toe_m: tuple[float, float, float]
    raised_rad: float

    @property
    def mirrored(self) -> "Pedal":
        """The pedal on the other side."""
        (heel_x, *heel), (toe_x, *toe) = self.heel_m, self.toe_m
        return replace(self, heel_m=(-heel_x, heel[0], heel[1]), toe_m=(-toe_x, toe[0], toe[1]))


_SUBSTITUTES: Mapping[Piece, tuple[Piece, ...]] = MappingProxyType(
    {
        Piece.CRASH_1: (Piece.CRASH_2, Piece.CHINA, Piece.RIDE),
        Piece.CRASH_2: (Piece.CRASH_1, Piece.CHINA, Piece.RIDE),
        Piece.SPLASH: (Piece.CRASH_1, Piece.CRASH_2, Piece.RIDE),
        Piece.CHINA: (Piece.CRASH_2, Piece.CRASH_1, Piece.RIDE),
        Piece.RIDE: (Piece.RIDE_2, Piece.CRASH_2, Piece.CRASH_1, Piece.HIHAT),
        Piece.RIDE_2: (Piece.RIDE, Piece.CRASH_2, Piece.CRASH_1, Piece.HIHAT),
        Piece.HIHAT: (Piece.RIDE, Piece.CRASH_1),
        Piece.TOM_1: (Piece.TOM_2, Piece.TOM_3, Piece.TOM_4, Piece.FLOOR_TOM_1, Piece.SNARE),
        Piece.TOM_2: (Piece.TOM_1, Piece.TOM_3, Piece.TOM_4, Piece.FLOOR_TOM_1, Piece.SNARE),
        Piece.TOM_3: (Piece.TOM_2, Piece.TOM_4, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.SNARE),
        Piece.TOM_4: (Piece.TOM_3, Piece.FLOOR_TOM_1, Piece.TOM_2, Piece.TOM_1, Piece.SNARE),
        Piece.FLOOR_TOM_1: (Piece.FLOOR_TOM_2, Piece.TOM_4, Piece.TOM_3, Piece.TOM_2, Piece.TOM_1, Piece.SNARE),
        Piece.FLOOR_TOM_2: (Piece.FLOOR_TOM_1, Piece.TOM_4, Piece.TOM_3, Piece.TOM_2, Piece.TOM_1, Piece.SNARE),
        Piece.COWBELL: (Piece.RIDE, Piece.HIHAT),
        Piece.TAMBOURINE: (Piece.HIHAT, Piece.RIDE),
        Piece.CLAP: (Piece.SNARE,),
        Piece.PERCUSSION: (Piece.RIDE, Piece.HIHAT, Piece.CRASH_1),
        Piece.SNARE: (Piece.TOM_1,),
    }
)
"""Which piece stands in for one that the kit lacks, best first: its like, then its neighbour (our choice)."""


@dataclass(frozen=True)
class Kit:
    """All pieces of a kit and its pedals; `left_handed` kits lead with the left hand."""

    name: str
    title: str
    left_handed: bool
    seat_m: tuple[float, float, float]
    pieces: Mapping[Piece, KitPiece]
    pedals: Mapping[Piece, Pedal]

    def stand_in(self, piece: Piece) -> Piece:
        """`piece` if this kit has it, else the piece that is played in its place."""
        played = Piece.HIHAT if piece is Piece.HIHAT_PEDAL else piece
        if played in self.pieces:
            return played
        return next((p for p in _SUBSTITUTES.get(played, ()) if p in self.pieces), next(iter(self.pieces)))

    @cached_property
    def stand_in_table(self) -> tuple[Piece, ...]:
        """`stand_in` of every piece, by its number."""
        return tuple(self.stand_in(p) for p in sorted(Piece))

    @property
    def mirrored(self) -> "Kit":
        """The same kit built for the other hand: left and right change places."""
        x, y, z = self.seat_m
        return replace(
            self,
            left_handed=not self.left_handed,
            seat_m=(-x, y, z),
            pieces=MappingProxyType({name: piece.mirrored for name, piece in self.pieces.items()}),
            pedals=MappingProxyType({name: pedal.mirrored for name, pedal in self.pedals.items()}),
        )

    def target(self, piece: Piece, zone: Zone, limb: Limb) -> Target:
        """The point that `limb` aims at for `zone` of `piece`, on the piece that stands in for it if need be."""
        return self.pieces[self.stand_in(piece)].target(zone, limb)


_PIECES = {word(p): p for p in Piece}
_ZONES = {word(z): z for z in Zone}
_PIECE_KEYS = {
    "radius_m": "radius_m",
    "depth_m": "depth_m",
    "tilt_x_deg": "tilt_x_rad",
    "tilt_y_deg": "tilt_y_rad",
    "wrist_radius_m": "wrist_radius_m",
    "wrist_height_m": "wrist_height_m",
}
_MAX_TILT_DEG = 80.0
_LEAST_APART_M, _MOST_INSIDE_M = 0.04, 0.03
"""Nearer centres, or a surface deeper in another's shell, are no kit that stands (our choice; hoops may touch)."""
_LEAST_BOARD_M = 0.1
"""A shorter footboard points nowhere (our choice; real ones are 25–33 cm long)."""


_ASIDE_M = 0.4
"""A piece so far to a side has rim and edge struck on the player's side; one in the middle, in front (our choice)."""


def kit_names() -> list[str]:
    """The kits that ship with the station."""
    return shipped(KITS)


def load_kit(name_or_path: str | Path = DEFAULT_KIT) -> Kit:
    """A shipped kit by its name, or a kit file; raises `BadInput` with the place of the first fault."""
    path = find_shipped(name_or_path, KITS, "kit")
    with located(path):
        return _kit(read_toml(path), path)


def _kit(raw: Mapping[str, object], source: Path) -> Kit:
    top = Table(raw, source, "")
    handed = top.word("handed", ("right", "left"), "right")
    pedals = top.table("pedals")
    named = {key: _piece(Table(top.raw[key], source, key), key) for key in raw if key in _PIECES}
    unknown = set(raw) - set(named) - {"title", "handed", "seat_m", "pedals"}
    if unknown:
        key = min(unknown)
        near = difflib.get_close_matches(key, [*_PIECES, "title", "handed", "seat_m", "pedals"], n=1)
        raise BadInput(source, key, "no such piece or key" + (f"; meant {near[0]}?" if near else ""))
    for needed in ("kick", "snare"):
        if needed not in named:
            raise BadInput(source, "", f"a kit needs a {needed}")
    _apart(list(named.values()), source)
    return Kit(
        name=source.stem,
        title=str(raw.get("title", source.stem)),
        left_handed=handed == "left",
        seat_m=top.point("seat_m", (0.0, 0.0, 0.5)),
        pieces=MappingProxyType({_PIECES[key]: piece for key, piece in named.items()}),
        pedals=MappingProxyType(
            {
                Piece.KICK: _pedal(pedals.table("kick")),
                Piece.HIHAT_PEDAL: _pedal(pedals.table("hihat")),
            }
        ),
    )


def _apart(pieces: list[KitPiece], source: Path) -> None:
    """Refuse pieces in one place, or of which one's head or bow is inside another's shell."""
    for k, one in enumerate(pieces):
        for other in pieces[:k]:
            apart_m = math.dist(one.centre_m, other.centre_m)
            deep_m = max(_inside_m(one, other), _inside_m(other, one))
            if apart_m < _LEAST_APART_M or deep_m > _MOST_INSIDE_M:
                how = f"{100 * deep_m:.0f} cm deep" if deep_m > _MOST_INSIDE_M else "their centres are in one place"
                fault = f"overlaps the {word(other.piece)}: {how}"
                raise BadInput(source, f"{word(one.piece)}.centre_m", fault)


def _inside_m(one: KitPiece, other: KitPiece) -> float:
    """How deep the struck surface of `one` is in the shell of `other`, negative outside."""
    around = np.linspace(0.0, 2 * math.pi, 24, endpoint=False)
    right, away, _ = one.axes
    edge = one.centre + one.radius_m * (np.cos(around)[:, None] * right + np.sin(around)[:, None] * away)
    off = np.vstack((one.centre, edge)) - other.centre
    height = off @ other.normal
    radial = np.sqrt(np.maximum((off**2).sum(1) - height**2, 0.0))
    return float(np.minimum(np.minimum(-height, height + other.depth_m), other.radius_m - radial).max())


def _piece(table: "Table", name: str) -> KitPiece:
    kind = table.word("kind", tuple(SPOTS), "drum")
    table.only({"kind", "centre_m", "zones", *_PIECE_KEYS})
    piece = KitPiece(
        piece=_PIECES[name],
        kind=kind,
        centre_m=table.point("centre_m"),
        radius_m=table.number("radius_m", 0.02, 1.0),
        depth_m=table.number("depth_m", 0.0, 1.0, 0.02),
        tilt_x_rad=math.radians(table.number("tilt_x_deg", -_MAX_TILT_DEG, _MAX_TILT_DEG, 0.0)),
        tilt_y_rad=math.radians(table.number("tilt_y_deg", -_MAX_TILT_DEG, _MAX_TILT_DEG, 0.0)),
        wrist_radius_m=table.number("wrist_radius_m", 0.05, 1.0, 0.40),
        wrist_height_m=table.number("wrist_height_m", -0.5, 0.5, 0.06),
    )
    return replace(piece, spots=MappingProxyType(_spots(table, piece)))


def _spots(table: "Table", piece: KitPiece) -> dict[Zone, ZoneSpot]:
    inward = max(-1.0, min(1.0, -piece.centre_m[0] / _ASIDE_M))
    spots = {zone: replace(spot, right=inward * spot.right) for zone, spot in SPOTS[piece.kind].items()}
    zones = table.table("zones", {})
    for key in zones.raw:
        if key not in _ZONES:
            raise BadInput(table.source, f"{zones.place}.{key}", f"no such zone; there are {', '.join(_ZONES)}")
        spots[_ZONES[key]] = _spot(zones.table(key), spots.get(_ZONES[key], ZoneSpot(0.0, 0.0)))
    return spots


def _spot(table: "Table", default: ZoneSpot) -> ZoneSpot:
    table.only({f.name for f in fields(ZoneSpot)})
    with_shoulder = replace(default, shoulder=table.flag("shoulder", default.shoulder))
    numbers: dict[str, float] = {key: table.number(key, -1.0, 1.0) for key in table.raw if key != "shoulder"}
    return replace(with_shoulder, **numbers)  # type: ignore[arg-type] # the one key that is no number was taken out


def _pedal(table: "Table") -> Pedal:
    table.only({"heel_m", "toe_m", "raised_deg"})
    heel_m, toe_m = table.point("heel_m"), table.point("toe_m")
    if math.dist(heel_m, toe_m) < _LEAST_BOARD_M:
        fault = f"the toe end is {math.dist(heel_m, toe_m):.2f} m from the heel, expected at least {_LEAST_BOARD_M:g} m"
        raise BadInput(table.source, f"{table.place}.toe_m", fault)
    return Pedal(
        heel_m=heel_m,
        toe_m=toe_m,
        raised_rad=math.radians(table.number("raised_deg", 0.0, 60.0, 18.0)),
    )
