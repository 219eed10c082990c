#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the pages of src/doc/reference: make_reference.py TONETOOL [FOLDER]

commands.md of --help=json, curves.md of --tonecurves, and check-json.md of the schema of --json."""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "src" / "doc" / "reference"
SCHEMA = ROOT / "src" / "sequence" / "check.schema.json"
MADE = "*This page is made by* `src/scripts/make_reference.py`; *changes to it are lost.*\n"
COMPARING = "Comparing a test image with a reference"


def output(program, *words):
    return subprocess.run([program, *words], capture_output=True, text=True, check=True).stdout


def cell(text):
    """Text as it is, in a table."""
    return re.sub(r"([|<>*_\[\]])", r"\\\1", text)


def code(text):
    return "`" + text.replace("|", "\\|") + "`"


def anchor(title):
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def images(count):
    return "as many as are asked for" if count < 0 else str(count)


def one_command(command):
    """The section of a command."""
    names = [f"--{name}" for name in command["names"]]
    lines = [f"### {names[0]}", "", code(" ".join([names[0], *command["args"]]))]
    if names[1:]:
        lines[-1] += ", or " + ", ".join(code(name) for name in names[1:])
    lines[-1] += f": {cell(command['help'])}."
    if command["pops"] or command["pushes"]:
        lines[-1] += (f" Takes images: {images(command['pops'])}; leaves images:"
                      f" {images(command['pushes'])}.")
    lines.append("")
    if command["modifiers"]:
        lines += ["| modifier | meaning |", "|---|---|"]
        lines += [f"| {code(one['key'] + '=' + one['hint'])} | {cell(one['help'])} |"
                  for one in command["modifiers"]]
        lines.append("")
    return lines


def commands(program):
    """All commands by their groups; tonetool's own comparisons come first."""
    groups = {COMPARING: []}
    for command in json.loads(output(program, "--help=json")):
        groups.setdefault(command["group"], []).append(command)
    lines = ["# All commands", "", MADE,
             "Modifiers follow a command's name after colons, `--hdrflip:fail=0.3:layer=beauty`; what",
             "stands in brackets at the end of a meaning is the default. A command takes images from the",
             "top of the stack and leaves its results there, see [The command line](../command-line.md).",
             "`tonetool --help COMMAND` prints the same.", ""]
    lines += [f"* [{group}](#{anchor(group)}): "
              + ", ".join(f"[{one['names'][0]}](#--{one['names'][0]})" for one in found)
              for group, found in groups.items()]
    for group, found in groups.items():
        lines += ["", f"## {group}", ""]
        for command in found:
            lines += one_command(command)
        lines.pop()
    return "\n".join(lines) + "\n"


def curves(program):
    """The tone curves, their formulas and sources."""
    lines = ["# Tone curves", "", MADE,
             "`x` is scene light (1: white at exposure 0), `y` linear light of the display, 0 to 1. `on rgb`:",
             "each channel by itself; `on luminance`: the colour is scaled as its luminance is. Numbers after",
             "a parameter are its default and its range. A curve with `coeffs` is a rational one,",
             "(k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5). `tonetool --tonecurves` prints the same."]
    for line in output(program, "--tonecurves").splitlines():
        if line.startswith(" "):
            lines.append(line)
        elif line.strip():
            name, _, rest = line.partition(": ")
            lines += ["", f"## {name}", "", rest, ""]
    return "\n".join(lines) + "\n"


def type_of(schema):
    """What kind of value a field has, in words."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        return f"[{name}](#{anchor(name)})"
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    if schema.get("type") == "array":
        return "list of " + type_of(schema.get("items", {}))
    if "oneOf" in schema:
        return " or ".join(type_of(one) for one in schema["oneOf"])
    return schema.get("type", "anything")


def fields(schema, prefix=""):
    """Rows of a table: fields and the fields in them."""
    for name, field in schema.get("properties", {}).items():
        optional = "" if name in schema.get("required", []) else "optional"
        yield f"| `{prefix}{name}` | {type_of(field)} | {optional} | {cell(field.get('description', ''))} |"
        inner = field.get("items", field)
        if "properties" in inner:
            yield from fields(inner, f"{prefix}{name}{'[]' if 'items' in field else ''}.")


def results():
    """The JSON of a check."""
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    lines = ["# The JSON of a check", "", MADE, f"{schema['title']}. {schema['description']}",
             "The schema is `src/sequence/check.schema.json`; how to get the file is in",
             "[Check a sequence](../check.md)."]
    head = ["| field | value | | meaning |", "|---|---|---|---|"]
    lines += ["", *head, *fields(schema)]
    for name, definition in schema["definitions"].items():
        lines += ["", f"## {name}", ""]
        if "properties" in definition:
            lines += [*head, *fields(definition)]
        else:
            about = definition.get("description", "")
            lines.append(type_of(definition) + (f" ({about})" if about else ""))
    return "\n".join(lines) + "\n"


def pages(program):
    """The text of each page by its name."""
    return {"commands.md": commands(program), "curves.md": curves(program), "check-json.md": results()}


def main(program, folder):
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name, text in pages(program).items():
        (Path(folder) / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2] if len(sys.argv) == 3 else FOLDER)
