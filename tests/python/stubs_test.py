"""The stubs say what the package has, under the same parameters, and everything public explains itself."""

import ast
import inspect
import pathlib
import unittest

import talus


def declared(tree):
    """Name -> parameters, of functions and of the classes' methods ("Model.block")."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, parameters(node)
        if isinstance(node, ast.ClassDef):
            for method in node.body:
                if isinstance(method, ast.FunctionDef):
                    yield f"{node.name}.{method.name}", parameters(method)


def parameters(node):
    arguments = node.args
    names = [each.arg for each in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
    return [*names, *(each.arg for each in (arguments.vararg, arguments.kwarg) if each)]


def public(owner):
    return [name for name in vars(owner) if not name.startswith("_")]


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        text = (pathlib.Path(talus.__file__).parent / "__init__.pyi").read_text()
        cls.tree = ast.parse(text)
        cls.declared = dict(declared(cls.tree))

    def test_parameters(self):
        for name, wanted in self.declared.items():
            owner, _, method = name.rpartition(".")
            found = inspect.getattr_static(getattr(talus, owner) if owner else talus, method)
            if isinstance(found, property):
                continue
            if isinstance(found, (classmethod, staticmethod)):
                found = found.__func__
            with self.subTest(name):
                self.assertEqual(list(inspect.signature(found).parameters), wanted)

    def test_nothing_is_left_out(self):
        classes = {node.name for node in self.tree.body if isinstance(node, ast.ClassDef)}
        for name in talus.__all__:
            with self.subTest(name):
                thing = getattr(talus, name)
                if not inspect.isclass(thing):
                    self.assertIn(name, self.declared)
                    continue
                self.assertIn(name, classes)
                body = next(node for node in self.tree.body if getattr(node, "name", "") == name).body
                known = {getattr(node, "name", None) or getattr(getattr(node, "target", None), "id", None) for node in body}
                self.assertEqual(sorted(set(public(thing)) - known), [])

    def test_docstrings(self):
        self.assertIn("SI", talus.__doc__)
        for name in talus.__all__:
            thing = getattr(talus, name)
            self.assertTrue(inspect.getdoc(thing), name)
            for method in public(thing) if inspect.isclass(thing) else ():
                if callable(getattr(thing, method)) or isinstance(inspect.getattr_static(thing, method), property):
                    self.assertTrue(inspect.getdoc(inspect.getattr_static(thing, method)), f"{name}.{method}")


if __name__ == "__main__":
    unittest.main()
