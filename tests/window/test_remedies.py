"""What a notice offers leads somewhere."""

import pytest

from tumble.app.exits import Exit, JobError
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.window.remedies import Remedies


@pytest.fixture
def remedies(shared_window):
    return Remedies(is_free=lambda: True, stand=shared_window.window.stand, resume=lambda _: None)


@pytest.fixture
def recording(tmp_path):
    path = tmp_path / "20261128T230422Z-tiny.mcap"
    path.write_bytes(b"some of it")
    return path


def naming(path):
    return Message("{path}: not writable", path=path)


def test_a_run_that_was_kept_can_go_on(remedies, recording):
    assert remedies.remedy_of(JobError(naming(recording), Exit.STORAGE)).title == "Go on with it"


def test_a_run_that_could_not_be_begun_is_not_offered_to_go_on(remedies, recording):
    recording.write_bytes(b"")
    assert remedies.remedy_of(JobError(naming(recording), Exit.STORAGE)) is None


def test_a_recording_that_is_none_is_not_offered_again(remedies, recording):
    assert remedies.remedy_of(InputError(naming(recording))) is None


def test_a_file_that_is_wrong_is_opened(remedies, write):
    assert remedies.remedy_of(InputError(naming(write("bench.toml", "")))).title == "Open the file"
