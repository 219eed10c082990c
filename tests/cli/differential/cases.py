# SPDX-License-Identifier: BSD-3-Clause
"""All differential cases."""

import importlib

FAMILIES = ("arithmetic", "channels", "color", "drawing", "errors", "files", "geometry",
            "language", "printing", "surface")
CASES = [case for family in FAMILIES
         for case in importlib.import_module(f"cases_{family}").CASES]
