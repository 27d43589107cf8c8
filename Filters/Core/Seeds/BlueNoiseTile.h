// SPDX-License-Identifier: BSD-3-Clause
// The toroidal blue-noise point sets that BlueNoise.cxx repeats periodically. The generator and the
// method are in Testing/Generators/GenerateBlueNoiseTile.cxx.
#ifndef RectifiedTransport_BlueNoiseTile_h
#define RectifiedTransport_BlueNoiseTile_h

#include <cstdint>

namespace RectifiedTransport
{

// Interleaved coordinates in units of 1/65536 of the tile's side. Points are in Morton order, axis
// 0 in the lowest bit: the points of a dyadic cube of the tile are contiguous.
template <int Dimension>
struct BlueNoiseTile
{
  static constexpr int NumberOfPoints = 4096;
  static const std::uint16_t Coordinates[NumberOfPoints * Dimension];
};

template <>
const std::uint16_t BlueNoiseTile<2>::Coordinates[NumberOfPoints * 2];
template <>
const std::uint16_t BlueNoiseTile<3>::Coordinates[NumberOfPoints * 3];

} // namespace RectifiedTransport

#endif
