"""What the document of an assessment is called; whoever only reads one needs no more of what makes it."""

SCHEMA = "drum-station/assessment/1"
