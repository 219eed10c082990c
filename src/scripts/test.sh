#!/usr/bin/env bash
# Builds what is not built yet and runs every test; ctest has the last word.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
bash src/scripts/setup.sh src/scripts/packages-browser.txt
exec ctest --preset release --parallel "$(nproc)"
