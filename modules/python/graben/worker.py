"""python -m graben.worker: does the tasks that graben.workers sends, until there are no more."""

import os
import sys

from .workers import attempt, receive, send


def main() -> None:
    tasks = sys.stdin.buffer
    results = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what libraries print is no result
    try:
        task, job = receive(tasks)
        while True:
            send(results, attempt(task, job, receive(tasks)))
    except (EOFError, BrokenPipeError, KeyboardInterrupt):
        os._exit(0)


if __name__ == "__main__":
    main()
