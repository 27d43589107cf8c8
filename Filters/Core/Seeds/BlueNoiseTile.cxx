// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seeds/BlueNoiseTile.h"

namespace RectifiedTransport
{

template <>
const std::uint16_t BlueNoiseTile<2>::Coordinates[NumberOfPoints * 2] = {
#include "Core/Seeds/BlueNoiseTile2D.inc"
};

template <>
const std::uint16_t BlueNoiseTile<3>::Coordinates[NumberOfPoints * 3] = {
#include "Core/Seeds/BlueNoiseTile3D.inc"
};

} // namespace RectifiedTransport
