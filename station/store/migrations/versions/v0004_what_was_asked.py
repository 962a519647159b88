"""Bars, click, latencies and the highest tempo of a session, read from the reports that are kept."""

import json
import math
import zlib
from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None

_MOST = 1e6
_REPORT = "report.json"
_AT_ONCE = 50


def upgrade() -> None:
    """Add them."""
    text = sa.String(40, collation="C" if op.get_context().dialect.name == "postgresql" else None)
    for column in (
        sa.Column("first_bar", sa.Integer(), nullable=True),
        sa.Column("last_bar", sa.Integer(), nullable=True),
        sa.Column("click", sa.Boolean(), nullable=True),
        sa.Column("gap", text, nullable=True),
        sa.Column("input_latency_ms", sa.Float(), nullable=True),
        sa.Column("output_latency_ms", sa.Float(), nullable=True),
        sa.Column("top_beats_a_minute", sa.Float(), nullable=True),
    ):
        op.add_column("sessions", column)
    _read_reports(op.get_bind())


def _read_reports(connection: sa.Connection) -> None:
    documents = sa.table("documents", sa.column("session_id"), sa.column("name"), sa.column("body"))
    names = ("first_bar", "last_bar", "click", "gap", "input_latency_ms", "output_latency_ms", "top_beats_a_minute")
    sessions = sa.table("sessions", sa.column("id"), *(sa.column(name) for name in names))
    numbers = connection.execute(sa.select(documents.c.session_id).where(documents.c.name == _REPORT)).scalars().all()
    for at in range(0, len(numbers), _AT_ONCE):
        wanted = documents.c.session_id.in_(numbers[at : at + _AT_ONCE]) & (documents.c.name == _REPORT)
        for number, body in connection.execute(sa.select(documents.c.session_id, documents.c.body).where(wanted)).all():
            if values := _asked(body):
                connection.execute(sa.update(sessions).where(sessions.c.id == number).values(values))


def _asked(body: bytes) -> dict[str, Any]:
    """What a report says, nothing where it is damaged."""
    try:
        report = json.loads(zlib.decompress(body))
        session = report["session"]
        passes = [*(session.get("tempi") or ()), *((report.get("mastery") or {}).get("passes") or ())]
        tempi = [_number(each.get("beats_a_minute")) for each in (session, *passes)]
        bars = [_number(each) for each in session.get("bars") or ()]
    except (KeyError, TypeError, ValueError, AttributeError, RecursionError, zlib.error):
        return {}
    first, last = (int(each) if each else None for each in bars) if len(bars) == 2 else (None, None)
    click, gap = session.get("click"), session.get("gap")
    return {
        "first_bar": first,
        "last_bar": last,
        "click": click if isinstance(click, bool) else None,
        "gap": " ".join(gap.split())[:40] if isinstance(gap, str) and gap.isprintable() else None,
        "input_latency_ms": _number(session.get("input_latency_ms")),
        "output_latency_ms": _number(session.get("output_latency_ms")),
        "top_beats_a_minute": max((each for each in tempi if each is not None), default=None),
    }


def _number(value: object) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not -_MOST <= value <= _MOST:
        return None
    return float(value) if math.isfinite(value) else None
