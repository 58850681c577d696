"""What the reports of all methods share: the page of sections, figures, templates."""
