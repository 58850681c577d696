"""Fixtures of the procedures' tests."""

import pytest
from fakes import FakeStand, point_at

from tumble.procedures.steps import Mounted, Mounting, Reply, Step


@pytest.fixture
def stand() -> FakeStand:
    return FakeStand()


@pytest.fixture(scope="session")
def nominal_reply():
    """Replies to a step as an ideal unit at an ideal stand would."""

    def reply(step: Step) -> Reply:
        return Mounted(mount=step.mount) if isinstance(step, Mounting) else point_at(step)

    return reply
