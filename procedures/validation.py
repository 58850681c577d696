"""What is wrong with a value that does not fit its model, as a message.

Validators of this product raise `ValueError` with a message; what pydantic itself finds has a kind and values.
"""

from collections.abc import Mapping
from typing import Any, Final

from pydantic_core import ErrorDetails

from tumble.messages import Message, translatable

_REMEDY: Final = {
    "missing": translatable("add it"),
    "extra_forbidden": translatable("correct its spelling or take it out"),
}
_CORRECT: Final = translatable("correct it")
_PROBLEMS: Final[Mapping[str, str]] = {
    "missing": translatable("Field required"),
    "extra_forbidden": translatable("Extra inputs are not permitted"),
    "greater_than": translatable("Input should be greater than {gt}"),
    "greater_than_equal": translatable("Input should be greater than or equal to {ge}"),
    "less_than": translatable("Input should be less than {lt}"),
    "less_than_equal": translatable("Input should be less than or equal to {le}"),
    "finite_number": translatable("Input should be a finite number"),
    "float_type": translatable("Input should be a valid number"),
    "float_parsing": translatable("Input should be a valid number, unable to parse string as a number"),
    "int_type": translatable("Input should be a valid integer"),
    "int_parsing": translatable("Input should be a valid integer, unable to parse string as an integer"),
    "int_from_float": translatable("Input should be a valid integer, got a number with a fractional part"),
    "bool_type": translatable("Input should be a valid boolean"),
    "bool_parsing": translatable("Input should be a valid boolean, unable to interpret input"),
    "string_type": translatable("Input should be a valid string"),
    "string_too_short": translatable("String should have at least {min_length} character{s}"),
    "string_too_long": translatable("String should have at most {max_length} character{s}"),
    "string_pattern_mismatch": translatable("String should match pattern '{pattern}'"),
    "literal_error": translatable("Input should be {expected}"),
    "enum": translatable("Input should be {expected}"),
    "too_short": translatable("{kind} should have at least {min_length} item{s} after validation, not {actual_length}"),
    "too_long": translatable("{kind} should have at most {max_length} item{s} after validation, not {actual_length}"),
    "list_type": translatable("Input should be a valid list"),
    "tuple_type": translatable("Input should be a valid tuple"),
    "dict_type": translatable("Input should be a valid dictionary"),
    "model_type": translatable("Input should be a valid dictionary or instance of {class_name}"),
    "model_attributes_type": translatable("Input should be a valid dictionary or object to extract fields from"),
    "path_type": translatable("Input is not a valid path"),
    "day": translatable("Input should be a valid date, such as 2027-01-31"),
    "union_tag_not_found": translatable("Unable to extract tag using discriminator {discriminator}"),
    "union_tag_invalid": translatable(
        "Input tag '{tag}' found using {discriminator} does not match any of the expected tags: {expected_tags}"
    ),
}
"""Templates of what pydantic says, by its kind of error: https://docs.pydantic.dev/latest/errors/validation_errors/"""


_KINDS: Final = (translatable("List"), translatable("Tuple"), translatable("Dictionary"))
"""What pydantic calls a sequence that is too short or too long."""


def problem_of(error: ErrorDetails) -> str:
    """What is wrong: what a validator has said, or what pydantic says, as a message where it is a common one."""
    values = dict(error.get("ctx", {}))
    if isinstance(raised := values.get("error"), ValueError):
        return str(raised)
    if (template := _PROBLEMS.get(error["type"])) is None:
        return error["msg"]
    said = Message(template, **_fields(values))
    return said if said == error["msg"] else error["msg"]


def remedy_of(error: ErrorDetails) -> str:
    """What to do about it."""
    return Message(_REMEDY.get(error["type"], _CORRECT))


def _fields(values: Mapping[str, Any]) -> dict[str, object]:
    """The values as pydantic writes them."""
    fields = {name: f"{value:g}" if isinstance(value, float) else value for name, value in values.items()}
    length = values.get("min_length", values.get("max_length"))
    return {
        **fields,
        "expected": _alternatives(str(values.get("expected", ""))),
        "kind": Message(str(values.get("field_type", ""))),
        "s": "" if length == 1 else "s",
    }


def _alternatives(expected: str) -> str:
    first, either, last = expected.rpartition(" or ")
    return Message("{first} or {last}", first=first, last=last) if either else expected
