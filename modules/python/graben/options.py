"""Keyword arguments as the words of the commands, whose defaults, ranges and choices hold for Python too."""

import numbers
from typing import Any, Dict, Iterable, List


def _word(name: str, value: Any) -> str:
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, str):
        return value
    raise ValueError(f"{name}: a number or a word was expected, not {value!r}")


def words(options: Dict[str, Any], lists: Iterable[str] = ()) -> List[str]:
    """The command line that says the same; what is None or False is not said.

    Options named in lists take several words each; a tuple elsewhere is one word of numbers with commas between.
    """
    line: List[str] = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            line.append(option)
        elif name in lists:
            several = [value] if isinstance(value, (str, numbers.Real)) else list(value)
            line.extend(f"{option}={_word(name, one)}" for one in several)
        elif isinstance(value, (tuple, list)):
            line.append(f"{option}=" + ",".join(_word(name, one) for one in value))
        else:
            line.append(f"{option}={_word(name, value)}")
    return line
