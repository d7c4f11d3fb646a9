"""What the checker says of a certificate."""

import re

import pytest

from workbench.proof.checker import CertificateError, check


def accepted(certificate):
    try:
        check(certificate)
    except CertificateError:
        return False
    return True


def assert_refused(certificate, reason):
    """It is refused, in words that the pattern finds."""
    with pytest.raises(CertificateError) as caught:
        check(certificate)
    assert re.search(reason, str(caught.value)), caught.value
