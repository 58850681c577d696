"""A function generator in a stand file."""

from tumble.drivers.driver import Bench, Driver
from tumble.drivers.generator.generator import DEVICE, FunctionGenerator
from tumble.drivers.generator.table import GeneratorTable


def _connect(table: GeneratorTable, bench: Bench) -> FunctionGenerator:
    return FunctionGenerator(bench.attentive.links.serial(table, DEVICE), table)


GENERATOR = Driver(table=GeneratorTable, connect=_connect)
