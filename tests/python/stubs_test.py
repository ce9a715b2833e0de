"""The type stubs name what the module has, and nothing is without a docstring."""

import ast
import pathlib
import unittest

try:
    import tomllib
except ImportError:
    tomllib = None

from support import hysteron_cloth, program

MODULE = hysteron_cloth._hysteron
STUB = ast.parse(pathlib.Path(MODULE.__file__).with_name("_hysteron.pyi").read_text())


def names(body):
    """Public names that these statements of a stub define."""
    found = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            found.add(node.target.id)
    return {name for name in found if not name.startswith("_")}


def public(owner):
    return {name for name in vars(owner) if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def test_name_every_function_and_class(self):
        self.assertEqual(names(STUB.body), public(MODULE))
        self.assertGreater(len(names(STUB.body)), 10)

    def test_name_every_member(self):
        keys = {row["key"][len("fabric."):].replace("-", "_") for row in hysteron_cloth.scene_keys()
                if row["key"].startswith("fabric.")}
        for node in STUB.body:
            if isinstance(node, ast.ClassDef):
                with self.subTest(of=node.name):
                    members = names(node.body) - (keys if node.name == "Fabric" else set())
                    self.assertEqual(members, public(getattr(MODULE, node.name)))

    def test_of_docstrings_none_is_missing(self):
        for owner in (MODULE, *(vars(MODULE)[name] for name in public(MODULE) if isinstance(vars(MODULE)[name], type))):
            for name in public(owner):
                self.assertTrue(getattr(owner, name).__doc__, f"{owner.__name__}.{name}")

    def test_of_docstrings_and_types_in_python_none_is_missing(self):
        files = [file for file in pathlib.Path(hysteron_cloth.__file__).parent.glob("*.py")]
        self.assertGreater(len(files), 4)
        for node in (node for file in files for node in ast.walk(ast.parse(file.read_text()))):
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not node.name.startswith("_"):
                self.assertTrue(ast.get_docstring(node), node.name)
            if isinstance(node, ast.FunctionDef):
                arguments = node.args.posonlyargs + node.args.args + node.args.kwonlyargs
                untyped = [each.arg for each in arguments if each.annotation is None and each.arg != "self"]
                self.assertEqual((untyped, node.returns is None), ([], False), node.name)


class Build(unittest.TestCase):
    def test_says_whether_it_has_cuda(self):
        lacks = "this program was built without CUDA" in program("list", "devices")
        self.assertEqual(hysteron_cloth.has_cuda, not lacks)

    @unittest.skipIf(tomllib is None, "needs Python 3.11")
    def test_by_pip_is_named_for_cloth_and_without_cuda_unless_asked(self):
        pyproject = tomllib.loads((pathlib.Path(__file__).parents[2] / "pyproject.toml").read_text())
        self.assertEqual(pyproject["project"]["name"], "hysteron-cloth")
        self.assertEqual(pyproject["tool"]["scikit-build"]["cmake"]["define"]["HYSTERON_CUDA"], "OFF")
        self.assertIn("hysteron", pyproject["tool"]["scikit-build"]["build"]["targets"])  # program_test.py runs it


if __name__ == "__main__":
    unittest.main()
