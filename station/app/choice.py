"""What the user has chosen but not begun: the lesson, its tempo and passes, what the list shows of it."""

from collections.abc import Sequence

from station.app.model import LessonCard, Start

MIN_TEMPO_BPM, MAX_TEMPO_BPM = 30, 260
"""The tempo slider's ends (our choice); a lesson outside widens them."""
MAX_LOOPS = 32


class Choice:
    """The state of the lessons page."""

    def __init__(self, lessons: Sequence[LessonCard]) -> None:
        self._lessons = tuple(lessons)
        self.search = ""
        self.card: LessonCard | None = None
        self.tempo_bpm = 100.0
        self.loops = 4
        if self._lessons:
            self.choose(self._lessons[0])

    def choose(self, card: LessonCard) -> None:
        """Take a lesson at the tempo and with the passes that its author wants."""
        self.card, self.tempo_bpm, self.loops = card, card.tempo_bpm, min(card.passes, MAX_LOOPS)

    def visible(self) -> list[LessonCard]:
        """The lessons whose title, name, author, level or tags contain every word of the search."""
        words = self.search.casefold().split()
        return [card for card in self._lessons if all(word in _text(card) for word in words)]

    def wish(self) -> Start | None:
        """What to start; None where there is no lesson."""
        return None if self.card is None else Start(self.card.name, float(self.tempo_bpm), self.loops)


def _text(card: LessonCard) -> str:
    return " ".join([card.title, card.name, card.author, card.level_words, *card.tags]).casefold()
