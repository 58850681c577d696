"""What can go wrong in a run, apart from the instruments."""


class InputError(Exception):
    """A file that the user wrote cannot be used.

    The message is one sentence: which file and line, what is wrong, what to do.
    """


class ProgrammeError(InputError):
    """A programme cannot be read, or asks for something that the stand forbids."""


class JournalError(InputError):
    """A recorded run is not the beginning of the programme that shall go on with it."""


class ProcedureError(Exception):
    """A procedure asks for something that makes no sense at this moment: a fault of the program."""


class StorageError(Exception):
    """The sink could not take an event; the cause is what the sink raised."""


class StopRequestedError(Exception):
    """Somebody asked the run to stop."""


class RetakeRequestedError(Exception):
    """Somebody asked for the last point to be measured once more: the step that is under way is given up for that."""


class UnansweredError(Exception):
    """A prompt was declined, or nobody was there to answer it."""
