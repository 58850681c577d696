"""Unit types with an effect outside the catalogue: adopted from the first units, and sought on the next.

python -m benchmarks.adoption --seeds reported --count 3
"""
