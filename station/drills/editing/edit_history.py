"""Undo without end: every text that a lesson has had while it was edited, kept as the changes between them.

A history is a value: an edit, an undo and a redo each give another one, and share what came before.
A step holds what was taken and what was given, squeezed where they are long, so that a long day of edits fits.
"""

from dataclasses import dataclass, field
from zlib import compress, decompress

from station.drills.editing.text_change import TextChange, change_between

_SQUEEZED_FROM = 512
"""Changes of so many characters or more are kept squeezed: below, the squeezed bytes save little (our choice)."""


@dataclass(frozen=True, slots=True)
class _Squeezed:
    """A long change: where, how many characters of what is squeezed were taken, and all of it."""

    at: int
    taken: int
    data: bytes


@dataclass(frozen=True, slots=True, eq=False)
class _Step:
    """A change and its name, on top of the steps before it (of those undone: after it)."""

    name: str
    kept: TextChange | _Squeezed
    below: "_Step | None" = field(repr=False)


@dataclass(frozen=True, slots=True, eq=False)
class EditHistory:
    """A lesson's `text` as it stands, and the way to every text that it was."""

    text: str
    _done: _Step | None = field(default=None, repr=False)
    _undone: _Step | None = field(default=None, repr=False)

    @property
    def undo_name(self) -> str | None:
        """What an undo would take back, such as "stroke on snare, bar 2"; None where nothing was done."""
        return None if self._done is None else self._done.name

    @property
    def redo_name(self) -> str | None:
        """What a redo would do again; None where nothing was undone."""
        return None if self._undone is None else self._undone.name

    def edited(self, text: str, name: str, joins: bool = False) -> "EditHistory":
        """The history after a step called `name` that made `text`; itself where `text` is what stands already.

        With `joins` it goes on with the last step where that has the same name: a word typed letter by letter and a
        stroke drawn across cells are taken back at once.
        """
        if text == self.text:
            return self
        last = self._done
        if joins and last is not None and last.name == name and self._undone is None:
            before = _opened(last.kept).undone.applied(self.text)
            return EditHistory(text, _Step(name, _kept(change_between(before, text)), last.below))
        return EditHistory(text, _Step(name, _kept(change_between(self.text, text)), last))

    def undone(self) -> "EditHistory":
        """One step back; itself at the beginning."""
        step = self._done
        if step is None:
            return self
        text = _opened(step.kept).undone.applied(self.text)
        return EditHistory(text, step.below, _Step(step.name, step.kept, self._undone))

    def redone(self) -> "EditHistory":
        """One step on; itself at the end."""
        step = self._undone
        if step is None:
            return self
        return EditHistory(_opened(step.kept).applied(self.text), _Step(step.name, step.kept, self._done), step.below)


def _kept(change: TextChange) -> TextChange | _Squeezed:
    if len(change.taken) + len(change.given) < _SQUEEZED_FROM:
        return change
    # "surrogatepass": a text that somebody pasted may hold what no file can, and must come back all the same
    both = (change.taken + change.given).encode("utf-8", "surrogatepass")
    return _Squeezed(change.at, len(change.taken), compress(both))


def _opened(kept: TextChange | _Squeezed) -> TextChange:
    if isinstance(kept, TextChange):
        return kept
    both = decompress(kept.data).decode("utf-8", "surrogatepass")
    return TextChange(kept.at, both[: kept.taken], both[kept.taken :])
