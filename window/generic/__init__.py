"""How a method is shown that brings no parts of its own: by the columns of its points and its result in sections."""
