"""Score a take without the command line: a lesson, a simulated student, the alignment and what it says.

Run it with `python examples/score_a_take.py`. Everything here is the core: it needs no kit, sound or window.
"""

from station.drills.library import find_lesson
from station.practice.records.report.session_report import assessment_text
from station.scoring.align import align
from station.scoring.analysis.summary import summarise
from station.scoring.report.assessment_document import assessment
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play


def main() -> None:
    """Let a beginner play the first lesson once, and print what the station hears."""
    score = find_lesson("rock-1").score
    take = play(score, parse_spec("beginner,seed=7")).performance
    alignment = align(score, take, clocked=True)
    print(assessment_text(assessment(summarise(score, take, alignment))))


if __name__ == "__main__":
    main()
