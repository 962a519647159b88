"""What the user does in the window to the practice: begin, leave, preview; what cannot be done is said in one line."""

from collections.abc import Callable
from dataclasses import replace

from station.app.model import Stage
from station.app.practice_model import PracticeModel
from station.app.selection import Selection
from station.core.errors import StationError
from station.drills.lesson import Lesson
from station.gui.panels.ruler import Bars


class Deeds:
    """Done to `model` by what was chosen in `choice`; `tell` shows a line."""

    def __init__(self, model: PracticeModel, choice: Selection, tell: Callable[[str], None]) -> None:
        self.model, self.choice, self.tell = model, choice, tell
        first = choice.wish()
        self._previewed = None if first is None else (first.lesson, first.bars)

    def tried(self, action: Callable[[], object]) -> None:
        """Do it, or say in one line why it could not be done."""
        try:
            action()
        except StationError as fault:
            self.tell(str(fault))

    # --- what is shown before it begins ------------------------------------------------------------------------------

    def preview(self) -> None:
        """Show the lesson that was chosen in the list, if another one was."""
        wish = self.choice.wish()
        shown = None if wish is None else (wish.lesson, wish.bars)
        is_idle = self.model.room().stage is Stage.IDLE
        if shown == self._previewed or not is_idle or not (wish or self.choice.free):
            return
        if wish is not None and self._previewed is not None and wish.lesson == self._previewed[0]:
            self.model.deck.repeat(wish.bars)
            if self.model.deck.player.playing:  # the rest can wait: nothing of it is seen
                return
        self._previewed = shown
        self.tried(lambda: self.model.preview(wish))

    def preview_anew(self) -> None:
        """Show the chosen lesson as it is to be played now, or when the result is left; raises `StationError`."""
        wish = self.choice.wish()
        if self.model.room().stage is not Stage.IDLE:
            self._previewed = None
        elif wish is not None:
            self.model.preview(wish)

    def choose_bars(self, bars: Bars) -> None:
        """Repeat these bars (first, last, from 0) on the player, and practise them; None for the lesson's own."""
        self.choice.bars = None if bars is None else (bars[0] + 1, bars[1] + 1)

    def to_take(self) -> tuple[Lesson, tuple[int, int]]:
        """The chosen lesson, and the bars of it that are practised, from 0."""
        lesson, bars = self.model.deck.lesson, self.choice.bars
        return lesson, lesson.loop if bars is None else (bars[0] - 1, bars[1] - 1)

    # --- one after the other -----------------------------------------------------------------------------------------

    def start(self) -> None:
        """Begin what is chosen."""
        wish, free = self.choice.wish(), self.choice.free_wish()
        if wish is not None:
            self.tried(lambda: self.model.start(wish))
        elif free is not None:
            self.tried(lambda: self.model.just_play(free))

    def drill(self, bar: int) -> None:
        """Practise one bar (from 1) of the lesson alone."""
        wish = self.choice.wish()
        if wish is not None:
            self.tried(lambda: self.model.start(replace(wish, bars=(bar, bar), adapt=False)))

    def leave(self) -> None:
        """Out of what goes on: a pad is not learnt, a session ends, a result was read, the demonstration stops."""
        if self.model.desk.learns:
            self.model.desk.give_up()
            return
        stage = self.model.room().stage
        if stage is Stage.PLAYING:
            self.tried(self.model.stop)
        elif stage is Stage.RESULT:
            self.model.dismiss()
        else:
            self.model.deck.halt()

    @property
    def shows_result(self) -> bool:
        """Whether a result may be seen."""
        return self.model.room().stage is Stage.RESULT and self.model.report() is not None
