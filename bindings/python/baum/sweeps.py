# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps: many runs of one mechanism with different parameters, on threads, processes or a
cluster."""

from __future__ import annotations

import concurrent.futures
import contextlib
import ctypes
import hashlib
import itertools
import os
import pickle
import threading
import time
import types
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Sequence

import numpy as np

from . import _abi, _files
from ._values import there_are, vector
from .channels import Channel, several
from .errors import Error, Status
from .gains import Gains
from .progress import Line, stream
from .run import Run
from .typing import Array, ArrayLike, ChannelLike

if TYPE_CHECKING:
    import pandas

    from .mechanism import Mechanism

DIGITS = 64  # length of a hash in the file of a sweep
CHUNKS = 64  # a long sweep is divided into 64 to 128 parts for each worker
Reduce = Callable[[Run], Any]


class _Task(NamedTuple):
    """The data that all runs of a sweep share. They are pickled for other processes."""

    mechanism: Mechanism
    names: tuple[str, ...]
    times: Array
    method: Any
    record: tuple[Any, ...]
    reduce: Reduce | None
    options: dict[str, Any]


class _Result(NamedTuple):
    """The result of one run: arrays by name, which contain NaN after a failure."""

    values: dict[str, Array]
    status: int
    message: str
    warnings: tuple[str, ...]


# ---- one run -----------------------------------------------------------------------------------


def _changes(names: Sequence[str], row: Sequence[Any]) -> dict[str, dict[str, Any]]:
    """Return the changes for a row of parameters: changes[element][field] = value."""
    changes: dict[str, dict[str, Any]] = {}
    for name, value in zip(names, row):
        element, _, field = name.rpartition(".")
        plain = value.item() if np.ndim(value) == 0 else value
        changes.setdefault(element, {})[field] = plain
    return changes


def _values_of(run: Run, reduce: Reduce | None) -> dict[str, Array]:
    if reduce is None:
        return {key: run[key] for key in run}
    value = reduce(run)
    if value is None:
        raise TypeError("reduce() returned None, not a number, an array or a dict of them")
    named = value if isinstance(value, dict) else {"value": value}
    return {name: np.asarray(x, dtype=float) for name, x in named.items()}


def _one(task: _Task, row: Sequence[Any]) -> _Result:
    try:
        changed = task.mechanism.copy(**_changes(task.names, row))
        run = changed.simulate(task.times, task.method, record=task.record, **task.options)
        kinds = tuple(type(warning).__name__ for warning in run.warnings)
        return _Result(_values_of(run, task.reduce), int(run.status), "", kinds)
    except Error as error:
        return _Result({}, int(error.status), str(error), ())
    except Exception as error:
        values = ", ".join(f"{name} = {value}" for name, value in zip(task.names, row))
        add_note = getattr(error, "add_note", None)  # since Python 3.11
        if add_note:
            add_note(f"baum: in the run of a sweep with {values}")
        raise


def _many(task: _Task, rows: Sequence[Sequence[Any]]) -> list[_Result]:
    """Run a part of a sweep. This function is defined at module level, so that other processes can
    import it."""
    results: list[_Result] = []
    for row in rows:
        results.append(_one(task, row))
        if results[-1].status == Status.STOP_CANCELLED:  # the sweep has ended
            break
    return results


# ---- the rows of parameters --------------------------------------------------------------------


def mapping(parameters: Any) -> None:
    """Check that parameters are given by name."""
    if not hasattr(parameters, "items"):
        kind = type(parameters).__name__
        raise TypeError(f"parameters: a dict of names and values is wanted, not a {kind}")


def _columns(parameters: Mapping[str, ArrayLike]) -> dict[str, Array]:
    columns = {}
    mapping(parameters)
    for name, values in parameters.items():
        if "." not in name:
            raise ValueError(f'{name!r}: "element.field" is wanted, such as "rod.mass"')
        try:
            columns[name] = np.asarray(values, dtype=float)
        except (TypeError, ValueError):
            raise TypeError(f"{name}: numbers are wanted, not {values!r}") from None
        if columns[name].ndim == 0:
            raise ValueError(f"{name}: a list of values is wanted, not {values!r}")
    return columns


def _rows(columns: dict[str, Array], samples: Any, count: int | None) -> list[tuple[Any, ...]]:
    if isinstance(samples, str) and samples == "grid":
        return list(itertools.product(*columns.values()))
    if samples is not None and not isinstance(samples, str):
        return _drawn(columns, samples, count)
    if samples not in (None, "rows"):
        raise ValueError(f'samples: "rows", "grid" or a sampler is wanted, not {samples!r}')
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        raise ValueError(
            f"the parameters have different numbers of values: {lengths}; "
            'samples="grid" runs all combinations'
        )
    return list(zip(*columns.values()))


def _drawn(columns: dict[str, Array], sampler: Any, count: int | None) -> list[tuple[Any, ...]]:
    """Draw rows from a sampler, such as scipy.stats.qmc.Sobol, between the bounds of each
    parameter."""
    if count is None:
        raise ValueError("count is missing, the number of samples to draw")
    for name, values in columns.items():
        if values.shape != (2,):
            raise ValueError(f"{name}: lower and upper bound are wanted, not {values.tolist()}")
    low, high = np.array(list(columns.values())).T
    drawn = np.asarray(sampler.random(count))
    if drawn.shape != (count, len(columns)):
        raise ValueError(
            f"samples: random({count}) returned an array of shape {drawn.shape}; wanted is a row "
            f"for each sample with a number for each parameter, {(count, len(columns))}"
        )
    return [tuple(row) for row in low + (high - low) * drawn]


# ---- executors ---------------------------------------------------------------------------------


def _calls(executor: Any, task: _Task, parts: Sequence[Any]) -> Iterator[tuple[int, Any]]:
    """Run the parts of a sweep on an executor. When a part is done, yield its index and its
    results."""
    if hasattr(executor, "submit"):
        futures = {executor.submit(_many, task, part): k for k, part in enumerate(parts)}
        waiting = list(futures)
        try:
            for future in _completed(waiting):
                yield futures[future], future.result()
        finally:
            for future in waiting:
                future.cancel()
    elif hasattr(executor, "map"):
        yield from enumerate(executor.map(_many, itertools.repeat(task, len(parts)), parts))
    else:
        raise TypeError(f"executor: an object with submit() or map() is wanted, not {executor!r}")


def _completed(futures: Sequence[Any]) -> Iterable[Any]:
    """Yield futures in the order in which they complete. Futures of other packages are yielded in
    the given order."""
    if all(isinstance(future, concurrent.futures.Future) for future in futures):
        return concurrent.futures.as_completed(futures)
    return futures


def _workers(executor: Any) -> int:
    return int(getattr(executor, "_max_workers", 0) or os.cpu_count() or 1)


# ---- the results -------------------------------------------------------------------------------


class Named:
    """Results by name."""

    _values: dict[str, Array]

    def keys(self) -> list[str]:
        """The names of the results."""
        return list(self._values)

    def __getitem__(self, name: str) -> Array:
        found = self._values.get(name)
        if found is None:
            raise KeyError(f"no {name!r} in these results; {there_are(self._values, name)}")
        return found


class Sweep(Named):
    """The results of a sweep of n runs.

    parameters: a dict from the name of each parameter to its values: an array (n), or (n x size)
        if the parameter is a vector.
    status: the Status of each run (n).
    messages: a dict from the index of each failed run to its message.
    warnings: for each run, the names of the classes of its warnings (n).

    sweep["rod.pose"] contains the samples (n x samples x columns) of a channel. If baum.sweep() was
    called with a function `reduce`, sweep["value"] contains the results of this function (n x ...).
    The values of failed runs are NaN.
    """

    def __init__(self, names: Sequence[str], rows: Sequence[Any], results: Sequence[Any]) -> None:
        self.parameters = {name: np.array([row[k] for row in rows]) for k, name in enumerate(names)}
        self.status = [Status(r.status) if r else Status.STOP_CANCELLED for r in results]
        self.messages = {k: r.message for k, r in enumerate(results) if r and r.message}
        self.warnings = [r.warnings if r else () for r in results]
        done = [r.values for r in results if r and r.values]
        shapes = {name: values.shape for name, values in done[0].items()} if done else {}
        if any(values.keys() != shapes.keys() for values in done):
            raise ValueError("reduce() returned different names")
        self._values = {name: _stacked(name, shape, results) for name, shape in shapes.items()}

    def __len__(self) -> int:
        return len(self.status)

    def __repr__(self) -> str:
        return f"<sweep of {len(self)} runs, {len(self.messages)} failed>"

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a table of the parameters, and of the results that are one number for each run.
        Raises ImportError without pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("Sweep.to_dataframe() needs pandas: pip install pandas") from error
        both = {**self.parameters, **self._values}
        flat = {name: x.reshape(len(self)) for name, x in both.items() if x.size == len(self)}
        return pandas.DataFrame({**flat, "status": [one.name for one in self.status]})


def _stacked(name: str, shape: tuple[int, ...], results: Sequence[_Result | None]) -> Array:
    stacked = np.full((len(results), *shape), np.nan)
    for k, result in enumerate(results):
        if result and name in result.values:
            if result.values[name].shape != shape:
                raise ValueError(f"reduce() returned {name} of different shapes")
            stacked[k] = result.values[name]
    return stacked


def sweep(
    mechanism: Mechanism,
    parameters: Mapping[str, ArrayLike],
    times: ArrayLike,
    method: Any = None,
    *,
    record: ChannelLike | Sequence[ChannelLike] = (),
    reduce: Reduce | None = None,
    samples: Any = "rows",
    count: int | None = None,
    executor: Any = None,
    progress: Callable[[int, int], Any] | bool | None = None,
    file: str | os.PathLike[str] | None = None,
    **options: Any,
) -> Sweep:
    """Run a mechanism once for each sample of its parameters.

    mechanism: the mechanism, which may be frozen or not.
    parameters: a dict from "element.field" to values, such as {"rod.mass": [0.1, 0.2]}. If the
        field is a vector, the values have the shape (n x size).
    method: the integrator, such as "rk8".
    times, record, options: as in Mechanism.simulate().
    reduce: a function that takes a Run and returns a number, an array or a dict of them. The sweep
        keeps this result instead of the recorded values of the run.
    samples: "rows" uses the first value of every parameter for the first run, the second value for
        the second run, and so on. "grid" uses all combinations of values. A sampler with a method
        random(count), such as scipy.stats.qmc.Sobol, draws `count` samples; the values of a
        parameter are then its lower and its upper bound.
    executor: an object with a method submit() or map(), such as an executor of concurrent.futures,
        of Dask or of mpi4py. By default the sweep uses threads, which is sufficient unless the
        mechanism has Python functions. Results do not depend on the executor. If the executor uses
        other processes, they must be able to import `reduce` and the functions of the mechanism.
    progress: True shows a bar. If you give a function, it is called with the number of finished
        runs and the number of all runs. If it returns a true value, the sweep is cancelled, and the
        remaining runs have the status STOP_CANCELLED.
    file: a file that keeps finished runs, so that a sweep that was interrupted continues when you
        call sweep() again. The file of another sweep, or of another version of baum, is refused
        with ValueError. To recognize its file, a sweep compares `reduce` and the functions of the
        mechanism by their names and their code, but not by the values of other variables that they
        use. The file is a pickle; open only files that you trust.

    A run that fails does not stop the other runs. Raises KeyError if the element of a parameter
    does not exist, TypeError if the element does not have the field of the parameter, and TypeError
    or ValueError if the values of a parameter have a wrong form.
    """
    columns = _columns(parameters)
    rows = _rows(columns, samples, count)
    first = vector(np.atleast_1d(times), None, "times")
    frozen = mechanism if mechanism.frozen else mechanism.copy().freeze()
    listed = several(record)
    task = _Task(frozen, tuple(columns), first, method, listed, reduce, options)
    # Wrong names raise their exceptions here. Values that the library refuses are ignored here,
    # because they only make their own run fail.
    with contextlib.suppress(Error):
        frozen.copy(**_changes(task.names, rows[0] if rows else ()))
    kept = _File(file, task, rows) if file is not None else None
    results: list[_Result | None] = kept.read() if kept else [None] * len(rows)
    if executor is not None:
        _fill(results, executor, task, rows, progress, kept)
    else:
        ended = threading.Event()
        # After Ctrl-C, or if `progress` cancels the sweep, the runs in other threads stop, too.
        task = task._replace(options={**options, "progress": lambda t: ended.is_set()})
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
            try:
                _fill(results, threads, task, rows, progress, kept)
            finally:
                ended.set()
    return Sweep(task.names, rows, results)


def _fill(
    results: list[_Result | None],
    executor: Any,
    task: _Task,
    rows: Sequence[Any],
    progress: Any,
    kept: _File | None,
) -> None:
    """Run all rows that have no result yet, and store their results."""
    missing = [k for k, result in enumerate(results) if result is None]
    size = max(1, len(missing) // (CHUNKS * _workers(executor)))
    parts = [missing[k : k + size] for k in range(0, len(missing), size)]
    out = stream() if progress is True else None
    line = Line(out, "sweep") if out else None
    done = len(rows) - len(missing)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the sweep lists the warnings of its runs
        for k, found in _calls(executor, task, [[rows[i] for i in part] for part in parts]):
            for i, result in zip(parts[k], found):
                results[i] = result
            done += len(found)
            if kept:
                kept.write(results, done == len(rows))
            if line:
                line.update(done / len(rows))
            if callable(progress) and progress(done, len(rows)):
                break
    if kept:
        kept.write(results, True)
    if line:
        line.close()


def _plain(value: Any) -> Any:
    """Convert a value to lists and simple objects whose repr() is exact, and the same in every
    process. A function is converted to its name and its code, without the values of variables that
    it uses."""
    if isinstance(value, types.CodeType):
        return value.co_code, value.co_names, _plain(value.co_consts)
    if isinstance(value, Gains):
        return value.name, _plain(value.values)
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (set, frozenset)):
        return sorted(map(repr, value))  # the order of a set depends on the process
    if isinstance(value, Mapping):
        return sorted((str(name), _plain(x)) for name, x in value.items())
    if isinstance(value, (list, tuple)):
        return [_plain(x) for x in value]
    if callable(value) or isinstance(value, ctypes.c_void_p):
        named = value if hasattr(value, "__qualname__") else type(value)
        code = _plain(getattr(value, "__code__", None))
        return named.__module__, named.__qualname__, code
    return repr(value)


def _hash(data: bytes) -> bytes:
    """Return the hash of data as DIGITS characters."""
    return hashlib.sha256(data).hexdigest().encode()


class _File:
    """The file that keeps the finished runs of a sweep. It contains the hash of everything that the
    results depend on, the hash of the pickled results, and the pickled results."""

    def __init__(self, path: str | os.PathLike[str], task: _Task, rows: Sequence[Any]) -> None:
        self._path = Path(path)
        self._count = len(rows)
        self._next = 0.0
        functions = [value for _, (value, _) in task.mechanism.kept_objects()]
        record = [one.key if isinstance(one, Channel) else one for one in task.record]
        key = [_abi.VERSION, task.mechanism.scene(), functions, *task[1:4], rows, record]
        key += [task.reduce, task.options]
        self._key = _hash(repr(_plain(key)).encode())

    def read(self) -> list[_Result | None]:
        if not self._path.exists():
            return [None] * self._count
        whole = self._path.read_bytes()
        key, check, data = whole[:DIGITS], whole[DIGITS : 2 * DIGITS], whole[2 * DIGITS :]
        if check != _hash(data):
            raise ValueError(f"{self._path}: this is not the file of a sweep, or it is damaged")
        if key != self._key:
            raise ValueError(f"{self._path}: this file is of another sweep")
        found: list[_Result | None] = pickle.loads(data)
        return found

    def write(self, results: list[_Result | None], whole: bool) -> None:
        """Replace the file, at most once per second unless the sweep has ended."""
        if not whole and time.monotonic() < self._next:
            return
        self._next = time.monotonic() + 1.0
        data = pickle.dumps(results)
        _files.write(self._path, self._key + _hash(data) + data)
