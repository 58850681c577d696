"""The templates of all pages."""

from functools import cache

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined


@cache
def templates(package: str = "") -> Environment:
    """Templates of a method, in the folder `report` of its package, beside those that all share."""
    shared = PackageLoader("tumble.calibrations", "report")
    return Environment(
        loader=ChoiceLoader([PackageLoader(package, "report"), shared]) if package else shared,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
