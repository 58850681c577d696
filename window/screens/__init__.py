"""The four screens, one a file: Stand, Run, Result, Records."""
