"""Students whose names share what a folder may be called are students of their own: each is known by another key."""

import sqlalchemy as sa
from alembic import op

from station.store.student_names import student_key

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Know each student by the name that is kept of them, but where that is another's by now."""
    students = sa.table("students", sa.column("id", sa.Integer), sa.column("key", sa.String), sa.column("name"))
    rows = op.get_bind().execute(sa.select(students.c.id, students.c.key, students.c.name)).all()
    taken = {row.key for row in rows}
    for row in rows:
        key = student_key(row.name)
        if key not in taken:
            taken.add(key)
            op.execute(students.update().where(students.c.id == row.id).values(key=key))
