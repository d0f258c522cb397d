"""Markdown tables, and their place in config/documentation/accuracy.md."""

from .run import ROOT


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def into_page(name, text, page=ROOT / "config" / "documentation" / "accuracy.md"):
    """Replaces what stands between <!-- NAME --> and <!-- /NAME -->."""
    begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->\n"
    before, found, rest = page.read_text(encoding="utf-8").partition(begin)
    after = rest.partition(end)
    if not found or not after[1]:
        raise SystemExit(f"{page} has no marks for '{name}'")
    page.write_text(before + begin + text + end + after[2], encoding="utf-8")
