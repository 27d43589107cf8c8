// SPDX-License-Identifier: BSD-3-Clause
#include <RectifiedTransport/Core/Seeds/Seeds.h>

#include <Core/Splat/Splat.h> // the old form

using RectifiedTransport::generateSeeds;
using RectifiedTransport::splatMass;
