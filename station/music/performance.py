"""The played music: an immutable table of hits in session time, and the cymbals that were choked."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.core.events import Choke, Hit
from station.core.pieces import Articulation, Limb, Piece, Zone

HIT_DTYPE = np.dtype(
    [
        ("at_ns", np.int64),
        ("openness", np.float32),  # hi-hat 0 closed … 1 open; NaN where the kit cannot tell
        ("position", np.float32),  # 0 centre … 1 edge; NaN where the kit cannot tell
        ("velocity_fraction", np.float32),  # 0 ≤ f < 1, on top of the velocity
        ("piece", np.uint8),
        ("zone", np.uint8),
        ("articulation", np.uint8),
        ("velocity", np.uint8),
        ("limb", np.int8),
        ("midi_note", np.uint8),
    ]
)

CHOKE_DTYPE = np.dtype([("at_ns", np.int64), ("piece", np.uint8)])


def _nan(value: float | None) -> float:
    return np.nan if value is None else value


def _none(value: float) -> float | None:
    return None if np.isnan(value) else float(value)


@dataclass(frozen=True, eq=False)
class Performance:
    """What was played: `hits` (n,) of `HIT_DTYPE` in order of time, `chokes` (m,) of `CHOKE_DTYPE`; both read-only."""

    hits: NDArray[np.void]
    chokes: NDArray[np.void] = field(default_factory=lambda: np.empty(0, CHOKE_DTYPE))

    @classmethod
    def from_array(cls, hits: NDArray[np.void], chokes: NDArray[np.void] | None = None) -> "Performance":
        """A performance of rows in any order; rows of one time keep their order."""
        rows = hits[np.argsort(hits["at_ns"], kind="stable")]
        rows.setflags(write=False)
        grabbed = np.empty(0, CHOKE_DTYPE) if chokes is None else chokes[np.argsort(chokes["at_ns"], kind="stable")]
        grabbed.setflags(write=False)
        return cls(rows, grabbed)

    @classmethod
    def from_hits(cls, hits: Iterable[Hit], chokes: Iterable[Choke] = ()) -> "Performance":
        """A performance of single events in any order."""
        rows = [
            (
                h.at_ns,
                _nan(h.openness),
                _nan(h.position),
                h.velocity_fraction,
                h.piece,
                h.zone,
                h.articulation,
                h.velocity,
                h.limb,
                h.midi_note,
            )
            for h in hits
        ]
        grabbed = [(c.at_ns, c.piece) for c in chokes]
        return cls.from_array(np.array(rows, HIT_DTYPE), np.array(grabbed, CHOKE_DTYPE))

    def __len__(self) -> int:
        return len(self.hits)

    def __getitem__(self, index: int) -> Hit:
        row = self.hits[index]
        return Hit(
            at_ns=int(row["at_ns"]),
            piece=Piece(row["piece"]),
            zone=Zone(row["zone"]),
            velocity=int(row["velocity"]),
            articulation=Articulation(row["articulation"]),
            openness=_none(row["openness"]),
            midi_note=int(row["midi_note"]),
            position=_none(row["position"]),
            limb=Limb(row["limb"]),
            velocity_fraction=float(row["velocity_fraction"]),
        )

    def __iter__(self) -> Iterator[Hit]:
        return (self[i] for i in range(len(self)))

    @property
    def fine_velocity(self) -> NDArray[np.float64]:
        """The velocity of each hit (n,) as finely as the kit tells it, 1 ≤ v < 128."""
        return self.hits["velocity"] + self.hits["velocity_fraction"].astype(np.float64)

    def shifted(self, by_ns: int) -> "Performance":
        """The same performance `by_ns` later."""
        hits, chokes = self.hits.copy(), self.chokes.copy()
        hits["at_ns"] += by_ns
        chokes["at_ns"] += by_ns
        return Performance.from_array(hits, chokes)
