"""The three questions of the first start, and what their answers change.

Who plays, so that progress has an owner; whether the kit is heard from its own module, whose sound ours would double a
few milliseconds later; and whose hand leads, for the student copies over the drummer's shoulder (TEACHING's default
view), which teaches nothing where the drummer leads with the other hand. Everything else has a default that can be
changed later; nothing here is asked twice.
"""

from dataclasses import dataclass, replace

from station.app.engine_client import DEAD, SILENT
from station.core.settings import Settings
from station.engine.engine_config import EngineConfig
from station.engine.messages import Bus, SetLevel
from station.motion.sticking.hand_notes import Hands
from station.practice.session.leading_hand import hands_of

LONGEST_NAME = 40
"""Letters of a name; our choice, what a list shows in one line."""
_NOBODY = Settings().student
_LOUD = 1.0


@dataclass(frozen=True, slots=True)
class FirstAnswers:
    """What was answered; `student` may be blank, `module_sounds` where the kit is heard without us."""

    student: str = ""
    module_sounds: bool = False
    hands: Hands = Hands.RIGHT

    @classmethod
    def of(cls, settings: Settings) -> "FirstAnswers":
        """What the settings say before anything was asked; raises `BadInput` for hands that nobody has."""
        named = "" if settings.student == _NOBODY else settings.student
        return cls(named, not settings.own_sound, hands_of(settings) or Hands.RIGHT)


def found_lines(kits: str, sound: str, keys: str) -> tuple[str, str]:
    """What a newcomer plays on and hears, and in each case what to do; `keys` says which of the computer's play."""
    kit = f"Kit: {kits}. Strikes that light up another drum? The Devices page learns a pad from one stroke."
    if not kits:
        kit = f"No kit yet: plug it in now, or play on the computer's keys ({keys})."
    if sound in (SILENT, DEAD):
        return kit, "No sound: plug in headphones or a loudspeaker; `station doctor` says what is in the way."
    return kit, f"Sound: {sound}. Wireless headphones are late: what they add is found while you play."


def play_along(kits: str) -> str:
    """What a newcomer is told as the first groove begins."""
    with_what = f"on {kits}" if kits else "with the computer's keys: F1 shows them"
    return f"Listen first: the drummer plays it once. Then it is your turn, {with_what}."


def answered(settings: Settings, answers: FirstAnswers | None) -> Settings:
    """The settings with what was answered, None where the questions were put aside; either way they were asked."""
    if answers is None:
        return replace(settings, welcomed=True)
    name = " ".join(answers.student.split())[:LONGEST_NAME]
    return replace(
        settings,
        student=name or _NOBODY,
        own_sound=not answers.module_sounds,
        hands=answers.hands.value,
        welcomed=True,
    )


def student_level(settings: Settings) -> SetLevel:
    """How loud the engine sounds the student's own strokes by `settings`."""
    commands = EngineConfig.from_settings(settings).first_commands
    said = [command for command in commands if isinstance(command, SetLevel) and command.bus is Bus.STUDENT]
    return said[-1] if said else SetLevel(Bus.STUDENT, _LOUD)
