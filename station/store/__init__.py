"""The history: what was practised, how it went and what is known of a student, in one database.

In: rows (frozen values) of sessions, judgements, captures, mastery. Out: the same, and sums over weeks.
SQLite in the user's data folder by default, PostgreSQL by a URL; SQLAlchemy and Alembic are known here alone.
Read `tables` first, then `history`.
"""
