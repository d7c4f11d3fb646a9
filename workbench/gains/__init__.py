"""Gains and certificates: searched by semidefinite programs, confirmed in exact arithmetic."""
