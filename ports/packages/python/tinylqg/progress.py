# SPDX-License-Identifier: MIT
"""Work that an executor does, in order, with a bar of tqdm where that is installed."""

import warnings


def done(function, tasks, executor, progress, what):
    """function(*task) of each task, in their order. An executor has submit(function, *arguments), whose result has
    result(); without one the tasks are done here. What a task raises is raised."""
    tasks = list(tasks)
    if executor is None:
        results = (function(*task) for task in tasks)
    else:
        futures = [executor.submit(function, *task) for task in tasks]
        results = (future.result() for future in futures)
    return list(shown(results, len(tasks), progress, what))


def shown(results, count, progress, what):
    """`results` under a bar; progress: True, False, or None for one on a terminal."""
    if progress is False:
        return results
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of notebooks without widgets: the bar is text there
            from tqdm.auto import tqdm
    except ImportError:
        if progress:
            from .errors import needs

            raise needs("tqdm", "progress=True", "progress") from None
        return results
    return tqdm(results, total=count, desc=what, disable=None if progress is None else False)
