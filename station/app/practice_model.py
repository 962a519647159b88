"""What the window asks of whoever practises behind it; what it is shown are the tables of `model`.

The window calls it once a frame and whenever the user does something; it keeps no state of the practice and starts no
thread. Faults of the user's or the world's come as `StationError` and are shown in one line.
"""

from typing import Protocol

from station.app.calibration import Calibration
from station.app.casting import Casting
from station.app.catalog import Catalog
from station.app.demo_player import DemoPlayer
from station.app.export import Exporter
from station.app.first_start import FirstAnswers
from station.app.mapping_editor import MappingEditor
from station.app.model import FreeRequest, RoomState, SessionRequest, ShownResult
from station.app.preferences import Preferences
from station.engine.messages import KeyHit
from station.music.score import Score
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.session.self_estimate import SelfEstimate
from station.render.snapshot import Snapshot
from station.scenes.curves import ScoreCurves


class PracticeModel(Protocol):
    """What practises behind the window: `shelf` has what can be, `deck` demonstrates what is chosen of it."""

    deck: DemoPlayer
    shelf: Catalog

    def snapshot(self, now_ns: int) -> Snapshot:
        """What is to be seen at monotonic time `now_ns`."""
        ...

    def news(self, now_ns: int) -> Snapshot | None:
        """What is to be seen at `now_ns` if something has been struck since the last call of `snapshot`."""
        ...

    def is_lively(self, now_ns: int) -> bool:
        """Whether something moves, or may at any moment, so that no frame is to be spared."""
        ...

    def room(self) -> RoomState:
        """What is going on."""
        ...

    def first(self) -> SessionRequest | None:
        """What is chosen when the window opens; None leaves it to the list."""
        ...

    def preview(self, wish: SessionRequest | None) -> None:
        """Show what is chosen, before it begins, None the kit alone for just playing; raises `StationError`."""
        ...

    def start(self, wish: SessionRequest) -> None:
        """Begin a session; raises `StationError`."""
        ...

    def just_play(self, wish: FreeRequest) -> None:
        """Begin a free take; raises `StationError`."""
        ...

    def listen(self) -> None:
        """Hear the last free take, or end what is heard; raises `StationError`."""
        ...

    def hear_bar(self, bar: int, whose: Whose) -> None:
        """Hear and see a bar (from 0) of the result's score, as it was written or played; raises `StationError`."""
        ...

    def pause(self) -> None:
        """Pause the session, or go on."""
        ...

    def wants_start(self) -> bool:
        """Whether the kit has asked for what Enter starts; said once."""
        ...

    def measure(self, by: str, distance_m: float) -> None:
        """Begin to measure how late the devices are, one of `measuring`'s ways; raises `StationError`."""
        ...

    def trust_measured(self) -> None:
        """Subtract what is stored of the devices from now on; raises `StationError`."""
        ...

    def veto(self) -> None:
        """Refuse what the next pass would change: it is as the last one was."""
        ...

    def stop(self) -> None:
        """End the session early; its result is kept."""
        ...

    def key(self, hit: KeyHit) -> None:
        """A stroke on the computer's keyboard."""
        ...

    def report(self) -> ShownResult | None:
        """The result of the session that ended last, None before the first and while a question is open."""
        ...

    def graphed(self) -> ScoreCurves | None:
        """What the graph shows, None for nothing."""
        ...

    def answer(self, guess: SelfEstimate) -> None:
        """What the student believes, where a question is open."""
        ...

    def score(self) -> Score:
        """The whole score of the lesson that is shown, at its own tempo."""
        ...

    def meet(self, answers: FirstAnswers) -> None:
        """Who plays, what is heard and whose hand leads, from now on; raises `StationError`."""
        ...

    @property
    def casting(self) -> Casting:
        """Who demonstrates, and whose hand leads."""
        ...

    @property
    def desk(self) -> MappingEditor:
        """The kits that are here, as the devices page shows and sets them."""
        ...

    @property
    def calibration(self) -> Calibration:
        """What measures how late the devices are."""
        ...

    @property
    def films(self) -> Exporter:
        """What writes files to take along."""
        ...

    @property
    def habits(self) -> Preferences:
        """How the student likes sessions to go."""
        ...

    def dismiss(self) -> None:
        """The result was read: back to the lessons."""
        ...
