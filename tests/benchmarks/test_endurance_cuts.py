from benchmarks.endurance.cuts import wrong_cuts


def test_a_recording_that_is_cut_anywhere_gives_every_complete_point(tmp_path):
    assert wrong_cuts(tmp_path, count=40, seed=1) == []
