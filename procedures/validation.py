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
    "string_pattern_mismatch": translatable("String should match pattern '{pattern}'"),
    "literal_error": translatable("Input should be {expected}"),
    "enum": translatable("Input should be {expected}"),
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


def problem_of(error: ErrorDetails) -> str:
    """What is wrong: what a validator has said, or what pydantic says, as a message where it is a common one."""
    values = error.get("ctx", {})
    if isinstance(raised := values.get("error"), ValueError):
        return str(raised)
    said: Message | None
    if error["type"] in _PROBLEMS:
        said = Message.marked(_PROBLEMS[error["type"]], **{name: _written(value) for name, value in values.items()})
    else:
        said = _of_length(error["type"], values)
    return said if said == error["msg"] else error["msg"]


def remedy_of(error: ErrorDetails) -> str:
    """What to do about it."""
    return Message.marked(_REMEDY.get(error["type"], _CORRECT))


def _of_length(kind: str, values: Mapping[str, Any]) -> Message | None:
    """What pydantic says of text or a list that is too short or too long; None for any other kind of error."""
    found = {"kind": values.get("field_type", ""), "found": values.get("actual_length", 0)}
    match kind:
        case "string_too_short":
            return Message.counted(
                "String should have at least {count} character",
                "String should have at least {count} characters",
                count=values["min_length"],
            )
        case "string_too_long":
            return Message.counted(
                "String should have at most {count} character",
                "String should have at most {count} characters",
                count=values["max_length"],
            )
        case "too_short":
            return Message.counted(
                "{kind} should have at least {count} item after validation, not {found}",
                "{kind} should have at least {count} items after validation, not {found}",
                count=values["min_length"],
                **found,
            )
        case "too_long":
            return Message.counted(
                "{kind} should have at most {count} item after validation, not {found}",
                "{kind} should have at most {count} items after validation, not {found}",
                count=values["max_length"],
                **found,
            )
        case _:
            return None


def _written(value: object) -> object:
    """A value as pydantic writes it: no end of zeros, and alternatives as a list."""
    if isinstance(value, float):
        return f"{value:g}"
    first, either, last = str(value).rpartition(" or ")
    return Message("{first} or {last}", first=first, last=last) if either else value
