"""The grammar of a line, over the words that `tokens` makes; LALR(1), so that reading takes time in proportion."""

from __future__ import annotations

GRAMMAR = r"""
line: separators? chain (separators chain)* separators?
separators: (COMMA | COLON | WORDS | IMPLIES | IFF | QUANTIFIER)+
chain: terms (RELATION (terms | words))*
words: WORDS
terms: term (signed)*
?term: product | MINUS product -> negative | PLUS product -> positive | PLUS_MINUS product -> either
signed: PLUS product -> positive | MINUS product -> negative | PLUS_MINUS product -> either
product: factor (CDOT factor | SLASH factor | factor)*
factor: primary script*
script: SUB | MARK | TRANSPOSE | SUP LB terms RB
primary: LETTER -> letter
    | NUMBER -> number
    | NAMED -> named
    | BIG -> big
    | ELLIPSIS -> ellipsis
    | AT -> at
    | FRAC LB terms RB LB terms RB -> fraction
    | SQRT LB terms RB -> root
    | ACCENT LB terms RB -> accent
    | BARS_OPEN line BARS_CLOSE -> size
    | OPEN line CLOSE -> group
    | LB terms RB -> braces
%declare COMMA COLON WORDS IMPLIES IFF QUANTIFIER RELATION MINUS PLUS PLUS_MINUS CDOT SLASH
%declare SUB MARK TRANSPOSE SUP LB RB LETTER NUMBER NAMED BIG ELLIPSIS AT FRAC SQRT ACCENT
%declare BARS_OPEN BARS_CLOSE OPEN CLOSE
"""
