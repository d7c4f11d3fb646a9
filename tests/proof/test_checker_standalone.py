"""The checker as a sceptic runs it: one file, no installed package, an exit code."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import sympy as sp

from workbench.proof.checker import goal_digest
from workbench.proof.claim import Claim, Goal, at_least
from workbench.proof.decide.engine import decide
from workbench.proof.document import Places, write_certificates

ROOT = Path(__file__).parents[2]
CHECKER = ROOT / "workbench" / "proof" / "checker.py"
PROOFS = ROOT / "proofs"


def run(*arguments):
    command = [sys.executable, "-I", str(CHECKER), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def decided(number):
    """The decision of a true claim of its own."""
    x = sp.Symbol("x", real=True)
    return decide(Claim(id=f"doe2026:{number}", title="a claim", kind="inequality", printed="x", recorded="proved",
                        build=lambda: Goal((at_least((x - number) ** 2, 0),))))


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


def test_one_tampered_certificate_is_named_and_fails_the_run(tmp_path):
    write_certificates([decided(1), decided(2)], Places(tmp_path))
    assert run(tmp_path).returncode == 0
    path = tmp_path / "doe2026" / "2.json"
    path.write_text(path.read_text().replace(">=", "<="))
    done = run(tmp_path)
    assert done.returncode == 1
    invalid = [line for line in done.stdout.splitlines() if line.startswith("INVALID")]
    assert len(invalid) == 1
    assert "2.json: " in invalid[0] and "goal_digest" in invalid[0]


def test_one_file_alone_says_that_it_is_bound_to_no_claim(tmp_path):
    write_certificates([decided(1), decided(2)], Places(tmp_path))
    path = tmp_path / "doe2026" / "1.json"
    done = run(path)
    assert done.returncode == 1
    assert "holds, bound to no claim" in done.stdout
    digests = [goal_digest(json.loads((tmp_path / "doe2026" / f"{n}.json").read_text())) for n in (1, 2)]
    assert [run(path, "--claim-digest", digest).returncode for digest in digests] == [0, 1]
    assert run(tmp_path, "--claim-digest", digests[0]).returncode == 2
    assert run(path, "--digest", digests[0]).returncode == 2


def test_an_empty_or_missing_folder_is_no_success(tmp_path):
    assert run(tmp_path).returncode == 2
    assert run(tmp_path / "missing").returncode == 2
