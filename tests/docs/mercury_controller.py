"""A C-863 controller with a rotary stage, as its manual says that it answers: a fake wire in virtual time."""

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import NoReplyError

IDENTITY = "(c)2013 Physik Instrumente(PI) Karlsruhe, C-863.12,0123456789,1.2.1"
ON_TARGET, REFERENCING, MOVING, SERVO, FAILED = 0x8000, 0x4000, 0x2000, 0x1000, 0x0100
SEARCH_S = 3.0


class MercuryController:
    """Hears lines and answers them. Switched on, it has no reference, no servo, and calls where it stands zero."""

    def __init__(self, clock: VirtualClock) -> None:
        self.clock = clock
        self.heard: list[str] = []
        self.mute = 0
        """How many answers get lost."""
        self.mute_from = ""
        """Line after which one answer gets lost, once."""
        self.garbles = False
        self.blocked_at_deg: float | None = None
        """Where the stage cannot get any further."""
        self.reopened = 0
        self._waiting = b""
        self.switch_on()

    def switch_on(self) -> None:
        self.referenced = self.servo = False
        self.error = 0
        self._speed_deg_s = 1.0
        self._searching_until_s = 0.0
        self._from_deg = self._to_deg = 0.0
        self._since_s = self.clock.monotonic_s()

    # what a driver needs of a link

    def write(self, data: bytes) -> None:
        line = "#4" if data == b"\x04" else data.decode().removesuffix("\n")
        self.heard.append(line)
        if line == self.mute_from:
            self.mute, self.mute_from = 1, ""
        answer = self._answer(*line.split())
        if answer is None:
            return
        if self.mute:
            self.mute -= 1
        else:
            self._waiting += (answer[1:] if self.garbles else answer).encode() + b"\n"

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        line, end, self._waiting = self._waiting.partition(terminator)
        if not end:
            self.clock.sleep(timeout_s)
            raise NoReplyError("link", "gave no answer", "check it")
        return line + end

    def discard_input(self) -> None:
        self._waiting = b""

    def reopen(self) -> None:
        self.reopened += 1
        self._waiting = b""

    # the controller

    def _answer(self, word: str, axis: str = "", value: str = "") -> str | None:
        match word:
            case "*IDN?":
                return IDENTITY
            case "#4":
                return f"0x{self._register():04X}"
            case "ERR?":
                error, self.error = self.error, 0
                return str(error)
            case "POS?":
                return f"{axis}={self.angle_deg():.7f}"
            case "FRF?":
                return f"{axis}={int(self.referenced)}"
        self._obey(word, axis, value)
        return None

    def _obey(self, word: str, axis: str, value: str) -> None:
        self.angle_deg()
        if word == "SVO" and axis == "1":
            self.servo = value == "1"
        elif word == "VEL" and axis == "1":
            self._speed_deg_s = float(value)
        elif word == "HLT" and axis == "1":
            self._searching_until_s, self.error = 0.0, 10
            self._set_out(self.angle_deg())
        elif word == "FRF" and self.servo:
            self.referenced = False
            self._searching_until_s = self.clock.monotonic_s() + SEARCH_S
        elif word == "MOV" and self.servo and self.referenced:
            self._set_out(float(value))
        else:
            self.error = 5 if word in ("MOV", "FRF") else 2

    def _set_out(self, target_deg: float) -> None:
        self._from_deg, self._to_deg = self.angle_deg(), target_deg
        self._since_s = self.clock.monotonic_s()

    def angle_deg(self) -> float:
        now_s = self.clock.monotonic_s()
        if self._searching_until_s and now_s >= self._searching_until_s:
            self._searching_until_s, self.referenced = 0.0, True
            self._from_deg = self._to_deg = 0.0
        way_deg = self._to_deg - self._from_deg
        turned_deg = min(abs(way_deg), self._speed_deg_s * (now_s - self._since_s))
        here_deg = self._from_deg + (turned_deg if way_deg > 0 else -turned_deg)
        if self.blocked_at_deg is not None and here_deg > self.blocked_at_deg and way_deg > 0:
            self.servo, self.error = False, -1024
            self._from_deg = self._to_deg = here_deg = self.blocked_at_deg
        return here_deg

    def _register(self) -> int:
        moving = self.angle_deg() != self._to_deg
        searching = bool(self._searching_until_s)
        bits = (ON_TARGET, not moving), (REFERENCING, searching), (MOVING, moving), (SERVO, self.servo)
        return sum(bit for bit, is_set in (*bits, (FAILED, self.error != 0)) if is_set)
