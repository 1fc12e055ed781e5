"""Pages with tables that are made, each between ``<!-- name -->`` and ``<!-- end of name -->``."""

from collections.abc import Iterable


def replaced(page: str, name: str, lines: Iterable[str]) -> str:
    """The page with one table made anew. Raises ValueError where it has no such markers."""
    start, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
    head, found, rest = page.partition(start)
    _, closed, tail = rest.partition(end)
    if not (found and closed):
        raise ValueError(f"the page has no {start} ... {end}")
    return "\n".join([f"{head}{start}", *lines, f"{end}{tail}"])
