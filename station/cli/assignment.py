"""`station assignment`: what a teacher gives, a student practises and sends back, and the teacher answers, as files."""

from station.cli.exchange.student_verbs import (
    FileOptions,
    ListOptions,
    ReturnOptions,
    list_taken,
    make_return,
    take_file,
    take_note,
)
from station.cli.exchange.teacher_verbs import (
    AnswerOptions,
    NewOptions,
    ReceiveOptions,
    ReviewOptions,
    answer,
    make_assignment,
    receive_files,
    review,
)
from station.cli.options.option_fields import Command, Verbs

COMMAND = Verbs(
    (
        ("take", "take an assignment that came: its lessons are among yours", Command(FileOptions, take_file)),
        ("list", "the assignments that you have taken, and what is done of them", Command(ListOptions, list_taken)),
        ("return", "write what you practised of an assignment for your teacher", Command(ReturnOptions, make_return)),
        ("note", "keep and show a note that came back from your teacher", Command(FileOptions, take_note)),
        ("new", "give lessons to practise, as one file", Command(NewOptions, make_assignment)),
        ("receive", "keep returns that came from students", Command(ReceiveOptions, receive_files)),
        ("review", "what came back, per student and lesson", Command(ReviewOptions, review)),
        ("answer", "write a note on a return for the student", Command(AnswerOptions, answer)),
    )
)
