"""Every data plugin that reads files has a corpus, and every corpus a plugin."""
import pathlib
import re
import sys

here = pathlib.Path(__file__).resolve().parent
plugins = here.parent.parent / "plugins" / "data"
readers = {folder.name for folder in plugins.iterdir()
           if folder.is_dir() and any(re.search(r'\{"file",\s', source.read_text()) for source in folder.glob("*.cpp"))}
corpora = {folder.name for folder in (here / "corpus").iterdir() if any(folder.iterdir())} - {"config"}
for name in sorted(readers - corpora):
    print(f"reader {name} has no corpus: add tests/fuzz/corpus/{name} with a few small files")
for name in sorted(corpora - readers):
    print(f"corpus {name} belongs to no reader")
print(f"{len(readers & corpora)} readers have a corpus")
sys.exit(0 if readers and readers == corpora else 1)
