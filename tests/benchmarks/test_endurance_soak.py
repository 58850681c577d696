from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from benchmarks.endurance.soak import soak, summary


def test_a_run_in_which_something_goes_wrong_all_the_time_loses_nothing_and_is_right(tmp_path):
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:  # where no coverage is traced
        soaked = pool.submit(soak, tmp_path, "serial", points=4, realisations=1, speed=15.0).result()

    assert (soaked.points, soaked.planned, soaked.lost, soaked.doubled) == (20, 20, 0, 0)
    assert soaked.happened.total() >= 3
    assert max(map(abs, soaked.errors.values())) < 6.0, summary(soaked)
