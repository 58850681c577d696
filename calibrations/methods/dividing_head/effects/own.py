"""Effects of a laboratory's own. One is a few lines: name, owner, columns, what its coefficient is called.

`docs/examples/own.py` is this file with an example in it: paste it here and change what is yours.
"""

from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Effect

OWN_EFFECTS: tuple[Effect[Scene], ...] = ()
