"""What pydantic finds is said as a message, word for word as pydantic says it in English."""

from typing import Annotated, Literal

import pytest
from pydantic import BaseModel, Field, ValidationError

from tumble.messages import Language, Message
from tumble.procedures.validation import problem_of


def problem(kind, value):
    class Model(BaseModel, extra="forbid"):
        it: kind

    with pytest.raises(ValidationError) as caught:
        Model.model_validate(value)
    (error,) = caught.value.errors()
    return error["msg"], problem_of(error)


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (Annotated[float, Field(gt=0)], {"it": 0}),
        (Annotated[float, Field(ge=0.5)], {"it": 0}),
        (Annotated[float, Field(lt=1)], {"it": 1}),
        (Annotated[int, Field(le=7)], {"it": 8}),
        (Annotated[float, Field(allow_inf_nan=False)], {"it": float("nan")}),
        (float, {"it": "long"}),
        (float, {"it": []}),
        (int, {"it": 0.5}),
        (int, {"it": "x"}),
        (bool, {"it": "perhaps"}),
        (str, {"it": 3}),
        (Annotated[str, Field(min_length=1)], {"it": ""}),
        (Annotated[str, Field(max_length=2)], {"it": "abc"}),
        (Annotated[str, Field(pattern="^a$")], {"it": "b"}),
        (Literal["yes", "no"], {"it": "so"}),
        (Annotated[list[int], Field(min_length=2)], {"it": [1]}),
        (Annotated[list[int], Field(max_length=1)], {"it": [1, 2]}),
        (dict[str, int], {"it": 1}),
        (str, {}),
        (str, {"it": "a", "other": 1}),
    ],
)
def test_what_pydantic_says_is_a_message_of_the_same_words(kind, value):
    of_pydantic, said = problem(kind, value)
    assert said == of_pydantic
    assert said.in_language(Language.GERMAN) != said != said.in_language(Language.UKRAINIAN)


def test_alternatives_are_joined_by_the_word_of_the_language():
    _, said = problem(Literal["yes", "no"], {"it": "so"})
    assert said.in_language(Language.GERMAN) == "Zulässig ist 'yes' oder 'no'"


def test_what_a_validator_says_is_its_message():
    error = {"type": "value_error", "msg": "Value error, x", "ctx": {"error": ValueError(Message("is no file"))}}
    assert problem_of(error).in_language(Language.GERMAN) == "ist keine Datei"


def test_what_is_not_known_is_said_as_pydantic_says_it():
    assert problem_of({"type": "strange", "msg": "Strange", "ctx": {}}) == "Strange"
