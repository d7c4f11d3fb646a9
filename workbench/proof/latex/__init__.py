"""The LaTeX that papers print, read into expressions and relations."""
