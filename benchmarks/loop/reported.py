"""What a result says, in a line."""

from tumble.calibrations.methods.dividing_head.loop.loop import Loop


def said(loop: Loop) -> str:
    """Effects with their rivals, and structure without a name."""
    named = [
        f"{effect.name} (or {', '.join(effect.also_possible)})" if effect.also_possible else effect.name
        for effect in loop.effects
    ]
    unexplained = [f"unexplained: {loop.unexplained.description}"] if loop.unexplained else []
    return "; ".join([*named, *unexplained]) or "nothing"
