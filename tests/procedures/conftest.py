"""Fixtures of the procedures' tests."""

import pytest
from fakes import FakeStand, point_at

from tumble.procedures.steps import Ask, Confirmed, Reply, Step


@pytest.fixture
def stand() -> FakeStand:
    return FakeStand()


@pytest.fixture(scope="session")
def nominal_reply():
    """Replies to a step as an ideal unit at an ideal stand would."""

    def reply(step: Step) -> Reply:
        return Confirmed(condition=step.condition, value=step.value) if isinstance(step, Ask) else point_at(step)

    return reply
