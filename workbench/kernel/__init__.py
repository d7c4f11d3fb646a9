"""Certificates as Coq files, for whoever would rather believe Coq's kernel than the checker."""
