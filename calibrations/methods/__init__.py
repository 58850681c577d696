"""The methods: what is measured, by which model, and what may stand behind a residual. None knows another."""
