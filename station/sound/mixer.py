"""The mixer: strokes, chokes and clicks in, stereo blocks out; pure numpy, no thread, no clock, no card.

Time base: frames since the mixer was made, at the kit's rate. An action falls on the frame it was asked for, whatever
the block size: a block is rendered in pieces that end where an action is due, so the same actions give the same sound
however the frames are asked for. Pieces hold at most `PIECE_FRAMES` frames: numpy keeps the lock for short arrays.

Each ringing voice is copied into one row of a matrix; one product with the voices' gains (and slopes, for those that
fade) sums them by bus. A voice that must go before its end fades in a straight line, so nothing clicks. The sum passes
a limiter without look-ahead: linear to its knee, then a curve that never exceeds full scale.
"""

import heapq
from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece
from station.core.sound_names import SoundName
from station.sound.bus_levels import BusLevels, sides_of
from station.sound.buses import Bus, ClickVoice
from station.sound.drum_kit import MAX_VELOCITY, DrumKit, Frames, Sound, level_of
from station.sound.limiter import soft_clip
from station.sound.track import Track, TrackPlayer
from station.sound.voice import Voice

PIECE_FRAMES = 250
"""numpy gives up the interpreter lock for operations on more than about 500 numbers; a frame has two."""

MAX_VOICES = 32
HEARD = 32
"""Numbers at the start of a voice's last piece that tell how loud it is."""
SAME_PIECE_VOICES = 6
"""Our choice: so many strokes of one piece ring at once; a roll does not eat the voices of the others."""

STEAL_S = 0.005
RETIRE_S = 0.08
CHOKE_S = 0.05
"""A hand stops a cymbal within some 50 ms (our choice)."""
CLOSE_S = 0.04
"""So long a ringing hi-hat takes to fall silent as the pedal closes it (our choice)."""
MUTE_S = 0.03
"""So long a sound takes to fall silent that another of its mute group stops (our choice: a hand's choke is slower)."""
HALF_OPEN_RING_S = 0.9
"""So long a hi-hat rings on that the pedal has brought from open to openness ½ (our choice: as its half-open sound)."""
_BUSES = len(Bus)


class Mixer:
    """Plays one drum kit, the click and a track to play along to, each on its bus."""

    def __init__(self, kit: DrumKit, clicks: Mapping[ClickVoice, Frames], max_voices: int = MAX_VOICES) -> None:
        self.kit = kit
        self.frame = 0
        """The frame that the next block starts with."""
        self._clicks = clicks
        self._voices: list[Voice] = []
        self._free_rows = list(range(max_voices))
        self._turns: dict[SoundName, int] = {}
        self._pending: list[tuple[int, int, Callable[[], None]]] = []
        self._order = 0
        self._rows = np.zeros((max_voices, 2 * PIECE_FRAMES), np.float32)
        self._gains = np.zeros((max_voices, 2 * _BUSES), np.float32)
        self._tail = np.zeros((_BUSES, 2 * max(1, self._frames(STEAL_S))), np.float32)
        self._ramp = np.repeat(np.arange(max(PIECE_FRAMES, self._tail.shape[1] // 2), dtype=np.float32), 2)
        self._tail_left = 0
        self._levels = BusLevels(kit.rate_hz)
        self._of_pieces: dict[Piece, tuple[float, NDArray[np.float32] | None]] = {}  # level, and the factors of its pan
        self._tracks = TrackPlayer()

    # --- what to play --------------------------------------------------------------------------------------------

    def trigger(self, bus: Bus, strike: NoteMeaning, velocity: float, at_frame: int = 0) -> None:
        """Sound a stroke of `velocity` 1 ≤ v < 128 on `bus`, `at_frame` frames after the start of the next block.

        `strike.openness` (None counts as closed) chooses the hi-hat's sound and damps one that rings more open; the
        foot's chick stops it.
        """
        assert 1 <= velocity < MAX_VELOCITY + 1, "a stroke has a MIDI velocity"
        self._at(at_frame, partial(self._strike, bus, strike, velocity))

    def click(self, voice: ClickVoice, velocity: int = MAX_VELOCITY, at_frame: int = 0) -> None:
        """Sound a click of `velocity` 0 (silent) … 127, `at_frame` frames after the start of the next block."""
        assert 0 <= velocity <= MAX_VELOCITY, "a click has a MIDI velocity"
        self._at(at_frame, partial(self._click, voice, velocity))

    def choke(self, bus: Bus, piece: Piece, at_frame: int = 0) -> None:
        """Grab the ringing `piece`: it falls silent within `CHOKE_S`."""
        self._at(at_frame, partial(self._choke, bus, piece))

    def pedal(self, bus: Bus, openness: float, at_frame: int = 0) -> None:
        """Move the hi-hat's pedal: what rings more open than `openness` 0 closed … 1 open is damped accordingly."""
        self._at(at_frame, partial(self._damp_hihat, bus, openness))

    def play_track(self, track: Track, at_frame: int = 0) -> None:
        """Play `track` on the backing bus, in place of one that plays, from `at_frame` of the next block on."""
        assert track.rate_hz == self.kit.rate_hz, "a track is prepared for the card's rate"
        self._at(at_frame, partial(self._tracks.play, track))

    def stop_track(self) -> None:
        """Fade the track out."""
        self._tracks.stop()

    def keep_track_at(self, position: int) -> None:
        """Bring the playing track to `position`, the frames since its start that the next block should begin with."""
        self._tracks.keep_at(position)

    def use(self, kit: DrumKit, clicks: Mapping[ClickVoice, Frames]) -> None:
        """Sound what begins from now on by this kit and these clicks; what rings, rings out."""
        assert kit.rate_hz == self.kit.rate_hz, "a kit is read for the card's rate"
        self.kit, self._clicks = kit, clicks
        self._turns.clear()

    def set_level(self, bus: Bus, level: float, pan: float = 0.0) -> None:
        """Set the level (0 silent, 1 full) and balance (−1 left … 1 right) of `bus`, from the next block on."""
        self._levels.set(bus, level, pan)

    def set_piece(self, piece: Piece, level: float, pan: float = 0.0) -> None:
        """Set the level (0 silent, 1 as the kit has it) and balance of `piece`, from its next stroke on."""
        sides = np.tile(np.array(sides_of(pan), np.float32), len(self._ramp) // 2) if pan else None
        self._of_pieces[piece] = level, sides

    def silence(self) -> None:
        """Forget all that rings and all that was asked for, at once: for a mixer that nobody has listened to."""
        self._pending.clear()
        for voice in list(self._voices):
            self._release(voice)
        self._tail[:] = 0.0
        self._tail_left = 0
        self._tracks.forget()

    @property
    def ringing(self) -> int:
        """How many voices sound now."""
        return len(self._voices)

    # --- the blocks ----------------------------------------------------------------------------------------------

    def render(self, frames: int) -> Frames:
        """The next `frames` frames: float32 (frames, 2), all within ±1."""
        block = np.empty((frames, 2), np.float32)
        done = 0
        while done < frames:
            self._begin_due()
            count = self._piece_length(frames - done)
            self._mix(count, block[done : done + count])
            self.frame += count
            done += count
        return soft_clip(block)

    def _piece_length(self, wanted: int) -> int:
        count = min(wanted, PIECE_FRAMES)
        if self._pending:
            count = min(count, self._pending[0][0] - self.frame)
        if self._levels.moving:
            count = min(count, self._levels.moving)
        return count

    def _mix(self, count: int, out: Frames) -> None:
        """Write the next `count` frames, before the limiter, to `out`."""
        size = 2 * count
        buses = self._sum_voices(size)
        if self._tail_left:
            self._add_tail(buses, size)
        if self._tracks.plays:
            self._tracks.add_to(buses[Bus.BACKING], count)
        self._levels.sum(buses.reshape(_BUSES, count, 2), out)

    def _sum_voices(self, size: int) -> NDArray[np.float32]:
        """The buses, (buses, size) interleaved, of the next `size`/2 frames; voices that end are let go."""
        if not self._voices:
            return np.zeros((_BUSES, size), np.float32)
        rows = self._rows[:, :size]
        fading = [voice for voice in self._voices if voice.fading]
        for voice in fading:
            self._gains[voice.row, voice.bus] = voice.gain
            self._gains[voice.row, _BUSES + voice.bus] = voice.slope
        ended = [voice for voice in self._voices if not voice.copy_to(rows[voice.row])]
        sums = self._gains.T.dot(rows)
        buses: NDArray[np.float32] = sums[:_BUSES]
        if fading:
            buses += sums[_BUSES:] * self._ramp[:size]
        for voice in ended:
            self._release(voice)
        return buses

    def _release(self, voice: Voice) -> None:
        """Let a voice go: its row is free, and silent until another takes it."""
        self._voices.remove(voice)
        self._gains[voice.row] = 0.0
        self._free_rows.append(voice.row)

    def _add_tail(self, buses: NDArray[np.float32], size: int) -> None:
        """Add what stolen voices left behind, and move it on."""
        tail = self._tail
        width = min(size, tail.shape[1])
        buses[:, :width] += tail[:, :width]
        tail[:, : tail.shape[1] - width] = tail[:, width:].copy()
        tail[:, tail.shape[1] - width :] = 0.0
        self._tail_left = max(0, self._tail_left - width)

    # --- actions -------------------------------------------------------------------------------------------------

    def _at(self, at_frame: int, action: Callable[[], None]) -> None:
        heapq.heappush(self._pending, (self.frame + max(0, at_frame), self._order, action))
        self._order += 1

    def _begin_due(self) -> None:
        while self._pending and self._pending[0][0] <= self.frame:
            heapq.heappop(self._pending)[2]()

    def _strike(self, bus: Bus, strike: NoteMeaning, velocity: float) -> None:
        name, sound, timbre = self.kit.choose(strike)
        turn = self._turns.get(name, 0)
        self._turns[name] = turn + 1
        piece, openness = strike.piece, strike.openness or 0.0
        if piece in (Piece.HIHAT, Piece.HIHAT_PEDAL):
            splashes = strike.articulation is Articulation.SPLASH
            if piece is Piece.HIHAT_PEDAL:
                openness = 0.0
            self._damp_hihat(bus, openness)
            piece, openness = Piece.HIHAT, 1.0 if splashes else openness
        level, sides = self._of_pieces.get(strike.piece, (1.0, None))
        gain = level * sound.level(velocity)
        voice = Voice(sound.frames_for(max(1.0, int(velocity) * timbre), turn), bus, gain, piece, openness)
        voice.sides = sides
        if sound.mute_group is not None:
            self._mute_group(bus, sound)
            voice.sound = sound
        self._begin(voice)

    def _click(self, voice: ClickVoice, velocity: int) -> None:
        self._begin(Voice(self._clicks[voice], Bus.CLICK, level_of(velocity), None))

    def _begin(self, voice: Voice) -> None:
        self._retire_oldest(voice)
        if not self._free_rows:
            self._steal(self._quietest())
        voice.row = self._free_rows.pop()
        self._voices.append(voice)
        self._gains[voice.row, voice.bus] = voice.gain

    def _retire_oldest(self, newcomer: Voice) -> None:
        """Fade the oldest voice of the newcomer's piece where too many ring."""
        if newcomer.piece is None:
            return
        same = [v for v in self._voices if v.piece is newcomer.piece and v.bus is newcomer.bus and not v.fading]
        if len(same) >= SAME_PIECE_VOICES:
            max(same, key=lambda voice: voice.position).fade_within(self._frames(RETIRE_S))

    def _steal(self, voice: Voice) -> None:
        """Free the place of `voice`; its last milliseconds fade out in the tail."""
        rest = np.zeros(self._tail.shape[1], np.float32)
        voice.fade_within(len(rest) // 2)
        gain, slope = voice.gain, voice.slope
        voice.copy_to(rest)
        self._tail[voice.bus] += rest * (gain + slope * self._ramp[: len(rest)])
        self._tail_left = len(rest)
        self._release(voice)

    def _quietest(self) -> Voice:
        """The voice that was quietest when it was last mixed; one that has yet to begin goes only where all have."""
        loudness = np.abs(self._rows[:, :HEARD]).max(axis=1) * self._gains[:, :_BUSES].max(axis=1)
        begun = [voice for voice in self._voices if voice.position] or self._voices
        return begun[int(loudness[[voice.row for voice in begun]].argmin())]

    def _choke(self, bus: Bus, piece: Piece) -> None:
        self._fade(lambda voice: voice.bus is bus and voice.piece is piece, CHOKE_S)

    def _damp_hihat(self, bus: Bus, openness: float) -> None:
        ring_s = CLOSE_S + (HALF_OPEN_RING_S - CLOSE_S) * min(1.0, 2.0 * openness) ** 2
        self._fade(lambda v: v.bus is bus and v.piece is Piece.HIHAT and v.openness > openness, ring_s)

    def _mute_group(self, bus: Bus, sound: Sound) -> None:
        """Stop what rings of the group of `sound`, other than itself."""

        def is_rival(voice: Voice) -> bool:
            rival = voice.sound
            return rival is not None and rival is not sound and rival.mute_group == sound.mute_group

        self._fade(lambda voice: voice.bus is bus and is_rival(voice), MUTE_S)

    def _fade(self, chosen: Callable[[Voice], bool], within_s: float) -> None:
        for voice in self._voices:
            if chosen(voice):
                voice.fade_within(self._frames(within_s))

    def _frames(self, seconds: float) -> int:
        return round(seconds * self.kit.rate_hz)
