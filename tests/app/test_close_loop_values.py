"""Where nothing was found, `close-loop` prints the values to use all the same."""

from app_jobs import tumble


def test_values_of_a_clean_unit_are_printed(tiny_recording):
    ran = tumble("close-loop", tiny_recording)

    assert ran.status == 0, ran.err
    assert "value (standard uncertainty)" in ran.out
    assert any(line.startswith("│ kx") for line in ran.out.splitlines())
