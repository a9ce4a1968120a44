"""`import engdyn` is cheap, complete and tells type checkers the truth."""

from __future__ import annotations

import ast
import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import engdyn

HEAVY = ("IPython", "flint", "ipywidgets", "matplotlib", "numba", "numpy", "pandas", "pint", "scipy", "sympy")


def _loaded_after(statement: str) -> set[str]:
    code = f"import sys; {statement}; print(*sorted(m for m in sys.modules if '.' not in m))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_import_loads_nothing_heavy():
    loaded = _loaded_after("import engdyn")
    assert "engdyn" in loaded
    assert loaded.isdisjoint(HEAVY)


def test_errors_load_nothing_heavy():
    assert _loaded_after("import engdyn; engdyn.EngdynError").isdisjoint(HEAVY)


def test_all_is_sorted_and_free_of_duplicates():
    assert engdyn.__all__ == sorted(set(engdyn.__all__))


@pytest.mark.parametrize("name", engdyn.__all__)
def test_every_public_name_resolves_to_its_own_name(name):
    value = getattr(engdyn, name)
    if inspect.ismodule(value):
        assert value.__name__ == f"engdyn.{name}"
    else:
        assert value.__name__ == name
        assert value.__module__.startswith("engdyn.")


def test_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no_such_name"):
        _ = engdyn.no_such_name


def _stub_names(stub: Path) -> tuple[dict[str, str], list[str]]:
    """Imported name → module as the stub says, and the stub's ``__all__``."""
    homes: dict[str, str] = {}
    public: list[str] = []
    for node in ast.parse(stub.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom):
            homes.update({alias.asname or alias.name: node.module or "" for alias in node.names})
        elif isinstance(node, ast.Assign):
            public = ast.literal_eval(node.value)
    return homes, public


def _attached(package: Path) -> dict[str, str]:
    """Name → module as the call of ``lazy_loader.attach`` in a package's ``__init__.py`` says."""
    calls = [
        node
        for node in ast.walk(ast.parse(package.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "attach"
    ]
    assert len(calls) == 1
    keywords = {keyword.arg: keyword.value for keyword in calls[0].keywords}
    names = ["package_name", "submodules", "submod_attrs"]
    keywords.update(dict(zip(names, calls[0].args, strict=False)))
    homes = dict.fromkeys(ast.literal_eval(keywords.get("submodules") or ast.List(elts=[])), "")
    for module, attributes in ast.literal_eval(
        keywords.get("submod_attrs") or ast.Dict(keys=[], values=[])
    ).items():
        homes.update(dict.fromkeys(attributes, module))
    return homes


LAZY_PACKAGES = sorted(
    path.relative_to(Path(engdyn.__file__).parent).as_posix()
    for path in Path(engdyn.__file__).parent.rglob("__init__.py")
    if "lazy_loader.attach" in path.read_text(encoding="utf-8")
)


@pytest.mark.parametrize("package", LAZY_PACKAGES)
def test_stub_and_attach_agree(package):
    init = Path(engdyn.__file__).parent / package
    homes, public = _stub_names(init.with_suffix(".pyi"))
    attached = _attached(init)
    assert homes == attached
    assert public == sorted(attached)


def test_only_public_namespaces_have_contents():
    root = Path(engdyn.__file__).parent
    filled = {
        path.parent.relative_to(root).as_posix()
        for path in root.rglob("__init__.py")
        if path.read_text().strip()
    }
    assert filled <= {".", "course", "plots", "systems", "widgets"}
