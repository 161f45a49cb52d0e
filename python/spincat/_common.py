"""What all parts of the package share: how arguments are understood."""

from __future__ import annotations

import operator
import os
from typing import Any, Callable, Optional, Sequence, Union

from ._spincat import InputError, Object

Path = Union[str, "os.PathLike[str]"]
Item = Union[Object, str, "os.PathLike[str]"]
Items = Sequence[Item]
# A function of stage, done and total, or what makes a bar, as tqdm does.
ProgressLike = Any
Told = Optional[Callable[[str, int, int], object]]

_LARGEST = 2**31 - 1


def whole(name: str, value: Any) -> int:
    """A whole number that fits into 32 bits."""
    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{name} {value!r}: expected a whole number") from None
    if not -_LARGEST <= number <= _LARGEST:
        raise InputError(f"{name} {number}: expected a whole number of at most {_LARGEST}")
    return number


def real(name: str, value: Any) -> float:
    """A number."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} {value!r}: expected a number") from None


def path(name: str, value: Any) -> str:
    """The name of a file or folder."""
    try:
        text = os.fsdecode(value)
    except TypeError:
        raise InputError(f"{name}: expected the name of a file, found {type(value).__name__}") from None
    if "\0" in text:
        raise InputError(f"{name}: a file name holds no zero byte")
    return text


def paths(name: str, value: Any) -> list[str]:
    """One name or several."""
    if isinstance(value, (str, bytes, os.PathLike)):
        return [path(name, value)]
    try:
        return [path(f"{name}[{i}]", one) for i, one in enumerate(value)]
    except TypeError:
        raise InputError(f"{name}: expected names of files, found {type(value).__name__}") from None


def thread_count(threads: Optional[int]) -> int:
    """So many threads; None: as many as this process may use processors."""
    if threads is not None:
        return whole("threads", threads)
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Bars:
    """Drives bars such as tqdm's: a class gets a bar for each stage, a bar is set to what each stage says."""

    def __init__(self, make: Any) -> None:
        self._make = make
        self._bar: Any = None if isinstance(make, type) else make
        self._stage: Optional[str] = None

    def __call__(self, stage: str, done: int, total: int) -> None:
        if stage != self._stage:
            self._begin(stage, total)
        if self._bar is None:  # its stage is done
            return
        self._bar.total = total
        self._bar.update(done - self._bar.n)
        if done == total and isinstance(self._make, type):
            self._bar.close()
            self._bar = None

    def _begin(self, stage: str, total: int) -> None:
        self._stage = stage
        if isinstance(self._make, type):
            if self._bar is not None:
                self._bar.close()
            self._bar = self._make(total=total, desc=stage)
        else:
            self._bar.n = 0


def told(progress: ProgressLike) -> Told:
    """The function that work tells of itself to."""
    if progress is None:
        return None
    if hasattr(progress, "update"):
        return Bars(progress)
    if callable(progress):
        function: Callable[[str, int, int], object] = progress
        return function
    raise InputError(f"progress: expected a function of stage, done and total, or tqdm, found {type(progress).__name__}")
