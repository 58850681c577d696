"""Results as a notebook shows them."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from markupsafe import Markup

from tumble.app.terminal import shown
from tumble.calibrations.core.quantities import format_concise
from tumble.messages import Message

if TYPE_CHECKING:
    import pandas as pd

Place: TypeAlias = str | PathLike[str]
_HEADINGS: Final = (Message("parameter"), Message("value (standard uncertainty)"), Message("remark"))


@dataclass(frozen=True)
class Picture:
    """A figure: a notebook shows it, `save` writes it."""

    svg: str

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: Place) -> None:
        """Write it as SVG."""
        Path(path).write_text(self.svg, encoding="utf-8")


@dataclass(frozen=True, kw_only=True)
class Result:
    """What an analysis says: values with uncertainties, what was found, what is withheld and why."""

    name: str
    document: Mapping[str, Any]
    """As the command line writes it with `--json`: `tumble.fit/1` or `tumble.loop/1`."""
    draw: Callable[[], Picture] = field(repr=False)

    @property
    def values(self) -> tuple[dict[str, Any], ...]:
        """The values to use: `name`, `value`, `standard_uncertainty`, `unit`; `reason` where there is no value."""
        return tuple(_values(self.document))

    def to_dict(self) -> dict[str, Any]:
        """The JSON document."""
        return dict(self.document)

    def to_dataframe(self) -> "pd.DataFrame":
        """`values` as a table of pandas, which has to be installed. Raises `ImportError`."""
        import pandas as pd

        return pd.DataFrame(self.values).set_index("name")

    def plot(self) -> Picture:
        """What the model leaves."""
        return self.draw()

    def _repr_html_(self) -> str:
        rows = Markup("").join(
            Markup("<tr><td>{}</td><td>{}</td><td>{}</td></tr>").format(value["name"], *_cells(value))
            for value in self.values
        )
        head = Markup("<tr><th>{}</th><th>{}</th><th>{}</th></tr>").format(*map(shown, _HEADINGS))
        return Markup("<table><caption>{}</caption>{}{}</table>").format(self.name, head, rows)


def _values(document: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    if any("augmented" in part for part in document.get("parameters", {}).values()):  # each traced by itself
        for name, part in document["parameters"].items():
            yield from _named({f"{name}, {term}": value for term, value in part["augmented"]["parameters"].items()})
            yield from _found(part["effects"], f"{name}, ")
    elif "parameters" in document:
        yield from _named(document["parameters"])
        yield from _found(document.get("loop", {}).get("effects", ()))
    else:
        yield from _named(document["augmented"]["parameters"])
        yield from _found(document["effects"])


def _named(parameters: Mapping[str, Mapping[str, Any]]) -> Iterator[dict[str, Any]]:
    for name, value in parameters.items():
        yield {"name": name, **{key: value.get(key) for key in ("value", "standard_uncertainty", "unit", "reason")}}


def _found(effects: Sequence[Mapping[str, Any]], where: str = "") -> Iterator[dict[str, Any]]:
    for effect in effects:
        coefficients = effect["coefficients"]
        single = len(coefficients) == 1
        yield from _named(
            {
                where + (effect["name"] if single else f"{effect['name']}, {name}"): coefficients[name]
                for name in coefficients
            }
        )


def _cells(value: Mapping[str, Any]) -> tuple[str, str]:
    if value["value"] is None:
        return shown(Message("not identifiable")), value["reason"] or ""
    return format_concise(value["value"], value["standard_uncertainty"], value["unit"]), ""
