#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one test as ctest does, with the same interpreter and environment, and gives it arguments.

usage: python3 Testing/Python/run.py [--build FOLDER] TestDigests [--record]
"""
import argparse
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default=os.path.join(HERE, "..", "..", "build"),
                        help="the folder of the build (default: build)")
    parser.add_argument("test", help="the name of the test, without python.")
    parser.add_argument("arguments", nargs=argparse.REMAINDER, help="what the test gets")
    options = parser.parse_args()
    listed = subprocess.run(["ctest", "--test-dir", options.build, "--show-only=json-v1",
                             "-R", "^python[.]%s$" % options.test],
                            stdout=subprocess.PIPE, text=True, check=True)
    tests = json.loads(listed.stdout)["tests"]
    if not tests:
        sys.exit("%s has no test python.%s" % (options.build, options.test))
    properties = {entry["name"]: entry["value"] for entry in tests[0]["properties"]}
    environment = dict(os.environ)
    environment.update(entry.split("=", 1) for entry in properties["ENVIRONMENT"])
    for entry in properties["ENVIRONMENT_MODIFICATION"]:
        name, _, folder = entry.partition("=path_list_prepend:")
        before = environment.get(name)
        environment[name] = folder + os.pathsep + before if before else folder
    command = tests[0]["command"] + options.arguments
    os.execvpe(command[0], command, environment)


if __name__ == "__main__":
    main()
