"""How long a database may keep us waiting, in seconds."""

PATIENCE_S = 10.0
"""So long a writer waits for another (our choice: a hundred times what a long session takes to be kept)."""
CONNECT_S = 3
"""So long a server may take to answer (our choice: what a user waits without asking)."""
ANSWER_S = 60.0
"""So long a server may work on one statement (our choice: a school's whole history is read in less)."""
