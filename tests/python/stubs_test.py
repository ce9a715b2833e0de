"""The type stubs name what the module has, and nothing is without a docstring."""

import ast
import pathlib
import unittest

from support import hysteron

MODULE = hysteron._hysteron
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
        keys = {row["key"][len("fabric."):].replace("-", "_") for row in hysteron.scene_keys()
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


if __name__ == "__main__":
    unittest.main()
