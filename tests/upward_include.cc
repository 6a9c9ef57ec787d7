// SPDX-License-Identifier: LGPL-2.1-or-later
// Compiled as a part of the room `contact`, this has to fail.
#include <keyblock/step/step.h>
