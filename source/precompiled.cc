// SPDX-License-Identifier: LGPL-2.1-or-later
// Nothing: a unit with which the headers are read that all others share
// (CMakeLists.txt).
