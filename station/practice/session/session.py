"""The practice session as a state machine: engine events and time in, judgements and state out.

It owns no clock, thread, device or window: whoever runs it (the window, the terminal, a headless run, a test) hands
it every event of the engine and now and then the time. Judgement depends on the events' own times alone, so that it
is the same at any frame rate. Session time is monotonic nanoseconds; transport time starts at the engine's zero;
score time at tick 0 of the plan's score.

Without a click the score follows the student (`following.follower`): what the window shows and when the session ends
goes by where they are, and the score waits when they stop.

A hit's score time = its stamp − its pad's latency − (the transport's zero + the output's latency) − the passes' start:
what the student heard and played, compared where both are known (`session.device_latency`).
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from station.core.events import Choke, Hit, PhaseEstimate, StickStroke
from station.core.units import NS_PER_MS
from station.drills.mastery.feedback_fading import Feedback
from station.engine.messages import Annotate, Command, EngineEvent, Play, SetBacking, Started, Stop
from station.music.judgement import Judgement, Label
from station.music.performance import Performance
from station.music.score import Score
from station.practice.session.device_latency import Latency
from station.practice.session.engine_state import EngineState
from station.practice.session.event_log import Ended, PassBegan, Paused, WasUnheard, WentOn, stroke_key, text_of
from station.practice.session.judging import Judging
from station.practice.session.pausing import NEAR_NS, SILENT_BARS, SessionPause, Silence, TransportRun, bar_of, from_bar
from station.practice.session.plan import TAIL_NS, PassSeries, Phase, Plan, Segment
from station.practice.session.played_hands import PlayedHands, limbs_of
from station.practice.session.played_phase import PhasesHeard, PlayedPhase
from station.scoring.align import align
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.unheard import Span, between_hits, merged, notes_within, with_unknown
from station.sound.track import PreparedTrack

LEAD_IN_NS = 300 * NS_PER_MS
"""How long after `start` the first click is heard: time for the engine to wake; our choice."""
EARLIEST_NS = 250 * NS_PER_MS
"""A hit so long before the first bar is still judged, an earlier one belongs to the count-in; our choice."""


@dataclass(frozen=True, slots=True)
class SessionState:
    """What a window shows: the segment, the place on the plan's timeline and in the score.

    With a click the timeline is the transport's; without one it runs as the student plays.
    """

    segment: Segment
    transport_ns: int | None
    score_ns: int | None


@dataclass(frozen=True, eq=False)
class SessionResult:
    """A session when it is over: the plan, what was played in score time, and the final alignment.

    `score` is what is judged: the plan's, or, when the session was stopped early (`complete` False), its strokes up to
    there. `device` is what most hits were played on, `output` what the click was heard on; None where there was none.
    `pauses` are those after which it went on, each by its bar of `score`; `felt` are the hits whose hand the sensors on
    the sticks told, each with its stroke, which is in session time; `phase` where in the drill the sticks were.
    """

    plan: Plan
    score: Score
    performance: Performance
    alignment: Alignment
    latency: Latency
    complete: bool
    device: str | None
    output: str | None = None
    pauses: tuple[SessionPause, ...] = ()
    felt: tuple[tuple[Hit, StickStroke], ...] = ()
    phase: PlayedPhase | None = None
    unheard: tuple[Span, ...] = ()
    """Where in score time no stroke could be heard: missed notes there are unknown."""


@dataclass(eq=False)
class Session:
    """One practice session; call `start`, then `handle` every event and `advance` the time, until `over`.

    `feedback` is what the student is shown while playing (judgement is the same); `message` what to say before it;
    `backing` a track to play along to in the passes; `series` which of several passes it is, where each is a session of
    its own. One that `waits` judges no stroke that comes after a silence in
    which the student has stopped: whoever runs it sees that it `is_left` and pauses.
    """

    plan: Plan
    latency: Latency = field(default_factory=Latency)
    feedback: Feedback = Feedback.TIMING
    message: str = ""
    backing: PreparedTrack | None = None
    waits: bool = False
    series: PassSeries | None = None

    def __post_init__(self) -> None:
        self._judging = Judging(self.plan.score, clocked=self.plan.click is not None)
        self.heard = EngineState(self.latency)
        """What the engine has said."""
        self._now_ns = 0
        self._silence = Silence(self.plan.score)
        self._run = TransportRun(0, 0, self.plan.cues)
        self._held_ns: int | None = None  # the place on the plan's timeline, while nothing moves
        self._has_left = False  # a stroke has come after so long a silence
        self._hands = PlayedHands()
        self._unheard: list[Span] = []  # in score time, as the transport ran
        self.phases = PhasesHeard()
        """Where in the drill the sticks are, while they are tracked."""
        self.paused = False
        """Whether the transport stands and waits for `resume`."""
        self.stopped = False
        """Whether it was ended: nothing moves any more."""
        self.pauses: list[SessionPause] = []
        """The pauses after which the session went on, in order."""

    def start(self) -> tuple[Command, ...]:
        """The commands that set the engine going; the capture learns what is to be judged."""
        began = PassBegan(self.heard.strokes, self.plan, self.latency, self.waits)
        return (Annotate(text_of(began)), *self._play())

    def stop(self) -> tuple[Command, ...]:
        """The commands that end it, at the present that it knows."""
        self.stopped = True
        kept = self.stop_listening()
        return (*kept, Annotate(text_of(Ended(self.heard.strokes, self._now_ns))), Stop())

    def stop_listening(self) -> tuple[Command, ...]:
        """Nothing more is awaited; the commands that keep in the capture what could not be heard until then."""
        told = len(self.heard.unheard)
        self.heard.stop_listening(self._now_ns)
        self._note_unheard(told)
        return self.unheard_texts(told)

    def unheard_texts(self, told: int) -> tuple[Command, ...]:
        """The commands that keep in the capture what could not be heard, but for the first `told` times."""
        return tuple(Annotate(text_of(WasUnheard(self.heard.strokes, *span))) for span in self.heard.unheard[told:])

    def _play(self) -> tuple[Command, ...]:
        play = Play(self._run.cues, LEAD_IN_NS)
        if self.backing is None:
            return (play,)
        return (SetBacking(self.backing, self.plan.passes_start_ns - self._run.jump_ns), play)

    # --- pauses -----------------------------------------------------------------------------------------------------

    @property
    def can_pause(self) -> bool:
        """Whether it may pause now: a session without a click waits for the student by itself."""
        return self.plan.click is not None and self.started and self._held_ns is None and not self.over

    @property
    def is_left(self) -> bool:
        """Whether the student has stopped: bars with notes went by without a stroke."""
        score_ns = self.state().score_ns
        return self.can_pause and score_ns is not None and (self._has_left or self._is_silent_at(score_ns))

    def _is_silent_at(self, score_ns: int) -> bool:
        return self._silence.bars(self._judging.last_ns, self._run.from_ns, score_ns) >= SILENT_BARS

    def pause(self, command: Sequence[Hit] = ()) -> tuple[Command, ...]:
        """Stand still until `resume`; the commands for it, none where it may not pause.

        The strokes of the `command` itself were not played to the score.
        """
        if not self.can_pause:
            return ()
        meant = [replace(hit, at_ns=at_ns) for hit in command if (at_ns := self._score_of(hit)) is not None]
        self._judging.leave_out(meant)
        self._held_ns, self.paused, self._has_left = self._plan_ns(), True, False
        said = Paused(self.heard.strokes, self._now_ns, tuple(stroke_key(hit) for hit in command))
        return (Annotate(text_of(said)), Stop())

    def resume(self, asked: bool = True, whole: bool = False) -> tuple[Command, ...]:
        """Go on from the bar of the last stroke, or from the beginning where the `whole` is to be judged.

        What was played from there on is taken back; `asked` is kept with the pause. The commands for it.
        """
        if not self.paused:
            return ()
        bar = 0 if whole else bar_of(self.plan.score, self._judging.last_ns)
        self._run = from_bar(self.plan, bar)
        self.pauses.append(SessionPause(bar, asked, self._judging.forget_from(self._run.from_ns)))
        self._unheard = [
            (begin, min(end, self._run.from_ns)) for begin, end in self._unheard if begin < self._run.from_ns
        ]
        self.heard.zero_ns, self.paused = None, False
        self._held_ns = self.plan.passes_start_ns + self._run.from_ns
        return (Annotate(text_of(WentOn(self.heard.strokes, asked, whole))), *self._play())

    # --- input ------------------------------------------------------------------------------------------------------

    def handle(self, event: EngineEvent) -> tuple[Judgement, ...]:
        """Take one event; returns what was judged because of it."""
        told = len(self.heard.unheard)
        self.heard.handle(event)
        taken_back = self._note_unheard(told)
        match event:
            case Hit():
                return (*taken_back, *self._handle_hit(event))
            case Started() if not self.paused:
                self._held_ns = None
            case Choke():
                if self._held_ns is None and (score_ns := self._score_of(event)) is not None:
                    self._judging.chokes.append(replace(event, at_ns=score_ns))
            case StickStroke():
                self._hands.strokes.append(event)
            case PhaseEstimate():
                self.phases.handle(event)
            case _:
                pass
        return taken_back

    def _note_unheard(self, told: int) -> tuple[Judgement, ...]:
        """Bring what could not be heard, but for the first `told` times, to score time; the misses that it takes back.

        What lies before the present run of the transport was judged in another one.
        """
        taken_back: tuple[Judgement, ...] = ()
        for from_ns, until_ns in self.heard.unheard[told:]:
            begin_ns, end_ns = self._score_ns(from_ns), self._score_ns(until_ns)
            if begin_ns is None or end_ns is None or self._held_ns is not None:
                continue
            span = (max(begin_ns, self._run.from_ns), end_ns)
            self._unheard.append(span)
            taken_back += self._judging.not_heard(span)
        return taken_back

    def advance(self, now_ns: int) -> tuple[Judgement, ...]:
        """Tell the session time; returns the misses that it makes certain."""
        self._now_ns = max(now_ns, self._now_ns)
        score_ns = self._score_ns(self._now_ns)
        if score_ns is None or self._held_ns is not None:
            return ()
        return self._judging.advance(score_ns)

    def _handle_hit(self, hit: Hit) -> tuple[Judgement, ...]:
        score_ns = self._score_of(hit)
        if score_ns is None or self._held_ns is not None or not self._is_judged(score_ns):
            return ()
        if self.waits and self.plan.click is not None and (self._has_left or self._is_silent_at(score_ns)):
            self._has_left = True  # they come back: however rarely anybody looks, the silence before it counts
            return ()
        judged = replace(hit, at_ns=score_ns)
        self._hands.judged(judged, hit.at_ns - self.latency.of_stroke(hit.device, hit.piece))
        return self._judging.hit(judged)

    # --- output -----------------------------------------------------------------------------------------------------

    @property
    def started(self) -> bool:
        """Whether the transport runs or ran."""
        return self.heard.zero_ns is not None or self._held_ns is not None

    @property
    def over(self) -> bool:
        """Whether the last bar and the tail after it have passed."""
        at_ns = self._plan_ns()
        return at_ns is not None and at_ns >= self.plan.end_ns + TAIL_NS

    @property
    def is_waiting(self) -> bool:
        """Whether the score waits for a student without a click, who has not played on."""
        transport_ns = self.heard.transport_ns(self._now_ns)
        if self.plan.click is not None or self._held_ns is not None or transport_ns is None or self.over:
            return False
        at_ns = transport_ns - self.plan.passes_start_ns
        return at_ns >= 0 and self._judging.is_waiting(at_ns)

    @property
    def beats_behind(self) -> float:
        """Quarters by which the student came in behind the click and plays on; negative ahead of it."""
        return self._judging.beats_behind

    @property
    def pace(self) -> float:
        """How many times as fast as written the student plays; 1 by the click."""
        return self._judging.pace

    def state(self) -> SessionState:
        """What is going on, as of the last `advance`."""
        plan_ns = self._plan_ns()
        return SessionState(
            segment=self._segment(plan_ns),
            transport_ns=plan_ns,
            score_ns=None if plan_ns is None else plan_ns - self.plan.passes_start_ns,
        )

    def _segment(self, plan_ns: int | None) -> Segment:
        """What goes on at a place of the plan's timeline; after a pause a bar of count-in comes first."""
        begins_ns = self.plan.passes_start_ns + self._run.from_ns
        if self.pauses and plan_ns is not None and plan_ns < begins_ns:
            return Segment(Phase.COUNT_IN, 0, self._run.jump_ns, begins_ns)
        return self.plan.segment_at(plan_ns if plan_ns is not None else -1)

    @property
    def verdicts(self) -> Mapping[int, Judgement]:
        """The newest verdict on every note that has one, by the note's index in the plan's score."""
        return self._judging.of_note

    @property
    def hits(self) -> Sequence[Hit]:
        """The hits that are judged, in score time, in the order in which they came: `hit_index` counts them."""
        return self._judging.hits

    def shown(self, verdicts: Iterable[Judgement]) -> tuple[Judgement, ...]:
        """What the student is shown of `verdicts`: all; right and wrong, without time and strength; nothing."""
        if self.feedback is Feedback.NONE:
            return ()
        if self.feedback is Feedback.TIMING:
            return tuple(verdicts)
        matched = Label.MATCH
        return tuple(replace(v, asynchrony_ns=None, velocity_error=None) if v.label is matched else v for v in verdicts)

    def extras(self) -> list[int]:
        """Indices of the hits that answer no note, as far as is known."""
        return self._judging.extras()

    def result(self) -> SessionResult:
        """The final alignment of all that was heard so far."""
        felt = self._hands.felt(self._judging.hits)
        performance, last_ns = self._judging.performance(limbs_of(self._judging.hits, felt)), self._judging.last_ns
        heard_until_ns = self.state().score_ns
        if self.paused:  # what came after the last stroke is nobody's
            heard_until_ns = 0 if last_ns is None else last_ns + NEAR_NS
        complete = heard_until_ns is not None and heard_until_ns >= self.plan.score.length_ns
        score = self.plan.score if complete else self.plan.score.until_ns(heard_until_ns or 0)
        alignment = align(score, performance, clocked=self.plan.click is not None)
        unheard = self._unheard_places(alignment)
        alignment = with_unknown(alignment, notes_within(score, unheard))
        return SessionResult(
            self.plan,
            score,
            performance,
            alignment,
            self.latency,
            complete,
            self._played_on(),
            self.heard.output,
            tuple(self.pauses),
            tuple((hit, stroke) for hit, stroke in zip(self._judging.hits, felt, strict=False) if stroke is not None),
            self.phases.played(
                self.plan.section,
                self.plan.lesson.beat_ticks,
                self._hands.strokes,
                self._hands.span_ns(self._judging.hits),
            ),
            unheard,
        )

    def _unheard_places(self, alignment: Alignment) -> tuple[Span, ...]:
        """Where in the score the student was while nothing could be heard: by the click, else by their strokes."""
        spans = self._unheard
        if self.heard.deaf_since_ns is not None and self._held_ns is None:
            begin_ns, end_ns = self._score_ns(self.heard.deaf_since_ns), self._score_ns(self._now_ns)
            if begin_ns is not None and end_ns is not None:
                spans = [*spans, (max(begin_ns, self._run.from_ns), max(begin_ns, end_ns))]
        if self.plan.click is not None:
            return merged(spans)
        hit_ns = np.sort([hit.at_ns for hit in self._judging.hits])
        return merged(between_hits(alignment, hit_ns, span) for span in merged(spans))

    def _played_on(self) -> str | None:
        return Counter(hit.device for hit in self.hits).most_common(1)[0][0] if self.hits else None

    # --- time -------------------------------------------------------------------------------------------------------

    def _score_ns(self, at_ns: int) -> int | None:
        transport_ns = self.heard.transport_ns(at_ns)
        return None if transport_ns is None else transport_ns + self._run.jump_ns - self.plan.passes_start_ns

    def _score_of(self, stroke: Hit | Choke) -> int | None:
        """When in the score `stroke` was played."""
        played_ns = self.heard.played_ns(stroke)
        return None if played_ns is None else played_ns + self._run.jump_ns - self.plan.passes_start_ns

    def _plan_ns(self) -> int | None:
        """The place on the plan's timeline now: the transport's, or the student's where no click rules the passes."""
        if self._held_ns is not None:
            return self._held_ns
        transport_ns, start_ns = self.heard.transport_ns(self._now_ns), self.plan.passes_start_ns
        if transport_ns is None or self.plan.click is not None or transport_ns < start_ns:
            return None if transport_ns is None else transport_ns + self._run.jump_ns
        return start_ns + self._judging.place_ns(transport_ns - start_ns)

    def _is_judged(self, score_ns: int) -> bool:
        if self.plan.click is None:
            return score_ns >= -EARLIEST_NS
        return self._run.from_ns - EARLIEST_NS <= score_ns <= self.plan.score.length_ns + TAIL_NS
