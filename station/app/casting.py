"""Who demonstrates and whose hand leads, as the window chooses them while it is open."""

from dataclasses import replace

from station.app.demo_player import DemoPlayer
from station.app.goings_on import GoingsOn
from station.app.session_preparation import SessionPreparation
from station.motion.kinematics.figure import load_figure
from station.motion.sticking.hand_notes import Hands
from station.motion.style.style import Style
from station.practice.session.leading_hand import hands_of
from station.scenes.demonstrator import Demonstrator


class Casting:
    """`who` demonstrates what goes on in `goings_on` and on the `deck`; what is `prepared` next goes by the hands."""

    def __init__(self, who: Demonstrator, prepared: SessionPreparation, goings_on: GoingsOn, deck: DemoPlayer) -> None:
        self.who = who
        self._prepared, self._goings_on, self._deck = prepared, goings_on, deck

    def move_as(self, style: Style) -> None:
        """Let the demonstrator move in another style at once; hands hold as before while a pass is played."""
        self.who = replace(self.who, style=style)
        self._goings_on.run.move_as(self.who, hands_stay=self._goings_on.is_session)
        self._deck.perform_as(self.who)

    def embody(self, figure: str) -> None:
        """Let another body demonstrate from the next preview or session on: a name or file; raises `BadInput`."""
        self.who = replace(self.who, figure=load_figure(figure))
        self._deck.perform_as(self.who)

    @property
    def hands(self) -> Hands:
        """Whose hand leads: as it was chosen, else as the lesson's kit is built."""
        built = Hands.LEFT if self._goings_on.run.plan.kit.left_handed else Hands.RIGHT
        return hands_of(self._prepared.settings) or built

    def lead_with(self, hands: Hands) -> None:
        """Let another hand lead from the next preview or session on."""
        self._prepared.settings = replace(self._prepared.settings, hands=hands.value)
