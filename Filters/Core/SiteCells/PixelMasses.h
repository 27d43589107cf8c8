// SPDX-License-Identifier: BSD-3-Clause
// The masses of a density in the pixels of a grid on its domain, as integers: their sums are exact
// in any order.
#ifndef RectifiedTransport_PixelMasses_h
#define RectifiedTransport_PixelMasses_h

#include "../Parallel/LargeBuffer.h"
#include "../Tables/Density.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Pixels need not be cells of the density: the mass of a pixel is the integral of the density over
// it. Masses are in units of 2^-58 of the whole mass, rounded to the nearest.
template <int Dimension>
class PixelMasses
{
public:
  // `total` is the sum of the density's values, which must be valid. O(pixels + cells). Takes 8
  // bytes a pixel. Throws std::bad_alloc and Cancelled.
  PixelMasses(const DensitySource<Dimension>& density, double total,
    const GridSize<Dimension>& pixels, Progress& progress);

  const GridSize<Dimension>& Size() const { return this->Pixels; }
  std::int64_t NumberOfPixels() const { return this->Units.size(); }
  std::int64_t operator[](std::int64_t pixel) const { return this->Units.data()[pixel]; }
  std::int64_t Total() const { return this->Found.Total; } // about 2^58
  std::int64_t Heaviest() const { return this->Found.Heaviest; }
  std::int64_t PixelsWithMass() const { return this->Found.WithMass; }
  // Writes -1 for the pixels without mass. Throws Cancelled.
  void RemoveEmptyPixels(std::int64_t* labels, Progress& progress) const;

private:
  struct Summary
  {
    std::int64_t Total = 0;
    std::int64_t Heaviest = 0;
    std::int64_t WithMass = 0;
  };

  GridSize<Dimension> Pixels;
  LargeBuffer<std::int64_t> Units;
  Summary Found;
};

} // namespace RectifiedTransport

#endif
