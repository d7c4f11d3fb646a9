"""A reader with pencil and paper: evaluates the formulas of a proof as it is told, at numbers for its letters, knowing
nothing of the certificate that they were made from."""

import math
import re

TOKEN = re.compile(r"\\left[(|]|\\right[)|]|\\[A-Za-z]+|\d+(?:\.\d+)?|[A-Za-z]|[\[\]{}^_+\-,*=<>]|\s+|.")
FUNCTIONS = {r"\ln": math.log, r"\tanh": math.tanh, r"\sqrt": math.sqrt}
BRACKETS = {r"\left(": r"\right)", r"\left|": r"\right|"}
NO_LETTERS = (r"\sum", r"\text", r"\operatorname", r"\max", r"\min")
ACCENTS = (r"\hat", r"\tilde", r"\bar", r"\dot", r"\ddot", r"\mathrm")


class UnreadError(Exception):
    """Sums over an index, derivatives and what else is not read here."""


class Formula:
    """The value of a formula; letters: numbers for its letters; lines: values of the lines that [n] stands for."""

    def __init__(self, latex, letters, lines):
        self.tokens = [token for token in TOKEN.findall(latex) if token.strip()]
        self.at, self.letters, self.lines = 0, letters, lines

    def value(self):
        found = self.sum()
        if self.at < len(self.tokens):
            raise UnreadError(self.tokens[self.at])
        return found

    def next(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, token=None):
        found = self.next()
        if token is not None and found != token:
            raise UnreadError(f"{found} for {token}")
        self.at += 1
        return found

    def sum(self):
        found = 0.0
        sign = -1 if self.next() == "-" and self.take() else 1
        while True:
            found += sign * self.product()
            if self.next() not in ("+", "-"):
                return found
            sign = -1 if self.take() == "-" else 1

    def product(self):
        found = self.power()
        while self.next() and self.next() not in ("+", "-", "}", r"\right)", r"\right|"):
            if self.next() in (r"\cdot", r"\times"):
                self.take()
            found *= self.power()
        return found

    def power(self):
        if self.next() == "e" and self.tokens[self.at + 1:self.at + 2] == ["^"]:
            self.take()
            self.take("^")
            return math.exp(self.group())
        base = self.atom()
        if self.next() == "^":
            self.take()
            return base ** self.group()
        return base

    def group(self):
        self.take("{")
        found = self.sum()
        self.take("}")
        return found

    def atom(self):
        token = self.take()
        if token in BRACKETS:
            found = self.sum()
            self.take(BRACKETS[token])
            return found if token == r"\left(" else abs(found)
        if token == r"\frac":
            return self.group() / self.group()
        if token == "[":
            number = int(self.take())
            self.take("]")
            return self.lines[number]
        if token in FUNCTIONS:
            return FUNCTIONS[token](self.group() if token == r"\sqrt" else self.atom())
        return float(token) if token[0].isdigit() else self.letter(token)

    def letter(self, token):
        """A letter with its accents, its indices and its star, which a power stands behind in one bracket."""
        if not (token[0] == "\\" or token.isalpha()) or token in NO_LETTERS:
            raise UnreadError(token)
        name = token + (self.raw() if token in ACCENTS else "")
        if self.next() == "_":
            name += self.take() + self.raw()
        if self.tokens[self.at:self.at + 3] == ["^", "{", "*"]:
            self.at += 3
            power = 1.0 if self.next() == "}" else self.sum()
            self.take("}")
            return self.letters(f"{name}*") ** power
        return self.letters(name)

    def raw(self):
        found = self.take("{")
        depth = 1
        while depth:
            token = self.take()
            if not token:
                raise UnreadError("the end")
            depth += (token == "{") - (token == "}")
            found += token
        return found


def difference(relation, letters, lines):
    """The smaller side of a relation taken from the greater one."""
    found = re.fullmatch(r"(.*?) (\\le|\\ge|\\ne|=|<|>) (.*)", relation, re.DOTALL)
    if found is None:
        raise UnreadError(relation)
    a, b = (Formula(side, letters, lines).value() for side in (found[1], found[3]))
    return b - a if found[2] in (r"\le", "<") else a - b
