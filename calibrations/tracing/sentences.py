"""What tracing found, in words."""

from tumble.calibrations.tracing.findings import Unexplained


def unexplained_sentence(unexplained: Unexplained) -> str:
    """Where structure without a name is."""
    return f"No effect of the catalogue explains what depends on {unexplained.depends_on}: {unexplained.description}."
