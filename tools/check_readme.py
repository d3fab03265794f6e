#!/usr/bin/env python3
"""The README shows real files: each code block that follows a line ending in `path`: must be that file's text.
With --write the blocks are replaced by the files."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"(`(?P<path>[\w./]+)`[:,]\n\n```\w+\n)(?P<text>.*?)(?=```\n)", re.S)


def main():
    readme = ROOT / "README.md"
    text = readme.read_text()
    current = BLOCK.sub(lambda m: m.group(1) + (ROOT / m.group("path")).read_text(), text)
    blocks = [m.group("path") for m in BLOCK.finditer(text)]
    if "--write" in sys.argv[1:]:
        readme.write_text(current)
    elif current != text:
        stale = [m.group("path") for m in BLOCK.finditer(text) if (ROOT / m.group("path")).read_text() != m.group("text")]
        print(f"README.md shows an older text of {', '.join(stale)}; tools/check_readme.py --write takes the new one")
        return 1
    print(f"README.md: {len(blocks)} files shown: {', '.join(blocks)}")
    return 0 if blocks else 1


if __name__ == "__main__":
    sys.exit(main())
