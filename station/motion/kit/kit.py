"""The drum kit: its pieces, its pedals, which piece stands in for one that it lacks, and its TOML file.

A file holds `title`, `handed` ("right" or "left"), `make`, `finish`, `seat_m`, the tables `pedals.kick` and
`pedals.hihat`, with a double pedal `pedals.slave`, and a table for each piece, named as `core.pieces` names it. Or it
holds a `title` and which shipped kit it `mirrors`. Angles are degrees in the file. Every fault is named by its place;
`station/motion/data/kits/four_piece.toml` is a commented example.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from station.core.disk.shipped import find_shipped, shipped
from station.core.pieces import Limb, Piece, Zone
from station.core.stand_ins import stand_in
from station.core.toml.schema import (
    Field,
    Fields,
    Reader,
    flag,
    key_of,
    members_by_label,
    needed,
    number,
    one_of,
    optional,
    point,
    read,
    record,
    said,
    table_of,
    text,
)
from station.core.toml.toml_faults import wrong
from station.core.toml.toml_source import read_source
from station.motion.kit.fits import check_apart, check_boards, check_off_the_player
from station.motion.kit.piece import SPOTS, KitPiece, Target, Vector, ZoneSpot

MAKES = ("acoustic", "electronic")
FINISHES = ("teal", "maple", "black")
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


BEATERS_APART_M = 0.075
"""Between the beaters of a double pedal, whose felts are 5 cm thick (our choice)."""


@dataclass(frozen=True)
class Kit:
    """All pieces of a kit and its pedals; `left_handed` kits lead with the left hand.

    `make` is what kind of instruments they are, of `MAKES`; `finish` what the shells look like, of `FINISHES`.
    """

    name: str
    title: str
    left_handed: bool
    seat_m: tuple[float, float, float]
    pieces: Mapping[Piece, KitPiece]
    pedals: Mapping[Piece, Pedal]
    make: str = "acoustic"
    finish: str = "teal"
    slave: Pedal | None = None
    """The second board of a double pedal, which the hi-hat's foot plays."""

    @property
    def feet(self) -> tuple[Limb, Limb]:
        """The kick's foot and the hi-hat's, which also plays the slave board."""
        right, left = Limb.RIGHT_FOOT, Limb.LEFT_FOOT
        return (left, right) if self.left_handed else (right, left)

    @property
    def pedals_by_foot(self) -> tuple[Pedal, Pedal]:
        """The pedals on which the right and the left foot are at home."""
        kick, hat = self.pedals[Piece.KICK], self.pedals[Piece.HIHAT_PEDAL]
        return (hat, kick) if self.left_handed else (kick, hat)

    @property
    def pulled_hat(self) -> KitPiece | None:
        """The hi-hat whose upper cymbal the pedal's rod moves; a pad's controller moves nothing."""
        hat = self.pieces.get(Piece.HIHAT)
        return None if hat is None or hat.electronic else hat

    def stand_in(self, piece: Piece) -> Piece:
        """`piece` if this kit has it, else the piece that is played in its place."""
        played = Piece.HIHAT if piece is Piece.HIHAT_PEDAL else piece
        found = stand_in(played, self.pieces)
        return Piece.SNARE if found is None else found

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
            slave=self.slave and self.slave.mirrored,
        )

    def target(self, piece: Piece, zone: Zone, limb: Limb) -> Target:
        """The point that `limb` aims at for `zone` of `piece`, on the piece that stands in for it if need be."""
        found = self.pieces[self.stand_in(piece)].target(zone, limb)
        if piece is not Piece.KICK or limb is not self.feet[1]:
            return found
        return replace(found, point_m=found.point_m + self.second_beater_m)

    @property
    def second_beater_m(self) -> Vector:
        """From the first beater to the slave's: to the hi-hat's side, (3,)."""
        return np.array([BEATERS_APART_M if self.left_handed else -BEATERS_APART_M, 0.0, 0.0])


_PIECES = members_by_label(Piece)
_MAX_TILT_DEG = 80.0
_MAX_LENGTH_M = 3.0
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
    return read(read_source(path), kit_reader(path.stem))


def _degrees(low: float, high: float) -> Reader[float]:
    """An angle that the file has in degrees, in radians."""
    return lambda value: math.radians(number(low, high)(value))


_RIDES = (Piece.RIDE, Piece.RIDE_2)
"""Their bells are struck with the stick's shoulder; those of other cymbals, which hang farther off, with its tip."""
_UP_TO_BELL_M = -0.06
"""And from farther below, so that the arm reaches (our choice)."""
_LENGTHS = point(_MAX_LENGTH_M)
_TILT = _degrees(-_MAX_TILT_DEG, _MAX_TILT_DEG)
_SHARE = number(-1.0, 1.0)
_SPOT: Fields = {each.name: optional(flag if each.name == "shoulder" else _SHARE) for each in fields(ZoneSpot)}
_PIECE: Fields = {
    "kind": Field(one_of(SPOTS, "kind"), "drum"),
    "centre_m": needed(_LENGTHS, "centre_m = [right, forward, up] in metres"),
    "radius_m": needed(number(0.02, 1.0), "radius_m = 0.18"),
    "depth_m": Field(number(0.0, 1.0), 0.02),
    "tilt_x_deg": Field(_TILT, 0.0, called="tilt_x_rad"),
    "tilt_y_deg": Field(_TILT, 0.0, called="tilt_y_rad"),
    "wrist_radius_m": Field(number(0.05, 1.0), 0.40),
    "wrist_height_m": Field(number(-0.5, 0.5), 0.06),
    "zones": Field(table_of(key_of(members_by_label(Zone), "zone"), said(_SPOT)), {}),
}
_PEDAL: Fields = {
    "heel_m": needed(_LENGTHS, "heel_m = [right, forward, up] in metres"),
    "toe_m": needed(_LENGTHS, "toe_m = [right, forward, up] in metres"),
    "raised_deg": Field(_degrees(0.0, 60.0), math.radians(18.0), called="raised_rad"),
}


def kit_reader(name: str) -> Reader[Kit]:
    """The schema of the file of the kit called `name`."""
    whole, mirrored = record(partial(_kit, name), FIELDS, "piece or key"), record(partial(_mirrored, name), _MIRRORED)
    return lambda raw: (mirrored if isinstance(raw, dict) and "mirrors" in raw else whole)(raw)


def _kit(name: str, title: str | None, handed: str, pedals: Mapping[str, Pedal], **others: Any) -> Kit:  # noqa: ANN401
    """A kit of what its file says; `others` are its seat, looks and pieces, None for those that it lacks."""
    found = {_PIECES[key]: piece for key, piece in others.items() if piece is not None and key in _PIECES}
    pieces = {name: replace(piece, electronic=others["make"] == "electronic") for name, piece in found.items()}
    check_apart(list(pieces.values()))
    check_off_the_player(list(pieces.values()), others["seat_m"])
    check_boards({key: (p.heel_m, p.toe_m) for key, p in pedals.items() if p is not None})
    return Kit(
        name=name,
        title=name if title is None else title,
        left_handed=handed == "left",
        seat_m=others["seat_m"],
        pieces=MappingProxyType(pieces),
        pedals=MappingProxyType({Piece.KICK: pedals["kick"], Piece.HIHAT_PEDAL: pedals["hihat"]}),
        slave=pedals["slave"],
        make=others["make"],
        finish=others["finish"],
    )


def _mirrored(name: str, title: str | None, mirrors: str) -> Kit:
    """A shipped kit built for the other hand."""
    return replace(load_kit(mirrors).mirrored, name=name, title=name if title is None else title)


def _piece(piece: Piece) -> Reader[KitPiece]:
    def build(zones: Mapping[Zone, Mapping[str, Any]], **values: Any) -> KitPiece:  # noqa: ANN401 - its other fields
        plain = KitPiece(piece, **values)
        return replace(plain, spots=MappingProxyType(_spots(plain, zones)))

    return record(build, _PIECE)


def _spots(piece: KitPiece, zones: Mapping[Zone, Mapping[str, Any]]) -> dict[Zone, ZoneSpot]:
    """Where each zone is struck: as on any piece of its kind, but for what the file says in `zones`."""
    inward = max(-1.0, min(1.0, -piece.centre_m[0] / _ASIDE_M))
    usual = {zone: replace(spot, right=inward * spot.right) for zone, spot in SPOTS[piece.kind].items()}
    if Zone.BELL in usual and piece.piece not in _RIDES:
        usual[Zone.BELL] = replace(usual[Zone.BELL], shoulder=False, wrist_height_m=_UP_TO_BELL_M)
    return usual | {zone: replace(usual.get(zone, ZoneSpot(0.0, 0.0)), **changes) for zone, changes in zones.items()}


def _pedal(**values: Any) -> Pedal:  # noqa: ANN401 - the fields of a pedal
    pedal = Pedal(**values)
    length_m = math.dist(pedal.heel_m, pedal.toe_m)
    if length_m < _LEAST_BOARD_M:
        raise wrong(f"the toe end is {length_m:.2f} m from the heel, expected at least {_LEAST_BOARD_M:g} m", "toe_m")
    return pedal


_NEEDED = ("kick", "snare")
_PEDALS: Fields = {
    "kick": needed(record(_pedal, _PEDAL), "a table [pedals.kick]"),
    "hihat": needed(record(_pedal, _PEDAL), "a table [pedals.hihat]"),
    "slave": optional(record(_pedal, _PEDAL)),
}
FIELDS: Fields = {
    "title": optional(text),
    "handed": Field(one_of(("right", "left"), "hand"), "right"),
    "make": Field(one_of(MAKES, "make"), MAKES[0]),
    "finish": Field(one_of(FINISHES, "finish"), FINISHES[0]),
    "seat_m": Field(_LENGTHS, (0.0, 0.0, 0.5)),
    "pedals": needed(record(dict, _PEDALS), "tables [pedals.kick] and [pedals.hihat]"),
    **{key: Field(_piece(each), None, f"a table [{key}]" if key in _NEEDED else None) for key, each in _PIECES.items()},
}
"""The schema of the file; a kit needs a kick and a snare."""
_MIRRORED: Fields = {
    "title": optional(text),
    "mirrors": needed(one_of(kit_names(), "kit"), 'mirrors = "four_piece"'),
}
KEYS = (*FIELDS, *(_MIRRORED.keys() - FIELDS.keys()))
"""What the top table of either kind of file may hold."""
