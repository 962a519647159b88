"""When rows were written, where backups lie; PostgreSQL sorts texts as SQLite does."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None

_TEXTS: dict[str, dict[str, sa.String]] = {
    "students": {"key": sa.String(), "name": sa.String()},
    "captures": {"sha256": sa.String(64)},
    "sessions": {
        "name": sa.String(),
        "kind": sa.String(20),
        "state": sa.String(20),
        "folder": sa.Text(),
        "lesson": sa.String(),
        "title": sa.Text(),
        "device": sa.Text(),
        "level": sa.String(20),
        "exam": sa.Text(),
        "capture_sha256": sa.String(64),
    },
    "documents": {"name": sa.String()},
    "figures": {"part": sa.String(20), "name": sa.String(40)},
    "judgements": {
        "label": sa.String(20),
        "hit_piece": sa.String(20),
        "hit_zone": sa.String(20),
        "hit_articulation": sa.String(20),
    },
    "mastery": {"lesson": sa.String(), "document": sa.Text()},
    "levels": {"lesson": sa.String(), "level": sa.String(20)},
    "teacher_notes": {
        "note": sa.String(),
        "assignment": sa.String(),
        "title": sa.Text(),
        "teacher": sa.Text(),
        "words": sa.Text(),
        "next": sa.Text(),
    },
}


def upgrade() -> None:
    """Add them."""
    is_postgres = op.get_context().dialect.name == "postgresql"
    for table in ("sessions", "mastery", "levels"):
        op.add_column(table, sa.Column("written", sa.DateTime(), nullable=True))
    text = sa.String(collation="C" if is_postgres else None)
    op.create_table(
        "backups",
        sa.Column("computer", text, nullable=False),
        sa.Column("file", text, nullable=False),
        sa.Column("made", sa.DateTime(), nullable=False),
        sa.PrimaryKeyConstraint("computer", "file", name=op.f("pk_backups")),
    )
    if is_postgres:
        for table, texts in _TEXTS.items():
            for column, kind in texts.items():
                op.alter_column(table, column, type_=type(kind)(kind.length, collation="C"))
