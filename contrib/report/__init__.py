# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report of a run, for keyblock-report."""
