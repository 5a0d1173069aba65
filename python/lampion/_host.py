# SPDX-License-Identifier: MIT
"""The hooks that the library calls while it works: threads, progress, and the user's patience."""
from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, TypeVar

from ._core import Owner, check, ffi, integer, lib


class Host:
    """An lmp_host for one call. An exception in `progress`, or Ctrl+C, cancels the call, and is
    raised once the library has returned."""

    def __init__(self, threads: int = 1, progress: Callable[[float], Any] | None = None):
        self.threads = integer("threads", threads, 1, 1024)
        if progress is not None and not callable(progress):
            raise TypeError("progress must be callable")
        self._failure: BaseException | None = None
        self._progress = progress
        self.c = ffi.new("lmp_host *")
        self._hooks = [ffi.callback("bool(void *)", lambda user: self._failure is not None,
                                    error=True, onerror=self._fail)]
        self.c.cancelled = self._hooks[0]
        if self.threads > 1:
            self._hooks.append(ffi.callback(
                "void(size_t, void (*)(size_t, void *), void *, void *)", self._parallel,
                onerror=self._fail))
            self.c.parallel = self._hooks[-1]
        if progress:
            self._hooks.append(ffi.callback("void(double, void *)", self._report,
                                            onerror=self._fail))
            self.c.progress = self._hooks[-1]

    def _fail(self, kind: Any, value: BaseException, trace: Any) -> None:
        self._failure = self._failure or value

    def _report(self, done: float, user: Any) -> None:
        if self._failure is None and self._progress:
            self._progress(done)

    def _parallel(self, count: int, task: Any, data: Any, user: Any) -> None:
        indices = iter(range(count))  # which the threads share

        def work() -> None:
            for index in indices:
                task(index, data)

        # Leaving the pool waits for every task, which after Ctrl+C ask whether to go on.
        with ThreadPoolExecutor(self.threads) as pool:
            try:
                for running in [pool.submit(work) for _ in range(self.threads)]:
                    running.result()
            except BaseException as error:
                self._failure = self._failure or error

    def check(self, result: int, error: Any = None) -> None:
        """Raises what stopped the call, or what its result says."""
        if self._failure is not None:
            raise self._failure
        check(result, error)


def created(ctype: str, create: Callable[[Any, Any], int], host: Host | None = None) -> Any:
    """The object that `create` makes, which gets an lmp_host and where the object goes."""
    host = host or Host()
    place = ffi.new(ctype + " **")
    try:
        host.check(create(host.c, place))
    except BaseException:
        if place[0]:  # it was complete when `progress` raised
            getattr(lib, ctype + "_destroy")(place[0])
        raise
    return place[0]


def read_object(ctype: str, read: Callable, data: Any) -> Any:
    """The object that a reader of the library makes of bytes, or of what has a buffer of them."""
    try:
        buffer = ffi.from_buffer(data)
    except (TypeError, ValueError):
        raise TypeError("data must be bytes, such as pathlib.Path(name).read_bytes(), "
                        f"not {type(data).__name__}") from None
    place = ffi.new(ctype + " **")
    error = ffi.new("lmp_parse_error *")
    check(read(ffi.NULL, buffer, len(buffer), error, place), error)
    return place[0]


_Self = TypeVar("_Self", bound="Stored")


class Stored(Owner):
    """An object that the library writes as bytes and reads back."""

    __slots__ = ()
    _ctype: str
    # The library's functions of this type.
    _destroy: Any
    _read: Any
    _size: Any
    _write: Any

    def _create(self, create: Callable[[Any, Any], int], host: Host | None = None) -> None:
        self._own(created(self._ctype, create, host), self._destroy)

    @classmethod
    def read(cls: type[_Self], data: bytes) -> _Self:
        """The object of the bytes that `write` made, or of a file of them."""
        made = cls.__new__(cls)
        made._own(read_object(cls._ctype, cls._read, data), cls._destroy)
        return made

    def write(self) -> bytes:
        """The object as bytes, the same on every machine."""
        data = bytearray(self._size(self._c))
        check(self._write(self._c, len(data), ffi.from_buffer(data)))
        return bytes(data)

    def __reduce__(self) -> Any:
        return type(self).read, (self.write(),)


