"""Which test process runs which test: those of a file in one process, so that a study, an environment or a reference
solution that several of them look at is made once; long tests that share nothing follow one by one, so that both
processes end together."""

# Node ids of tests that share nothing with the others of their file begin with these.
APART = (
    "tests/proof/test_claims.py::test_proved_claim_is_not_broken_by_random_search",
    "tests/proof/test_tampering.py::test_no_corrupted_certificate",
    "tests/test_closed_loop.py::",
    "tests/test_optimal_nlp.py::",
    "tests/test_reference_command.py::",
)


def unit_of(nodeid: str) -> str:
    """The name of what a test is handed out with: its file, or the test alone."""
    return nodeid if nodeid.startswith(APART) else nodeid.partition("::")[0]


def scheduler_of_files(config, log):
    """xdist's scheduler that hands out whole units, those with most tests first, to whichever process is free."""
    from xdist.scheduler import LoadScopeScheduling

    class FileScheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return unit_of(nodeid)

    return FileScheduling(config, log)
