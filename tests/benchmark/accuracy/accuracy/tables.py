"""Markdown tables, and their place in README.md."""

from .run import ROOT


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def into_readme(name, text, readme=ROOT / "README.md"):
    """Replaces what stands between <!-- NAME --> and <!-- /NAME -->."""
    begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->\n"
    before, found, rest = readme.read_text(encoding="utf-8").partition(begin)
    after = rest.partition(end)
    if not found or not after[1]:
        raise SystemExit(f"{readme} has no marks for '{name}'")
    readme.write_text(before + begin + text + end + after[2], encoding="utf-8")
