"""The last chapter: from which file, by which program, on which stand."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.core.view import Chapter, Section
from tumble.messages import AsWritten, Message


def origin(provenance: Provenance) -> Chapter:
    """Hashes, versions, packages and the stand file as tables of names and texts."""
    return Chapter(anchor="origin", title=Message("Provenance"), sections=tuple(origin_sections(provenance)))


def origin_sections(provenance: Provenance) -> Iterator[Section]:
    """The tables of it."""
    commit: str = AsWritten(provenance.git_commit)
    if provenance.git_dirty:
        commit = Message("{commit} with uncommitted changes", commit=commit)
    facts = {
        Message("Raw file"): ", ".join(source.path for source in provenance.sources),
        Message("SHA-256 of the raw file"): ", ".join(provenance.source_hashes),
        Message("Start of the run"): provenance.measured_at,
        Message("Programme"): provenance.programme_name,
        Message("SHA-256 of the programme"): provenance.programme_sha256,
        Message("Stand"): provenance.stand_name,
        Message("Version of tumble"): provenance.program_version,
        Message("Commit"): commit,
    }
    yield Section(
        title="",
        caption=Message("From the raw file to the numbers"),
        rows=[(name, text if isinstance(text, Message) else AsWritten(text)) for name, text in facts.items() if text],
    )
    yield Section(
        title="",
        caption=Message("Stand file, without what is simulated"),
        rows=_as_written(flattened(provenance.stand)),
    )
    yield Section(
        title="",
        caption=Message("Packages that took part in the analysis"),
        rows=_as_written(sorted(provenance.packages.items())),
    )


def _as_written(rows: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    return [(AsWritten(name), AsWritten(text)) for name, text in rows]


def flattened(data: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, str]]:
    """Nested tables as dotted names with their values as text."""
    for key, content in data.items():
        name = f"{path}{key}"
        if isinstance(content, Mapping):
            yield from flattened(content, f"{name}.")
        elif isinstance(content, Sequence) and not isinstance(content, str):
            yield name, ", ".join(str(item) for item in content)
        else:
            yield name, str(content)
