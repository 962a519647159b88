"""`station history`: what was practised, and what a user may do with it."""

from station.cli.history_verbs import list_sessions, show_session
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
    ),
    usual="list",
)
