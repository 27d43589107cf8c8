#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The bits of every filter whose flow an OpenCL device computes are those of the processor."""
import sys

import TestDigests

if __name__ == "__main__":
    sys.argv.append("--device")
    sys.exit(TestDigests.main())
