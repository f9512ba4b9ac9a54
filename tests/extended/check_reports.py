#!/usr/bin/env python3
"""Checks the reports of export_reports with independent readers. Usage: check_reports.py EXPORT_REPORTS SCHEMA"""

import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema
import junitparser


def check_json(path, schema):
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    records = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    for record in records:
        validator.validate(record)
    broken = dict(records[0], outcome="lost")
    assert list(validator.iter_errors(broken)), "the schema refuses nothing"
    return f"{len(records)} records valid"


def check_junit(path):
    suites = junitparser.JUnitXml.fromfile(str(path))
    cases = [case for suite in suites for case in suite]
    kinds = [type(result).__name__ for case in cases for result in case.result]
    assert (suites.tests, suites.errors, suites.failures) == (3, 1, 0)
    assert kinds == ["Error", "Skipped"], kinds
    return f"{len(cases)} cases"


def check_gha(path):
    """As the action's own schema has it: name, unit, value, optional range and extra, texts but for the value."""
    entry = {"type": "object", "required": ["name", "unit", "value"], "additionalProperties": False,
             "properties": {"name": {"type": "string"}, "unit": {"type": "string"}, "value": {"type": "number"},
                            "range": {"type": "string"}, "extra": {"type": "string"}}}
    entries = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.validate(entries, {"type": "array", "items": entry, "minItems": 1})
    return f"{len(entries)} entries"


def check_gbench(path):
    """The fields that compare.py and github-action-benchmark use."""
    doc = json.loads(path.read_text(encoding="utf-8"))
    for entry in doc["benchmarks"]:
        assert entry["run_type"] == "iteration" and entry["time_unit"] == "ms"
        assert entry["repetition_index"] < entry["repetitions"]
        assert entry["real_time"] >= 0 and entry["cpu_time"] >= 0
    return f"{len(doc['benchmarks'])} runs"


def check_trace(path):
    events = json.loads(path.read_text(encoding="utf-8"))["traceEvents"]
    rows = {}
    for event in events:
        assert {"name", "ph", "pid"} <= event.keys()
        if event["ph"] == "X":
            rows.setdefault(event["tid"], []).append((event["ts"], event["ts"] + event["dur"]))
    for spans in rows.values():  # complete events of a row must nest
        stack = []
        for start, end in sorted(spans, key=lambda s: (s[0], -s[1])):
            while stack and stack[-1] <= start:
                stack.pop()
            assert not stack or end <= stack[-1], "events overlap"
            stack.append(end)
    return f"{len(events)} events"


def main(program, schema_path):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([program, folder], check=True)
        schema = json.loads(pathlib.Path(schema_path).read_text(encoding="utf-8"))
        print("json:", check_json(folder / "json", schema))
        print("junit:", check_junit(folder / "junit"))
        print("gha:", check_gha(folder / "gha"))
        print("gbench:", check_gbench(folder / "gbench"))
        print("trace:", check_trace(folder / "trace"))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
