"""What effects of a laboratory's own may follow in the table of an accelerometer."""

from typing import Final

from tumble.calibrations.adopted.offered import Adopting
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.effects.unnamed import unnamed

ADOPTING: Final[Adopting[Scene]] = Adopting(catalogue=CATALOGUE, axes=unnamed)
