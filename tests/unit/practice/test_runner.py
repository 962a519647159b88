"""What moves a session on, step by step: passes, refusals, the end. Events and times are laid out by hand.

Rock at 80 quarters a minute for plans; where the tempo follows the student it begins at 70 % of the target.
"""

from collections.abc import Sequence
from datetime import date

import pytest

from station.core.events import DeviceFound, Hit, Switched
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Annotate, EngineEvent, Play, Started, Stop
from station.music.judgement import Judgement, Label
from station.practice.control.pad_commands import PadCommands
from station.practice.session.adaptation import Adaptation
from station.practice.session.device_latency import Latency
from station.practice.session.plan import TAIL_NS, PlanOptions, plan_practice
from station.practice.session.runner import SessionRunner, Update

LESSON = find_lesson("rock-1")
PLAN = plan_practice(LESSON, PlanOptions(tempo_bpm=80.0, loops=1, demonstrations=0))
ZERO_NS = 5 * NS_PER_S


def stroke(at_ns: int, piece: Piece = Piece.SNARE) -> Hit:
    return Hit(at_ns, piece, Zone.HEAD, 90)


def played() -> list[EngineEvent]:
    """Every note of the plan, each 20 ms late, and what the engine says before."""
    notes = zip(PLAN.score.onset_ns.tolist(), PLAN.score.notes["piece"].tolist(), strict=True)
    start_ns = ZERO_NS + PLAN.passes_start_ns + 20 * NS_PER_MS
    return [DeviceFound(0, "kit"), Started(ZERO_NS), *(stroke(start_ns + at, Piece(piece)) for at, piece in notes)]


def looked_at(look_ns: int) -> tuple[SessionRunner, list[Judgement]]:
    """A whole session of what was `played`, looked at every `look_ns`."""
    runner, coming, judged, now_ns = SessionRunner(PLAN, Latency()), played(), list[Judgement](), 0
    runner.start()
    while not runner.over:
        now_ns += look_ns
        come = [event for event in coming if not isinstance(event, Hit) or event.at_ns <= now_ns]
        coming = coming[len(come) :]
        judged += runner.update(now_ns, come).judged
    return runner, judged


@pytest.mark.parametrize("looks_a_second", [1, 30, 240])
def test_every_note_is_right_however_often_anybody_looks(looks_a_second: int) -> None:
    runner, judged = looked_at(NS_PER_S // looks_a_second)
    assert [verdict.label for verdict in judged] == [Label.MATCH] * len(PLAN.score)
    assert {verdict.asynchrony_ns for verdict in judged} == {20 * NS_PER_MS}
    result = runner.finish()
    assert result.complete
    assert result.alignment.count(Label.MATCH) == len(PLAN.score)


def adaptive(loops: int = 3) -> tuple[SessionRunner, Adaptation]:
    adaptation = Adaptation(LESSON, PlanOptions(loops=loops, demonstrations=0), date(2026, 3, 1))
    return SessionRunner(adaptation, Latency()), adaptation


def through(runner: SessionRunner, zero_ns: int) -> Update:
    """The pass that was started, to its end, with one stroke in it; the step that ended it."""
    runner.update(zero_ns, [Started(zero_ns), stroke(zero_ns + 10 * NS_PER_S)])
    return runner.update(zero_ns + runner.session.plan.end_ns + TAIL_NS, [])


def kinds(commands: Sequence[object]) -> list[type]:
    return [type(command) for command in commands]


def test_the_next_pass_begins_by_itself_on_the_same_kit_until_there_is_none() -> None:
    runner, adaptation = adaptive(loops=2)
    runner.handle(DeviceFound(0, "kit"))
    assert kinds(runner.start()) == [Annotate, Play]
    first = runner.session
    ended = through(runner, ZERO_NS)
    assert ended.session is first
    assert kinds(ended.commands) == [Annotate, Play]
    assert (runner.heard.devices, runner.over) == (["kit"], False)
    assert runner.session is not first
    last = through(runner, 100 * NS_PER_S)
    assert (last.commands, runner.over, len(adaptation.rounds)) == ((), True, 2)
    assert len(runner.finish().performance) == 2
    assert len(adaptation.rounds) == 2, "what was taken is taken once"


def test_a_pass_that_is_stopped_counts_and_one_that_never_sounded_is_nobodys() -> None:
    for says, rounds in (([Started(100 * NS_PER_S)], 2), ([], 1)):
        runner, adaptation = adaptive()
        runner.start()
        through(runner, ZERO_NS)
        runner.update(101 * NS_PER_S, says)
        assert kinds(runner.stop()) == [Annotate, Stop]
        runner.finish()
        assert len(adaptation.rounds) == rounds


def test_a_refused_pass_is_nobodys_and_the_last_one_comes_once_more() -> None:
    runner, adaptation = adaptive()
    runner.start()
    tempo_bpm = runner.session.plan.tempo_bpm
    through(runner, ZERO_NS)
    assert runner.session.plan.tempo_bpm < tempo_bpm
    runner.update(101 * NS_PER_S, [Started(100 * NS_PER_S)])
    assert kinds(runner.veto()) == [Annotate, Play]
    assert runner.session.plan.tempo_bpm == pytest.approx(tempo_bpm)
    runner.stop()
    runner.finish()
    assert len(adaptation.rounds) == 1


def test_pads_pause_and_go_on_until_the_end_was_asked_for() -> None:
    runner = SessionRunner(PLAN, Latency(), PadCommands(Settings(), PLAN.score))
    runner.start()
    runner.update(ZERO_NS, [Started(ZERO_NS)])
    switch = Switched(ZERO_NS + NS_PER_S, "cc=64")
    paused = runner.update(switch.at_ns, [switch])
    assert (kinds(paused.commands), paused.is_anew) == ([Annotate, Stop], True)
    gone_on = runner.update(switch.at_ns + NS_PER_S, [Switched(switch.at_ns + NS_PER_S, "cc=64")])
    assert kinds(gone_on.commands) == [Annotate, Play]
    runner.update(switch.at_ns + 2 * NS_PER_S, [Started(switch.at_ns + 2 * NS_PER_S)])
    runner.stop()
    assert runner.handle(Switched(switch.at_ns + 4 * NS_PER_S, "cc=64")).commands == ()
    assert not runner.session.paused


def test_silence_pauses_who_waits_once() -> None:
    """Two bars of three seconds with notes, and none of them struck."""
    plan = plan_practice(LESSON, PlanOptions(tempo_bpm=80.0, loops=3, demonstrations=0))
    runner = SessionRunner(plan, Latency())
    runner.session.waits = True
    runner.start()
    runner.update(ZERO_NS, [Started(ZERO_NS)])
    start_ns = ZERO_NS + plan.passes_start_ns
    assert runner.update(start_ns + 5 * NS_PER_S, []).commands == ()
    assert kinds(runner.update(start_ns + 7 * NS_PER_S, []).commands) == [Annotate, Stop]
    assert runner.update(start_ns + 8 * NS_PER_S, []).commands == ()
