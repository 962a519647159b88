"""`station history`: what was practised, and what a user may do with it."""

from station.cli.history_verbs import copies, delete_student, export_student, list_sessions, show_session
from station.cli.options.option_fields import Command, Verbs

COMMAND = Verbs(
    (
        (
            "list",
            "the sessions that are kept, and what they come to",
            Command(list_sessions.ListOptions, list_sessions.run),
        ),
        (
            "show",
            "what is kept of a session, and where its files are",
            Command(show_session.ShowOptions, show_session.run),
        ),
        (
            "export",
            "write everything that a student owns as CSV, JSON and captures",
            Command(export_student.ExportOptions, export_student.run),
        ),
        (
            "delete",
            "delete everything of a student: history, folder, settings",
            Command(delete_student.DeleteOptions, delete_student.run),
        ),
        (
            "backup",
            "write the history of all students into one file",
            Command(copies.BackupOptions, copies.back_up),
        ),
        (
            "copy",
            "add the history to another database, such as a school's",
            Command(copies.CopyOptions, copies.copy),
        ),
    ),
    usual="list",
)
