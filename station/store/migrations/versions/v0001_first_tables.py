"""The first tables: students, sessions, their documents, figures and judgements, captures, memory, teachers' notes."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Make them."""
    op.create_table(
        "captures",
        sa.Column("sha256", sa.String(length=64), nullable=False),
        sa.Column("length", sa.Integer(), nullable=False),
        sa.Column("body", sa.LargeBinary(), nullable=False),
        sa.PrimaryKeyConstraint("sha256", name=op.f("pk_captures")),
    )
    op.create_table(
        "students",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("key", sa.String(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_students")),
        sa.UniqueConstraint("key", name=op.f("uq_students_key")),
    )
    op.create_table(
        "levels",
        sa.Column("student_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("lesson", sa.String(), nullable=False),
        sa.Column("level", sa.String(length=20), nullable=False),
        sa.ForeignKeyConstraint(["student_id"], ["students.id"], name=op.f("fk_levels_student_id"), ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("student_id", "lesson", name=op.f("pk_levels")),
    )
    op.create_table(
        "mastery",
        sa.Column("student_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("lesson", sa.String(), nullable=False),
        sa.Column("first_bar", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("last_bar", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("document", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(
            ["student_id"], ["students.id"], name=op.f("fk_mastery_student_id"), ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("student_id", "lesson", "first_bar", "last_bar", name=op.f("pk_mastery")),
    )
    op.create_table(
        "sessions",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("student_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("kind", sa.String(length=20), nullable=False),
        sa.Column("state", sa.String(length=20), nullable=False),
        sa.Column("started", sa.DateTime(), nullable=False),
        sa.Column("folder", sa.Text(), nullable=False),
        sa.Column("lesson", sa.String(), nullable=False),
        sa.Column("title", sa.Text(), nullable=False),
        sa.Column("device", sa.Text(), nullable=False),
        sa.Column("played_s", sa.Float(), nullable=False),
        sa.Column("complete", sa.Boolean(), nullable=False),
        sa.Column("score", sa.Float(), nullable=True),
        sa.Column("level", sa.String(length=20), nullable=False),
        sa.Column("beats_a_minute", sa.Float(), nullable=True),
        sa.Column("notes", sa.Integer(), nullable=False),
        sa.Column("right", sa.Integer(), nullable=False),
        sa.Column("strokes", sa.Integer(), nullable=False),
        sa.Column("mean_ms", sa.Float(), nullable=True),
        sa.Column("sd_ms", sa.Float(), nullable=True),
        sa.Column("exam", sa.Text(), nullable=False),
        sa.Column("capture_sha256", sa.String(length=64), nullable=True),
        sa.ForeignKeyConstraint(["capture_sha256"], ["captures.sha256"], name=op.f("fk_sessions_capture_sha256")),
        sa.ForeignKeyConstraint(
            ["student_id"], ["students.id"], name=op.f("fk_sessions_student_id"), ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_sessions")),
        sa.UniqueConstraint("student_id", "name", name=op.f("uq_sessions_student_id")),
    )
    op.create_index("ix_sessions_student_started", "sessions", ["student_id", "started"], unique=False)
    op.create_table(
        "teacher_notes",
        sa.Column("student_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("note", sa.String(), nullable=False),
        sa.Column("assignment", sa.String(), nullable=False),
        sa.Column("title", sa.Text(), nullable=False),
        sa.Column("teacher", sa.Text(), nullable=False),
        sa.Column("made", sa.DateTime(), nullable=False),
        sa.Column("day", sa.Date(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.Column("next", sa.Text(), nullable=False),
        sa.Column("body", sa.LargeBinary(), nullable=False),
        sa.ForeignKeyConstraint(
            ["student_id"], ["students.id"], name=op.f("fk_teacher_notes_student_id"), ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("student_id", "note", name=op.f("pk_teacher_notes")),
    )
    op.create_table(
        "documents",
        sa.Column("session_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("body", sa.LargeBinary(), nullable=False),
        sa.ForeignKeyConstraint(
            ["session_id"], ["sessions.id"], name=op.f("fk_documents_session_id"), ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("session_id", "name", name=op.f("pk_documents")),
    )
    op.create_table(
        "figures",
        sa.Column("session_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("part", sa.String(length=20), nullable=False),
        sa.Column("name", sa.String(length=40), nullable=False),
        sa.Column("notes", sa.Integer(), nullable=False),
        sa.Column("matched", sa.Integer(), nullable=False),
        sa.Column("misses", sa.Integer(), nullable=False),
        sa.Column("wrong_piece", sa.Integer(), nullable=False),
        sa.Column("strokes", sa.Integer(), nullable=False),
        sa.Column("mean_ms", sa.Float(), nullable=True),
        sa.Column("sd_ms", sa.Float(), nullable=True),
        sa.ForeignKeyConstraint(
            ["session_id"], ["sessions.id"], name=op.f("fk_figures_session_id"), ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("session_id", "part", "name", name=op.f("pk_figures")),
    )
    op.create_table(
        "judgements",
        sa.Column("session_id", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("number", sa.Integer(), autoincrement=False, nullable=False),
        sa.Column("label", sa.String(length=20), nullable=False),
        sa.Column("pass_number", sa.Integer(), nullable=False),
        sa.Column("bar", sa.Integer(), nullable=False),
        sa.Column("beat", sa.Float(), nullable=False),
        sa.Column("note_index", sa.Integer(), nullable=True),
        sa.Column("note_time_s", sa.Float(), nullable=True),
        sa.Column("note_midi", sa.Integer(), nullable=True),
        sa.Column("hit_index", sa.Integer(), nullable=True),
        sa.Column("hit_time_s", sa.Float(), nullable=True),
        sa.Column("hit_midi", sa.Integer(), nullable=True),
        sa.Column("hit_piece", sa.String(length=20), nullable=True),
        sa.Column("hit_zone", sa.String(length=20), nullable=True),
        sa.Column("hit_articulation", sa.String(length=20), nullable=True),
        sa.Column("hit_velocity", sa.Float(), nullable=True),
        sa.Column("hit_openness", sa.Float(), nullable=True),
        sa.ForeignKeyConstraint(
            ["session_id"], ["sessions.id"], name=op.f("fk_judgements_session_id"), ondelete="CASCADE"
        ),
        sa.PrimaryKeyConstraint("session_id", "number", name=op.f("pk_judgements")),
    )
