"""Draws the app's picture in a process of its own: `python -m station.bench.rigs.drawer [COUNT]`.

So many pictures, or 60 a second until it is ended. Prints "draws" when the first is there.
"""

import sys
import time
from itertools import count, islice

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.picture import PictureMaker
from station.render.quality import QUALITIES
from station.render.snapshot import Hud, Snapshot

SIZE = (1280, 720)

_KEPT = 12
"""So many moments are drawn in turn (our choice: a fifth of a second)."""
_EVERY_S = 1 / 60


def snapshots(count: int) -> list[Snapshot]:
    """Consecutive frames, 60 a second, of a drummer who plays sixteenths on the hat over kick and snare."""
    notes = [Note(k * PPQ // 4, Piece.HIHAT, Zone.BOW, limb=Limb.RIGHT_HAND) for k in range(64)]
    notes += [Note(k * PPQ, Piece.SNARE if k % 2 else Piece.KICK) for k in range(16)]
    score = Score.from_notes(notes, TempoMap.constant(100.0))
    kit, figure = load_kit(), figure_of()
    drummer = Drummer(score, kit, figure)
    hud = Hud("Sixteenths", "Pass 1 of 4", 1, 2, 4, 4, 100.0, None, 12, 14)
    times = [1.0 + k / 60 for k in range(count)]
    return [Snapshot(score, t, kit, figure, drummer.pose(t), hud=hud) for t in times]


def draw(pictures: int | None) -> None:
    """Draw so many; None goes on for ever."""
    frames = snapshots(_KEPT if pictures is None else min(pictures, _KEPT))
    maker = PictureMaker(SIZE, QUALITIES[0])
    for k in islice(count(), pictures):
        began_s = time.monotonic()
        maker.draw(frames[k % len(frames)])
        if k == 0:
            sys.stdout.write("draws\n")
            sys.stdout.flush()
        if pictures is None:
            time.sleep(max(0.0, began_s + _EVERY_S - time.monotonic()))


if __name__ == "__main__":
    draw(int(sys.argv[1]) if len(sys.argv) > 1 else None)
