"""How a student likes sessions to go, as the practice panel shows it: what starts and pauses them, what is asked.

Every habit is a setting of the same name; `Preferences` changes them, and learns what shall pause from the kit.
"""

from dataclasses import dataclass, replace

from station.app.settings.settings_store import SettingsStore
from station.core.labels import name_of
from station.core.settings import Settings
from station.engine.messages import EngineEvent
from station.practice.control.pause_learning import PauseLearning

_SWITCHES = {
    "cc": "foot switch, controller",
    "program": "foot switch, program",
    "key": "foot switch, key",
    "button": "game kit, button",
}


@dataclass(frozen=True, slots=True)
class PracticePreferences:
    """The settings `kicks_start`, `pads_switch`, `auto_pause`, `ask_first` and `guide`, and the words of `pause`."""

    kicks_start: bool = True
    pads_switch: bool = True
    auto_pause: bool = True
    ask_first: bool = True
    guide: bool = False
    pauses: tuple[str, ...] = ()

    @classmethod
    def of(cls, settings: Settings) -> "PracticePreferences":
        """What the settings say."""
        return cls(
            settings.kicks_start,
            settings.pads_switch,
            settings.auto_pause,
            settings.ask_first,
            settings.guide,
            tuple(settings.pause.split()),
        )

    def within(self, settings: Settings) -> Settings:
        """The settings with these preferences; words of `pause` that mean the same stay as they are written."""
        is_same = self.pauses == tuple(settings.pause.split())
        return replace(
            settings,
            kicks_start=self.kicks_start,
            pads_switch=self.pads_switch,
            auto_pause=self.auto_pause,
            ask_first=self.ask_first,
            guide=self.guide,
            pause=settings.pause if is_same else " ".join(self.pauses),
        )

    def pausing_by(self, word: str) -> "PracticePreferences":
        """With one more thing that pauses."""
        return replace(self, pauses=(*self.without(word).pauses, word))

    def without(self, word: str) -> "PracticePreferences":
        """With one thing less that pauses."""
        return replace(self, pauses=tuple(other for other in self.pauses if other != word))


def pause_in_words(word: str) -> str:
    """A word of `pause` for people: "crash and ride at once", "foot switch, controller 64"."""
    kind, _, number = word.partition("=")
    if kind in _SWITCHES:
        return f"{_SWITCHES[kind]} {number}"
    return f"{' and '.join(name_of(piece) for piece in word.split('+'))} at once"


class Preferences:
    """The preferences of the settings `store`; `learns` while the kit may say what pauses."""

    def __init__(self, store: SettingsStore) -> None:
        self._store = store
        self._learning: PauseLearning | None = None

    @property
    def now(self) -> PracticePreferences:
        """The preferences as they are."""
        return PracticePreferences.of(self._store.now)

    def put(self, preferences: PracticePreferences) -> None:
        """These from now on."""
        self._store.update(preferences.within)

    @property
    def learns(self) -> bool:
        """Whether the next gesture of the kit will be what pauses."""
        return self._learning is not None

    def learn(self, on: bool) -> None:
        """Let the kit say what pauses, or no longer."""
        self._learning = PauseLearning() if on else None

    def handle(self, event: EngineEvent) -> bool:
        """Handle an event; returns whether it is for learning, and commands nothing."""
        if self._learning is None:
            return False
        word = self._learning.feed(event)
        if word is not None:
            self._learning = None
            self.put(self.now.pausing_by(word))
        return True
