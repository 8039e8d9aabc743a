# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m meshoptimize optimize IN OUT, python3 -m meshoptimize quality IN"""
import sys

from ._command import main

sys.exit(main())
