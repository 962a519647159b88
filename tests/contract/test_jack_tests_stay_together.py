"""Tests with a JACK server never run beside each other: libjack keeps one registry of servers a user."""

import os

import pytest


@pytest.mark.jack
@pytest.mark.skipif(not os.environ.get("PYTEST_XDIST_WORKER"), reason="the tests run in one process anyway")
def test_tests_with_a_jack_server_go_to_one_worker(request: pytest.FixtureRequest) -> None:
    assert request.node.nodeid.endswith("@jack"), "xdist has not taken the group: see tests/conftest.py"
