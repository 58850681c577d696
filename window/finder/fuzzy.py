"""How well a name fits a few letters that somebody typed."""

from typing import Final

_AT_A_WORD: Final = 6
_IN_A_ROW: Final = 8
_LATER: Final = 0.1
"""What every letter costs that is passed over."""


def score(typed: str, name: str) -> float | None:
    """A number that is greater the better a name fits; None where it lacks one of the letters, in their order.

    Letters count more at the beginning of a word and one after the other. Spaces and capitals make no difference.
    """
    wanted, text = "".join(typed.casefold().split()), name.casefold()
    if not wanted:
        return 0.0
    best: dict[int, float] = {-2: 0.0}  # by the place of the letter that was found last
    for letter in wanted:
        found: dict[int, float] = {}
        for place, here in enumerate(text):
            if here != letter:
                continue
            worth = _AT_A_WORD if _begins_a_word(text, place) else 0
            ways = [
                so_far + worth + (_IN_A_ROW if before == place - 1 else -_LATER * (place - before - 1))
                for before, so_far in best.items()
                if before < place
            ]
            if ways:
                found[place] = max(ways)
        best = found
    return max(best.values(), default=None)


def _begins_a_word(text: str, place: int) -> bool:
    return place == 0 or not text[place - 1].isalnum()
