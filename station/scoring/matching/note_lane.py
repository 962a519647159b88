"""The notes of one match class and the hits on it so far, for whoever pairs them as they come.

Times are ns on the score's axis.
"""

from bisect import bisect_left, bisect_right


class Lane:
    """Notes and hits of one match class, each as parallel lists (index, time) in order of time."""

    __slots__ = ("hit_ns", "hits", "note_ns", "notes")

    def __init__(self, notes: list[int], note_ns: list[int]) -> None:
        self.notes, self.note_ns = notes, note_ns
        self.hits: list[int] = []
        self.hit_ns: list[int] = []

    def put(self, hit: int, at_ns: int) -> None:
        """Hear `hit`, in order of time behind those of the same moment."""
        place = bisect_right(self.hit_ns, at_ns)
        self.hit_ns.insert(place, at_ns)
        self.hits.insert(place, hit)

    def remove(self, hit: int, at_ns: int) -> None:
        """Remove `hit` if it is here."""
        place = bisect_left(self.hit_ns, at_ns)
        while place < len(self.hits) and self.hit_ns[place] == at_ns and self.hits[place] != hit:
            place += 1
        if place < len(self.hits) and self.hits[place] == hit:
            del self.hits[place], self.hit_ns[place]

    def forget_from(self, start_ns: int) -> None:
        """Leave out the hits from `start_ns` on."""
        place = bisect_left(self.hit_ns, start_ns)
        del self.hits[place:], self.hit_ns[place:]

    def hits_between(self, start_ns: int, end_ns: int) -> slice:
        """Where in the lists the hits from `start_ns` to `end_ns` inclusive stand."""
        return slice(bisect_left(self.hit_ns, start_ns), bisect_right(self.hit_ns, end_ns))

    def notes_between(self, start_ns: int, end_ns: int) -> slice:
        """Where in the lists the notes from `start_ns` to `end_ns` inclusive stand."""
        return slice(bisect_left(self.note_ns, start_ns), bisect_right(self.note_ns, end_ns))
