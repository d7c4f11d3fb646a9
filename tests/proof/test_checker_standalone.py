"""The checker as a sceptic runs it: one file, no installed package, an exit code."""

import ast
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CHECKER = ROOT / "workbench" / "proof" / "checker.py"
PROOFS = ROOT / "proofs"


def run(folder):
    command = [sys.executable, "-I", str(CHECKER), str(folder)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_it_imports_the_standard_library_only():
    tree = ast.parse(CHECKER.read_text(encoding="utf-8"))
    imported = {alias.name.partition(".")[0] for node in ast.walk(tree) if isinstance(node, ast.Import)
                for alias in node.names}
    imported |= {(node.module or ".").partition(".")[0] for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert imported <= set(sys.stdlib_module_names)
    called = {node.func.id for node in ast.walk(tree)
              if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}
    assert called.isdisjoint({"eval", "exec", "compile", "__import__", "open"})


def test_all_committed_certificates_hold():
    done = run(PROOFS)
    assert done.returncode == 0, done.stdout
    assert len(done.stdout.splitlines()) == len([p for p in PROOFS.rglob("*.json") if p.name != "manifest.json"]) > 0
    assert done.stderr == ""


@pytest.mark.parametrize(("with_manifest", "reason"), [(True, "names another content for it"), (False, "")])
def test_one_tampered_certificate_is_named_and_fails_the_run(tmp_path, with_manifest, reason):
    shutil.copytree(PROOFS / "yang2021" / "certificates", tmp_path / "c" / "yang2021",
                    ignore=shutil.ignore_patterns("gains", *(() if with_manifest else ("manifest.json",))))
    path = tmp_path / "c" / "yang2021" / "20.json"
    certificate = json.loads(path.read_text(encoding="utf-8"))
    certificate["goal"]["show"] = [text.replace(">", "<") for text in certificate["goal"]["show"]]
    path.write_text(json.dumps(certificate), encoding="utf-8")
    done = run(tmp_path / "c")
    assert done.returncode == 1
    invalid = [line for line in done.stdout.splitlines() if line.startswith("INVALID")]
    assert len(invalid) == 1
    assert "20.json: " in invalid[0] and reason in invalid[0]
    assert with_manifest or "manifest" not in invalid[0]


def test_an_empty_or_missing_folder_is_no_success(tmp_path):
    assert run(tmp_path).returncode == 2
    assert run(tmp_path / "missing").returncode == 2
