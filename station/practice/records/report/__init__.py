"""What a session's report says, for people and programs: its document and its words, and what to practise next.

`session_report` puts it together of what the others add; read it first.
"""
