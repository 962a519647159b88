"""A session that a virtual student has played: what the session made of it, and what the student knows it did."""

from dataclasses import dataclass

from station.core.errors import StationError
from station.practice.session.session import SessionResult
from station.simulation.virtual_student import VirtualPerformance


@dataclass(frozen=True, eq=False)
class VirtualSession:
    """What the session made of it, what the student knows it did, and why the capture lacks some of it, if it does."""

    result: SessionResult
    student: VirtualPerformance
    fault: StationError | None
