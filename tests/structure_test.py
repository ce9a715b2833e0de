"""Sources include and call each other one way only; what docs/ quotes of them is what they say.

Folders: python -> experiments -> render -> libraries beside the simulation -> the rest of sim, and inside each of them
no folder one that includes it, directly or through others.  Nor does a folder call what is defined above it.
"""
import re
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# Each may include those before it; the folder of the longest name counts.
LAYERS = ["sim", "sim/reference", "sim/identification", "render", "experiments", "python"]
INCLUDE = re.compile(r'#\s*include "((?:sim|render|experiments|python)(?:/[^"/]+)*)/[^/"]+"')
FUNCTION = re.compile(
    r"^(?! |using|struct|class|template|namespace|extern|typedef|enum|inline|constexpr|static_assert|#|/)"
    r"[\w:<>,&* ]+[ &*](?:\w+::)?(\w+)\([^;{]*([;{])", re.M)
QUOTATION = re.compile(r"<!-- (tests/\S+):begin -->\n```[a-z]*\n(?:(.*?)```\n<!-- \1:end -->)?", re.S)


def layer(folder):
    return max((LAYERS.index(name) for name in LAYERS if f"{folder}/".startswith(name + "/")),
               key=lambda i: len(LAYERS[i]), default=-1)


def folders_in(root):
    """Returns what each folder includes."""
    folders = {}
    for file in (file for name in LAYERS for file in (root / name).rglob("*")):
        if file.suffix in (".h", ".cpp", ".in"):
            folder = file.parent.relative_to(root).as_posix()
            folders.setdefault(folder, set()).update(set(INCLUDE.findall(file.read_text("utf-8"))) - {folder})
    return folders


def leads_to(folders, start, to):
    seen, waiting = set(), [start]
    while waiting:
        at = waiting.pop()
        if at == to:
            return True
        if at not in seen:
            seen.add(at)
            waiting += folders.get(at, ())
    return False


def arrows_back(folders):
    return [f"{folder} -> {other}" for folder in sorted(folders) for other in sorted(folders[folder])
            if layer(other) > layer(folder) or leads_to(folders, other, folder)]


def defined_above(root, folder):
    """"experiments() of sim/a/a.h": functions that a folder's headers promise, not indented, and that no file in it
    defines, so that whoever calls them calls up."""
    declared, defined = {}, {"embedded_file"}  # which the build defines
    for file in (root / folder).rglob("*"):
        for name, end in FUNCTION.findall(file.read_text("utf-8", "replace") if file.is_file() else ""):
            if end == "{":
                defined.add(name)
            elif file.suffix == ".h":
                declared[name] = file.relative_to(root).as_posix()
    return [f"{name}() of {declared[name]}" for name in sorted(declared.keys() - defined)]


class Sources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")

    def assert_back(self, *arrows):
        self.assertEqual(arrows_back(folders_in(self.folder)), list(arrows))

    def test_call_one_way(self):
        for folder in ("sim", "render", "experiments/workbench"):
            self.assertEqual(defined_above(ROOT, folder), [])

    def test_that_call_up_are_found(self):
        self.write("sim/a/a.h", "const std::vector<int>& all();\nint one(int a,\n        int b);\n")
        self.write("sim/a/a.cpp", "int one(int a,\n        int b) {\n  return all()[a + b];\n}\n")
        self.assertEqual(defined_above(self.folder, "sim"), ["all() of sim/a/a.h"])

    def test_include_one_way(self):
        folders = folders_in(ROOT)
        self.assertGreater(len(folders), 30)
        self.assertEqual(arrows_back(folders), [])

    def test_that_include_back_are_found(self):
        for name, included, arrows in (
                ("sim/a/a.h", "sim/b/b.h", []),
                ("sim/b/b.cpp", "sim/c/c.h", []),
                ("sim/c/c.cpp", "sim/a/a.h", ["sim/a -> sim/b", "sim/b -> sim/c", "sim/c -> sim/a"]),
                ("sim/c/c.cpp", "sim/identification/i.h", ["sim/c -> sim/identification"]),
                ("experiments/a/a.cpp", "python/a.h", ["experiments/a -> python", "sim/c -> sim/identification"]),
                ("experiments/a/a.cpp", "sim/a/a.h", ["sim/c -> sim/identification"]),
                ("sim/c/c.cpp", "render/a/a.h", ["sim/c -> render/a"])):
            self.write(name, f'#include "{included}"\n')
            self.assert_back(*arrows)


class Quotations(unittest.TestCase):
    def test_in_the_documentation_are_the_files_that_they_name(self):
        found = [found for page in sorted((ROOT / "docs").glob("*.md"))
                 for found in QUOTATION.findall(page.read_text("utf-8"))]
        self.assertEqual(len(found), 2, "scripts of Python")
        for file, text in found:
            self.assertEqual(text, (ROOT / file).read_text("utf-8"), file)

    def test_without_an_end_are_empty(self):
        self.assertEqual(QUOTATION.findall("<!-- tests/a.h:begin -->\n```cpp\nint a;\n```\n<!-- tests/a.h:end -->\n"
                                           "<!-- tests/b.h:begin -->\n```cpp\nint b;\n```\n"),
                         [("tests/a.h", "int a;\n"), ("tests/b.h", "")])


if __name__ == "__main__":
    unittest.main()
