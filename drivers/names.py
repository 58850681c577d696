"""Names in files that a user writes: shown, recorded, and made part of the names of files."""

from typing import Annotated, TypeAlias

from pydantic import AfterValidator, Field

from tumble.drivers.text import check_name

Name: TypeAlias = Annotated[str, AfterValidator(check_name)]
"""Text that can be seen and is no longer than a name; it may be empty."""
GivenName: TypeAlias = Annotated[str, Field(min_length=1), AfterValidator(check_name)]
"""The same, not empty."""
