"""Which process a number means: the number is given to another one when its process has ended."""

import subprocess
import sys
from contextlib import suppress
from pathlib import Path

if sys.platform == "win32":
    import ctypes
    from ctypes import wintypes

    _QUERY = 0x1000  # PROCESS_QUERY_LIMITED_INFORMATION, winnt.h
    _STILL_ACTIVE = 259

    def started(number: int) -> str:
        """When a process of the user began, in a count of the system; empty where there is none."""
        kernel = ctypes.WinDLL("kernel32", use_last_error=True)
        kernel.OpenProcess.restype = wintypes.HANDLE
        handle = wintypes.HANDLE(kernel.OpenProcess(_QUERY, False, number))
        times = [wintypes.FILETIME() for _ in range(4)]
        code = wintypes.DWORD()
        try:
            known = kernel.GetProcessTimes(handle, *map(ctypes.byref, times))
            alive = kernel.GetExitCodeProcess(handle, ctypes.byref(code)) and code.value == _STILL_ACTIVE
        finally:
            kernel.CloseHandle(handle)
        return str((times[0].dwHighDateTime << 32) + times[0].dwLowDateTime) if known and alive else ""

elif sys.platform == "linux":
    import os

    _STARTTIME = 19
    """Place of `starttime` behind the name of the program, which may hold anything: proc(5)."""

    def started(number: int) -> str:
        """When a process of the user began, in a count of the system; empty where there is none."""
        folder = Path("/proc") / str(number)
        with suppress(OSError, IndexError):
            if folder.stat().st_uid == os.geteuid():
                return (folder / "stat").read_text("utf-8", "replace").rpartition(")")[2].split()[_STARTTIME]
        return ""

else:

    def started(number: int) -> str:
        """When a process began, in the words of the system; empty where there is none."""
        with suppress(OSError):
            asked = ["ps", "-o", "lstart=", "-p", str(number)]
            return subprocess.run(asked, capture_output=True, text=True, check=False).stdout.strip()
        return ""
