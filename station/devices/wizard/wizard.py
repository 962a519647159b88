"""The wizard as a state machine: bytes of the kit, keys and time in; what to ask and what was learned out.

It owns no port, clock or window: whoever runs it (the terminal, the window, a test) feeds it, shows its `view` and
keeps what it has `learned`. A step ends by itself when its strokes were played and their crosstalk had time to come.
"""

from dataclasses import dataclass

from station.core.units import NS_PER_MS
from station.devices.mapping.presets import preset_for
from station.devices.message_tokens import tokens_for
from station.devices.wizard.answers import ONE_STROKE_NS, Said, StepAnswer, groups
from station.devices.wizard.infer import Learned, grab_notes, learn, main_notes, main_of
from station.devices.wizard.module_guess import ModuleGuess, guess
from station.devices.wizard.pedal_range import learned_pedal, moved_controller, presses
from station.devices.wizard.wizard_steps import SPLASH, STEPS, STOMP, WizardQuestion, WizardStep

PEDAL_RESTS_NS = 800 * NS_PER_MS
"""A pedal that was moved and then said nothing for so long is held; our choice."""
GRABS_APART_NS = 200 * NS_PER_MS
READING_NS = 700 * NS_PER_MS
"""Whoever has just been asked something new is still reading: notes so soon belong to what was asked before."""
SLIPS = 2
"""So many strokes on another pad than was asked for, and none on it, are no slip; our choice."""
SURE_OF = 5
"""So many numbers as expected and none otherwise, and the rest may be left to the preset; our choice."""


@dataclass(frozen=True, slots=True)
class WizardView:
    """What to show: the step's number from 1 and how many there are, what to do, how much of it is done.

    `text` is empty once all was asked; `hint` is for this step; `heard` are the last notes, number and velocity, the
    newest last; `guess` what the kit seems to be.
    """

    step: int
    steps: int
    text: str
    done: int
    needed: int
    hint: str
    heard: tuple[tuple[int, int], ...]
    guess: ModuleGuess


class Wizard:
    """Learns the kit at `port`."""

    def __init__(self, port: str, steps: tuple[WizardStep, ...] = STEPS) -> None:
        self.port = port
        self._steps = steps
        self._takes: dict[WizardStep, StepAnswer] = {}
        self._at = 0
        self._now_ns = 0
        self._tokens = tokens_for(preset_for(port).reports)
        self._take = StepAnswer()
        self._hint = ""
        self._asked_ns = -READING_NS
        self._weighed: list[Said] = []
        self._mains: dict[WizardStep, int] = {}  # the main note of each answered step

    # --- in ----------------------------------------------------------------------------------------------------------

    def feed(self, data: bytes, at_ns: int) -> None:
        """Bytes of the kit that came at `at_ns`."""
        self.advance(at_ns)
        for message in self._tokens.feed(data):
            self._take.add(message, at_ns)
        if at_ns < self._asked_ns + READING_NS:
            self._take.notes.clear()
            self._take.touches.clear()

    def advance(self, now_ns: int) -> None:
        """The time; ends the step that is answered."""
        self._now_ns = max(self._now_ns, now_ns)
        if not self.over and self._is_answered():
            self._accept()

    def skip(self) -> None:
        """On to the next step: what was played of this one does not count, unless only the soft strokes are lacking."""
        step = self._step
        if step is STOMP and self._take.controllers and not self._take.notes:
            self._takes[step] = self._take
        elif step is not None and step.ask is WizardQuestion.STRIKE and self._done() >= step.firm:
            self._accept()
            return
        self._go(self._at + 1)

    def back(self) -> None:
        """To the step before, which is asked anew."""
        at = max(0, self._at - 1)
        self._takes.pop(self._steps[at], None)
        self._go(at)

    def finish(self) -> None:
        """Ask nothing more; what was not asked is as the preset says."""
        self._go(len(self._steps))

    # --- out ---------------------------------------------------------------------------------------------------------

    @property
    def over(self) -> bool:
        """Whether all was asked."""
        return self._at >= len(self._steps)

    def learned(self) -> Learned:
        """What the answers so far tell."""
        return learn(self._takes, self.port)

    def view(self) -> WizardView:
        """What to show now."""
        step, found = self._step, self._guess()
        needed = 0 if step is None else step.firm + step.soft
        return WizardView(
            step=min(self._at + 1, len(self._steps)),
            steps=len(self._steps),
            text="" if step is None else self._text(step),
            done=min(self._done(), needed),
            needed=needed,
            hint=self._hint or self._surety(found),
            heard=tuple((note.number, note.value) for note in self._take.notes[-4:]),
            guess=found,
        )

    @property
    def _step(self) -> WizardStep | None:
        return None if self.over else self._steps[self._at]

    def _text(self, step: WizardStep) -> str:
        if step.ask is WizardQuestion.SWEEP:
            return step.text
        if step.soft and self._done() >= step.firm:
            return f"{step.text}: now as softly as you can, {step.soft} times"
        how = "times" if step.ask is WizardQuestion.GRAB else "firm single strokes, with a pause"
        return f"{step.text}: {step.firm} {how}"

    def _surety(self, found: ModuleGuess) -> str:
        if found.agreeing >= SURE_OF and not found.differing and not self.over:
            return f"all is as on a {found.preset.title}: the rest can be left to that (finish)"
        return ""

    def _guess(self) -> ModuleGuess:
        numbers = {s: n for s, n in self._mains.items() if s is not SPLASH}
        return guess(numbers, self.port, learned_pedal(self._takes, None))

    # --- inside ------------------------------------------------------------------------------------------------------

    def _done(self) -> int:
        """How many of the wanted strokes, stomps or grabs are played."""
        step = self._step
        if step is None or step.ask is WizardQuestion.SWEEP:
            return 0
        if step.ask is WizardQuestion.GRAB:
            return max(len(groups(self._take.touches, GRABS_APART_NS)), self._grab_notes())
        strokes = self._take.strokes()
        main = main_of(step, self._take, self._mains)
        if step is STOMP and main is None:
            return presses(self._take, learned_pedal(self._takes, self._guess().preset.pedal))
        return sum(any(note.number == main for note in stroke) for stroke in strokes)  # slips do not count

    def _grab_notes(self) -> int:
        """Notes that tell of a grab, where the kit sends such: after the stroke, and not the pad's own."""
        return 0 if self._take.touches else len(grab_notes(self._take, self._mains.values()))

    def _is_answered(self) -> bool:
        step = self._step
        assert step is not None, "asked only while there is one"
        said: list[Said] = [*self._take.notes[-1:], *self._take.touches[-1:], *self._take.controllers[-1:]]
        quiet_ns = self._now_ns - max((one.at_ns for one in said), default=self._now_ns)
        if quiet_ns <= (PEDAL_RESTS_NS if step.ask is WizardQuestion.SWEEP else ONE_STROKE_NS) or said == self._weighed:
            return False
        self._weighed = said  # once is enough until something more comes
        if step.ask is WizardQuestion.SWEEP:
            return moved_controller(self._take) is not None
        return self._done() >= step.firm + step.soft or (
            self._done() >= SLIPS and self._struck_instead(step) is not None
        )

    def _accept(self) -> None:
        """Keep the answer, unless another pad was struck than was asked for."""
        step = self._step
        assert step is not None
        other = self._struck_instead(step)
        if other is None:
            self._takes[step] = self._take
            self._go(self._at + 1)
        else:
            self._take, self._weighed = StepAnswer(), []
            self._hint = f"that was the pad of: {other.text}; once more, or skip if the kit lacks this one"

    def _struck_instead(self, step: WizardStep) -> WizardStep | None:
        """The step of another piece whose note most of these strokes had."""
        if step.ask is not WizardQuestion.STRIKE or not self._take.notes:
            return None
        own = main_of(step, self._take, self._mains)
        return next((s for s, n in self._mains.items() if n == own and s.piece is not step.piece), None)

    def _go(self, step: int) -> None:
        self._at = min(step, len(self._steps))
        self._mains = main_notes(self._takes)
        self._take, self._hint, self._asked_ns, self._weighed = StepAnswer(), "", self._now_ns, []
