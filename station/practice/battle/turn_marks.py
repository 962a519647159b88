"""What a turn is worth once its last stroke was heard: accuracy of an answer, or the marks of an improvisation."""

from station.practice.battle.judging.improvisation_marks import ImprovisationMarks
from station.practice.battle.repeating.answer_marks import AnswerMarks

TurnMarks = AnswerMarks | ImprovisationMarks
