"""Settings for all tests."""

from hypothesis import settings

# On a shared machine a stall of any length may fall into any example: time belongs in benchmarks, not in properties.
settings.register_profile("station", deadline=None)
settings.load_profile("station")
