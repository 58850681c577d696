"""What is said of a condition that the operator sets between dwells."""

from tumble.window.look.language import tr
from tumble.window.look.names import in_words, instrument_name


class ConditionWords:
    """Sentences by name and value of a condition; a method may have its own."""

    def requested(self, condition: str, value: str) -> str:
        """That it is to be set."""
        return tr("To be set: {condition} {value}.", condition=instrument_name(condition), value=in_words(value))

    def confirmed(self, condition: str, value: str) -> str:
        """That it is set."""
        return tr("Set: {condition} {value}.", condition=instrument_name(condition), value=in_words(value))
