#!/usr/bin/env python3
"""Numbers, tables and links of README.md and docs/: written from the results and from the program, or checked.

    tests/documentation.py docs            write what programs write in the folder's pages and the README.md beside it
    tests/documentation.py --check docs    write nothing; exit 4 if anything is not as it should be

`--hysteron PROGRAM` (build/hysteron) tells the tables of keys and of exit codes, which stand between
`<!-- keys:begin -->` and `<!-- keys:end -->`, and between those of `exit-codes`.

A number is a link: in the text `opens to [127.8° ± 0.1][crease-angle]`, at the page's foot
`[crease-angle]: results/crease-cotton-broad/errors.csv "recovery_angle_deg .1f° +-.1g"`.  The target is a file, as
seen from the page; the title is words apart by spaces, in single quotes where they hold some:

    a/manifest.json "recovery_angle_deg .1f° +-.1g"        a metric of the run; a/errors.csv means the same
    a/manifest.json "/steps ,"                             a JSON pointer, into any JSON file
    a/material.csv "10 'M0 [N]' .2g"                       a cell: the row's first field, the column
    a/table.csv "law=wong&element=hinge error .1f"         a cell of the row with these fields
    a/bench.json "law=wong element=hinge ms_per_step .1f"  the same in a list of objects

`minus SOURCE` and `over SOURCE` subtract another number or divide by it, of the same file unless one is named;
`times NUMBER` converts units.  Then the format: digits behind the point (.1f) or significant ones (.2g), with `+`
before them a sign; `,` is a count with thousands apart; the unit stands behind.  A cell that is `text` stands as it
is, an empty one as a dash.  `+-.1g` appends the errors that stand beside the number: of x its x_step_error,
x_mesh_error and x_draw_error, of x_mean the first two and its x_mean_stderr or x_stderr.

A table mirrors recorded files; one comment says what stands in it:

    <!-- table ../results/drapes/means.csv law=prandtl | fabric = cotton-broad as cotton broad; wool-tropical
    | coefficient [%] = fabric={} drape_coefficient_percent_mean .1f +-.1f
    | folds = fabric={} node_count_mean .1f -->
    ...
    <!-- /table -->

Between bars stand the columns.  The first has the rows: `HEAD = VALUE; VALUE as LABEL`, or `HEAD = each COLUMN` for
every value of a column of the file.  The others are `HEAD = SOURCE`, a title as above, in which {} is the row's
value, in the name of the file, too.  What stands behind the file goes before every source, but for those that begin
with a file of their own.  The first head links to the file, or each row's label to its own; ` / ` in the first head
and in labels begins another column of words.
"""

import argparse
import csv
import difflib
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

DIFFERS = 4


class Wrong(Exception):
    """A source, a table or a file is not as it must be: one line that says how."""


class Page:
    """A page's text, first as it stands, then as it should be; its faults as (line, what, mended in the text)."""

    def __init__(self, file):
        self.file, self.folder = file, file.parent
        self.text = file.read_text(encoding="utf-8")
        self.faults = []

    def fault(self, line, what, mended=False):
        self.faults.append((line, what, mended))


def line_at(text, place):
    return 1 + text.count("\n", 0, place)


def without_code(text):
    """The text with comments, fenced blocks and code spans replaced by blanks, letter by letter."""
    code = re.compile(r"<!--(?:.*?-->)?|(`{3,})(?:.*?\n\1)?|(`{1,2})(?:.*?\2)?", re.S)
    return code.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


# Files


def hint(name, known):
    nearest = difflib.get_close_matches(name, known, 1)
    return f"; did you mean {nearest[0]}?" if nearest else ""


def number_in(text):
    """Returns the number, or None for a text that is not a finite number."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def read_json(path, file):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError:
        raise Wrong(f"no file {file}") from None
    except ValueError as error:
        raise Wrong(f"{file} is no JSON: {error}") from None


def at_pointer(tree, pointer, file):
    for word in pointer.split("/")[1:]:
        try:
            tree = tree[int(word)] if isinstance(tree, list) else tree[word.replace("~1", "/").replace("~0", "~")]
        except (KeyError, IndexError, TypeError, ValueError):
            raise Wrong(f"{file} has no {pointer}") from None
    if not is_number(tree):
        raise Wrong(f"{file} {pointer} is no number")
    return tree


class Table:
    """A CSV file, or a list of objects of which each is a row."""

    def __init__(self, path, file):
        self.file = file
        if path.suffix == ".csv":
            self.read_csv(path)
            return
        rows = read_json(path, file)
        if not isinstance(rows, list):
            raise Wrong(f"{file} is no list: it needs a JSON pointer such as /steps")
        self.head = list(dict.fromkeys(key for row in rows for key in row))
        texts = [{key: value if isinstance(value, str) else json.dumps(value) for key, value in row.items()}
                 for row in rows]
        self.rows = [[row.get(key, "") for key in self.head] for row in texts]

    def read_csv(self, path):
        try:
            with path.open(encoding="utf-8", newline="") as stream:
                self.head, *self.rows = csv.reader(stream)
        except (OSError, ValueError):
            raise Wrong(f"cannot read {self.file}") from None
        if any(len(row) != len(self.head) for row in self.rows):
            raise Wrong(f"{self.file} has rows of other lengths than its head")

    def place(self, column):
        if column not in self.head:
            raise Wrong(f"{self.file} has no column {column}{hint(column, self.head)}")
        return self.head.index(column)

    def values(self, column):
        """Each once, in their order."""
        at = self.place(column)
        return list(dict.fromkeys(row[at] for row in self.rows))

    def row(self, words):
        """"10" is the row that starts so, "law=wong&element=hinge" the one with these fields."""
        wanted = [(0, words)]
        if "=" in words and all(row[0] != words for row in self.rows):
            parts = [part.partition("=") for part in words.split("&")]
            for column, equals, _ in parts:
                if not equals:
                    raise Wrong(f'"{column}" must be column=value')
            wanted = [(self.place(column), value) for column, _, value in parts]
        fitting = [row for row in self.rows if all(self.same(row[at], value) for at, value in wanted)]
        if len(fitting) != 1:
            raise Wrong(f"{self.file} has {'several rows' if fitting else 'no row'} {words}")
        return fitting[0]

    @staticmethod
    def same(cell, value):
        return cell == value or (number_in(cell) is not None and number_in(cell) == number_in(value))


# Numbers


class Words:
    """The words of a title, taken one after the other."""

    def __init__(self, text):
        # The apostrophe in `'the chapter's'` is followed by a letter.
        found = re.findall(r"'(.*?)'(?=\s|$)|('.*)|(\S+)", text, re.S)
        if any(unclosed for _, unclosed, _ in found):
            raise Wrong("a quote is not closed")
        self.left = [quoted or plain for quoted, _, plain in found]

    def next(self, what):
        if not self.left:
            raise Wrong(f"needs {what}")
        return self.left.pop(0)

    def ahead(self):
        return self.left[0] if self.left else ""


class Number:
    """A number, and what its errors are looked up in: other metrics of the run, other cells of the row."""

    def __init__(self, value, name="", beside=None, cell=None):
        self.value, self.name, self.beside, self.cell = value, name, beside or {}, cell


def names_a_file(word):
    return word.endswith((".csv", ".json"))


def manifest_metric(path, key, file):
    if not (path.parent / Path(file).name).exists():
        raise Wrong(f"no file {file}")
    metrics = read_json(path.parent / "manifest.json", file).get("metrics", {})
    if key not in metrics:
        raise Wrong(f"{file} has no metric {key}{hint(key, metrics)}")
    if not is_number(metrics[key]):
        raise Wrong(f"metric {key} of {file} is no number")
    return Number(metrics[key], key, {name: x for name, x in metrics.items() if is_number(x)})


def found_number(file, folder, words):
    """Takes the words of one source; the number that they lead to."""
    path = folder / file
    if words.ahead().startswith("/") and path.suffix == ".json":
        return Number(at_pointer(read_json(path, file), words.next("a JSON pointer"), file))
    if path.name in ("manifest.json", "errors.csv"):
        return manifest_metric(path, words.next("a metric"), file)
    table = Table(path, file)
    row = words.next("a row")
    while "=" in words.ahead():
        row += "&" + words.next("a column")
    column = words.next("a column")
    cells = table.row(row)
    cell = cells[table.place(column)]
    value = number_in(cell)
    beside = {name: x for name, x in zip(table.head, map(number_in, cells)) if x is not None}
    return Number(math.nan if value is None else value, column, beside, cell)


def written(value, form):
    parts = re.fullmatch(r"(,)(.*)|(\+?)(\.[0-9][fg])(.*)", form)
    if not parts:
        raise Wrong(f"format {form} must be like .1f, .2g, +.1f or , for a count")
    count, count_unit, sign, digits, unit = parts.groups()
    if value == 0:
        return "0" + (count_unit if count else unit)
    if count:
        return f"{math.floor(abs(value) + 0.5) * (1 if value > 0 else -1):,}{count_unit}"
    return re.sub(r"(e[-+])0", r"\1", format(value, sign + digits)) + unit  # 2e-07


def errors_text(number, form, factor):
    """" ± 0.1 ± 0.3 ± 0.2"."""
    one = number.name[:-5] if number.name.endswith("_mean") else number.name
    last = [number.name + "_stderr", one + "_stderr"] if one != number.name else [one + "_draw_error"]
    errors = [number.beside[name] for name in (one + "_step_error", one + "_mesh_error", *last)
              if number.name and name in number.beside]
    if not errors:
        raise Wrong(f"{number.name or 'this number'} has no errors: leave +- out")
    return "".join(" ± " + written(abs(factor) * error, form) for error in errors)


def number_from(target, title, folder):
    """Returns what the source says now.  Raises Wrong if the title is wrong or there is no such number."""
    words = Words(title)
    number, factor = found_number(target, folder, words), 1
    word = words.next("a format")
    if word == "text" and not words.left and number.cell is not None:
        return number.cell
    if number.cell == "":
        return "–"
    if word in ("minus", "over"):
        other = words.next("a file") if names_a_file(words.ahead()) else target
        second = found_number(other, folder, words).value
        if word == "over" and second == 0:
            raise Wrong("this is no finite number")
        number = Number(number.value / second if word == "over" else number.value - second)
        word = words.next("a format")
    if word == "times":
        text = words.next("a number after times")
        factor = number_in(text)
        if factor is None:
            raise Wrong(f"times {text} is no number")
        word = words.next("a format")
    if not math.isfinite(factor * number.value):
        raise Wrong("this is no finite number")
    result = written(factor * number.value, word)
    if not words.left:
        return result
    word = words.next("a format of errors")
    if not word.startswith("+-") or words.left:
        raise Wrong(f'"{word}" is one word too many')
    return result + errors_text(number, word[2:], factor)


# Links


def anchors_of(text):
    """Anchors of a page's headings, as GitHub makes them."""
    prose = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    headings = re.findall(r"^#+ +(.+?) *$", prose, re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def check_file(page, target, line):
    if target.startswith("mailto:") or "://" in target:
        return  # leads out of the checkout
    file, _, anchor = target.partition("#")
    place = page.folder / file
    if file and not place.exists():
        page.fault(line, f"no file {file}")
    elif anchor and (not file or file.endswith(".md")):
        if anchor not in anchors_of(place.read_text() if file else page.text):
            page.fault(line, f"no heading #{anchor} in {file or 'this page'}")


def definitions_in(page, prose):
    """Line and number ("" of a link to a page or a file) by label."""
    found = {}
    for match in re.finditer(r'^\[([^\]\n]+)\]: +(\S+)(?: +"([^\n]*)")?$', prose, re.M):
        label, target, title = match.groups()
        line, number = line_at(prose, match.start()), ""
        if label in found:
            page.fault(line, f"[{label}] is defined twice")
        check_file(page, target, line)
        try:
            number = number_from(target, title, page.folder) if title else ""
        except Wrong as error:
            page.fault(line, f"[{label}]: {error}")
        found[label] = line, number
    return found


def in_one_line(text):
    """A paragraph may be broken at any blank."""
    return re.sub(r"[ \n]+", " ", text)


def references_in(prose):
    """Links `[text][label]`: first and last place of the text, and the label."""
    for middle in re.finditer(r"\]\[", prose):
        depth, first, end = 1, middle.start(), prose.find("]", middle.end())
        while depth and first:
            first -= 1
            depth += (prose[first] == "]") - (prose[first] == "[")
        if not depth and end >= 0:
            yield first + 1, middle.start(), in_one_line(prose[middle.end():end])


def write_numbers(page):
    prose = without_code(page.text)
    definitions = definitions_in(page, prose)
    for match in re.finditer(r"\]\(([^)\s]+)\)", prose):
        check_file(page, match[1], line_at(prose, match.start()))
    used = set()
    for first, last, label in reversed(list(references_in(prose))):  # places stay while texts change their length
        line = line_at(prose, first)
        if label not in definitions:
            page.fault(line, f"[{label}] is not defined")
            continue
        used.add(label)
        found, number = in_one_line(page.text[first:last]), definitions[label][1]
        if number not in ("", found):
            page.fault(line, f'"{found}" must be "{number}"', True)
            page.text = page.text[:first] + number + page.text[last:]
    for label, (line, _) in sorted(definitions.items()):
        if label not in used:
            page.fault(line, f"[{label}] is defined and never used")


# Tables


def markdown(cells, is_words):
    """Columns padded to one width, so that the source reads as a table, too: words to the left, numbers right."""
    widths = [max(3, *(len(row[c]) for row in cells)) for c in range(len(cells[0]))]
    lines = [["| " + (text.ljust(width) if left else text.rjust(width)) + " "
              for text, width, left in zip(row, widths, is_words)] for row in cells]
    lines.insert(1, ["|" + "-" * (width + 1) + ("-" if left else ":") for width, left in zip(widths, is_words)])
    return "".join("".join(line) + "|\n" for line in lines)


def words_in(label):
    """Cells of words, between strokes that stand apart."""
    return [cell.strip() for cell in f" {label} ".split(" / ")]


def linked(label, file):
    return label if not label or "](" in label else f"[{label}]({file})"


def rows_in(words, file, folder):
    """Value and label of each."""
    if words.startswith("each "):
        return [(value, value) for value in Table(folder / file, file).values(words[5:])]
    rows = [row.partition(" as ") for row in words.split("; ")]
    return [(value, label or value) for value, _, label in rows]


def cell_from(source, file, prefix, value, folder):
    first, _, remainder = source.partition(" ")
    if names_a_file(first):
        file, prefix, source = first, "", remainder
    return number_from(file.replace("{}", value), f"{prefix} {source}".replace("{}", value), folder)


def table_from(words, folder):
    parts = words.replace("\n", " ").split(" | ")
    if len(parts) < 3:
        raise Wrong("a table needs a file, its rows and a column, with | between them")
    file, _, prefix = parts[0].partition(" ")
    columns = []
    for part in parts[1:]:
        head, _, source = part.partition(" = ")
        if not source:
            raise Wrong(f'"{part}" must be HEAD = what stands below it')
        columns.append((head, source))
    (head, rows), *columns = columns
    by_row, heads = "{}" in file, words_in(head)
    width = len(heads)
    if not by_row:
        heads[0] = linked(heads[0], file)
    cells = [heads + [head for head, _ in columns]]
    for value, label in rows_in(rows, file, folder):
        line = (words_in(label) + [""] * width)[:width]
        if by_row:
            line[0] = linked(line[0], file.replace("{}", value))
        for head, source in columns:
            try:
                line.append(cell_from(source, file, prefix, value, folder))
            except Wrong as error:
                raise Wrong(f"{value}, {head}: {error}") from None
        cells.append(line)
    return markdown(cells, [True] * width + [source.endswith(" text") for _, source in columns])


def write_tables(page):
    # At the start of a line: elsewhere it is quoted.
    block = re.compile(r"(?<=\n)<!-- table (.*?) -->\n(.*?)(?=<!-- /table -->)|(?<=\n)<!-- table ", re.S)
    before = page.text

    def as_it_should_be(found):
        line = line_at(before, found.start())
        try:
            if found[1] is None:
                raise Wrong("a table must end with <!-- /table --> below it")
            table = table_from(found[1], page.folder)
        except Wrong as error:
            page.fault(line, str(error))
            return found[0]
        if table != found[2]:
            page.fault(line, "this table is not what its files say", True)
        return before[found.start():found.start(2)] + table

    page.text = block.sub(as_it_should_be, before)


# These texts come from the program itself.


def exit_codes(hysteron):
    """A line for each exit code; of the last one, what each subcommand means by it."""
    def told(*arguments):
        codes = hysteron(*arguments, "--help").partition("\nExit codes:\n")[2]
        return dict(re.findall(r"^  (\d)  (.*)$", codes, re.M))

    of_program = hysteron("--help").partition("\nSubcommands\n")[2].partition("\n\n")[0]
    subcommands = re.findall(r"^  (\w+) ", of_program, re.M)
    differs = [f"`{name}`: {codes[str(DIFFERS)]}" for name in subcommands if str(DIFFERS) in (codes := told(name))]
    meanings = {**told(), str(DIFFERS): "; ".join(differs)}
    lines = "".join(f"| {code} | {meaning.replace('|', chr(92) + '|')} |\n" for code, meaning in meanings.items())
    return "\n| code | meaning |\n|---|---|\n" + lines + "\n"


def write_keys(page, hysteron):
    for name, tables in (("keys", lambda: hysteron("list", "keys")), ("exit-codes", lambda: exit_codes(hysteron))):
        begin, end = f"<!-- {name}:begin -->", f"<!-- {name}:end -->"
        before, found, after = page.text.partition(begin)
        if not found:
            continue
        line = line_at(page.text, len(before))
        now, found, after = after.partition(end)
        if not found:
            page.fault(line, f"{begin} needs {end} below it")
        elif now != (text := "\n" + tables()):
            page.fault(line, "these tables are not what --help says now", True)
            page.text = before + begin + text + end + after


# The command


def documentation(folder, hysteron):
    """The pages of the folder and the README.md beside it."""
    readme = Path(os.path.normpath(folder / ".." / "README.md"))
    for file in [readme] * readme.exists() + sorted(folder.glob("*.md")):
        page = Page(file)
        write_numbers(page)  # first, since tables may move lines
        write_tables(page)
        write_keys(page, hysteron)
        page.faults.sort(key=lambda fault: fault[0])
        yield page


def tell_or_write(page, folder, check):
    """Returns whether there are faults; those that writing the page mends are told only where it is not written."""
    told = [fault for fault in page.faults if check or not fault[2]]
    for line, what, mended in told:
        remedy = f"; write it again: tests/documentation.py {folder}" if mended else ""
        print(f"{page.file}:{line}: {what}{remedy}", file=sys.stderr)
    if len(told) < len(page.faults):
        page.file.write_text(page.text, encoding="utf-8")
        print(page.file)
    return bool(told)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--hysteron", default=Path(__file__).parent / "../build/hysteron", metavar="PROGRAM")
    parser.add_argument("folder", type=Path)
    asked = parser.parse_args()

    def hysteron(*arguments):
        wide = {**os.environ, "COLUMNS": "1000"}
        return subprocess.run([asked.hysteron, *arguments], check=True, capture_output=True, text=True, env=wide).stdout

    try:
        pages = list(documentation(asked.folder, hysteron))
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"{error}")
    faults = [tell_or_write(page, asked.folder, asked.check) for page in pages]
    return DIFFERS if any(faults) else 0


if __name__ == "__main__":
    sys.exit(main())
