"""The closed loop on the terminal."""

from tumble.app.closing import Closing
from tumble.app.console import messages
from tumble.calibrations.core.sentences import series
from tumble.messages import Message


def tell_closing(closing: Closing) -> None:
    """Say what the last experiment decided, and what is to be run next or why nothing is."""
    console, chain = messages(), closing.chain
    if closing.declined:
        console.print(Message("{declined}; it is planned without that", declined=closing.declined), markup=False)
    elif chain.links:
        link = chain.links[-1]
        console.print(
            Message("{programme} decides {decision}", programme=link.experiment.programme, decision=link.decision),
            markup=False,
            soft_wrap=True,
        )
        if link.separated:
            console.print(Message("  {comparison}", comparison=link.comparison), markup=False, soft_wrap=True)
    for first, *others in chain.last.disputed:
        console.print(
            Message("{first} is found, which could as well be {others}", first=first, others=series(others, "or")),
            markup=False,
            soft_wrap=True,
        )
    if chain.ended:
        console.print(chain.why, markup=False, soft_wrap=True)
    elif closing.next:
        minutes = closing.next.stand_time_s / 60
        console.print(
            Message("next: {why}; {minutes:.0f} min at the stand", why=closing.next.why, minutes=minutes),
            markup=False,
            soft_wrap=True,
        )
