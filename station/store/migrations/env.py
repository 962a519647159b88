"""Runs the migrations on the connection that `schema_version` has opened, in its transaction."""

from alembic import context

from station.store.tables import METADATA

context.configure(connection=context.config.attributes["connection"], target_metadata=METADATA, render_as_batch=True)
context.run_migrations()
