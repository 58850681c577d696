"""A temperature chamber on Modbus TCP, whatever its maker: the stand file says which register is what.

- `registers`: how a quantity stands in registers; `table`: the keys of `[chamber]`; `declaration`: what registers it.
- `modbus`: the chamber as the engine sees it.
"""
