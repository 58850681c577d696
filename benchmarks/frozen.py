"""Does every table and every kind of recording still give the result that it gave? Frozen results, and what differs.

`python -m benchmarks.frozen` holds what the program says now against `tests/measured/frozen` and `tests/frozen`; keys,
their order, nulls, whole numbers, names and statuses are to be equal, other numbers to within 1e-9. Sentences may
change. `--freeze` writes the results anew, which only a change of the physics or of a contract justifies; the commit
says which.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).parents[1]
SHARED: Final = ROOT.parent / "shared"
"""Tables that are measured by others or made blind; they stay where they are."""
OF_TABLES: Final = ROOT / "tests" / "measured" / "frozen"
OF_RUNS: Final = ROOT / "tests" / "frozen"
TOGETHER: Final = {
    "cases-public/02-joint": ("cases-public/02-joint-unloaded", "cases-public/02-joint-loaded"),
    "data/head_reference": ("data/head_reference_fault", "data/head_reference_rewired"),
}
"""Tables that are traced together."""
RECORDINGS: Final = {"recording_v1": ROOT / "tests" / "procedures" / "fixtures" / "recording_v1.mcap"}
"""Recordings of earlier versions."""
PROGRAMMES: Final = ("quick", "reversal", "seed", "probe-end")
KERNELS: Final = "Haswell"
"""Those of OpenBLAS with which results are frozen and compared, on whatever machine.

Others round otherwise. Monte Carlo trials, ties and what is flat then differ by more than their digits; what is stated
with an uncertainty, by much less than that.
"""
RELATIVE: Final = 1e-9
"""On the machine that froze the results."""
ABSOLUTE: Final = 1e-13
"""Below this a number is rounding noise: what is left where the answer is zero."""

Run = Callable[..., int]
"""Calls `tumble` with arguments and returns its exit status."""
Results = dict[str, Any]
"""Status and JSON document by command; the document is None where the input is refused."""


def tables() -> dict[str, tuple[Path, ...]]:
    """Tables by name, as `cases/01-k_xx`; none where they are absent."""
    found = (path for folder in ("cases", "cases-public", "data") for path in sorted((SHARED / folder).glob("*.csv")))
    single = {f"{path.parent.name}/{path.stem}": (path,) for path in found}
    together = {name: tuple(SHARED / f"{part}.csv" for part in parts) for name, parts in TOGETHER.items()}
    return single | together if single else {}


def results(run: Run, paths: Sequence[Path], folder: Path) -> Results:
    """What `fit` and `close-loop` say of files, several of which cannot be fitted; `folder` takes what is written."""
    commands = ("fit", "close-loop") if len(paths) == 1 else ("close-loop",)
    return {command: _result(run, command, paths, folder) for command in commands}


def _result(run: Run, command: str, paths: Sequence[Path], folder: Path) -> Results:
    written = folder / f"{command}.json"
    status = run(command, *paths, "--json", written)
    if not written.exists():
        return {"status": status, "document": None}
    text = written.read_text("utf-8")
    for path in paths:
        text = text.replace(f"{path.parent}/", "")  # where it lies on this machine
    return {"status": status, "document": json.loads(text)}


def results_of_a_run(run: Run, programme: str, folder: Path) -> Results:
    """What is said of a recording of the simulated stand, which is the same every time."""
    recording = folder / "run.mcap"
    status = run("run", "--programme", programme, "--serial", "FROZEN", "--out", recording)
    return {"run": {"status": status, "document": None}, **results(run, [recording], folder)}


def differences(frozen: Any, now: Any, relative: float, where: str = "") -> Iterator[str]:  # JSON
    """Where two JSON values differ, as sentences; text with a space is a sentence, and may."""
    if isinstance(frozen, dict) and isinstance(now, dict):
        if list(frozen) != list(now):
            yield f"{where}: keys {', '.join(frozen)} became {', '.join(now)}"
        for key in frozen.keys() & now.keys():
            yield from differences(frozen[key], now[key], relative, f"{where}/{key}")
    elif isinstance(frozen, list) and isinstance(now, list):
        if len(frozen) != len(now):
            yield f"{where}: {len(frozen)} entries became {len(now)}"
        for index, (before, after) in enumerate(zip(frozen, now, strict=False)):
            yield from differences(before, after, relative, f"{where}/{index}")
    elif not _alike(frozen, now, relative):
        yield f"{where}: {frozen!r} became {now!r}"


def _alike(frozen: object, now: object, relative: float) -> bool:
    if isinstance(frozen, str) and isinstance(now, str) and " " in frozen and " " in now:
        return True
    if type(frozen) is float and type(now) is float:
        return math.isclose(frozen, now, rel_tol=relative, abs_tol=ABSOLUTE)
    return type(frozen) is type(now) and frozen == now


def read(path: Path) -> Results:
    """Frozen results."""
    return dict(json.loads(path.read_text("utf-8")))


def write(path: Path, said: Results) -> None:
    """Freeze results: one line a command, so that a change of one is seen in a comparison of versions."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = (f"{json.dumps(command)}: {json.dumps(entry)}" for command, entry in said.items())
    path.write_text("{\n" + ",\n".join(lines) + "\n}\n", "utf-8")


def _run(*arguments: object) -> int:
    command = [sys.executable, "-m", "tumble", *map(str, arguments)]
    environment = {"OPENBLAS_CORETYPE": KERNELS, **os.environ}
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, check=False).returncode


def _now(name: str) -> Results:
    with tempfile.TemporaryDirectory() as folder:
        if name in PROGRAMMES:
            return results_of_a_run(_run, name, Path(folder))
        if name in RECORDINGS:
            return results(_run, [RECORDINGS[name]], Path(folder))
        return results(_run, tables()[name], Path(folder))


def _place(name: str) -> Path:
    return (OF_RUNS if name in (*PROGRAMMES, *RECORDINGS) else OF_TABLES) / f"{name}.json"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "names", nargs="*", help="of tables, as cases/01-k_xx, of programmes or of recordings; all without"
    )
    parser.add_argument("--freeze", action="store_true", help="write the results anew")
    parser.add_argument("--relative", type=float, default=RELATIVE, help="how far numbers may differ")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    names = options.names or [*PROGRAMMES, *RECORDINGS, *tables()]
    bad = 0
    with ThreadPoolExecutor(options.workers) as pool:
        for name, said in zip(names, pool.map(_now, names), strict=True):
            if options.freeze:
                write(_place(name), said)
                continue
            for sentence in differences(read(_place(name)), said, options.relative):
                bad += 1
                print(f"{name}{sentence}", flush=True)
    print(f"{len(names)} inputs {'frozen' if options.freeze else 'compared'}, {bad} differences")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
