// SPDX-License-Identifier: BSD-3-Clause
// The values of a density in a larger grid, whose other cells are empty.
#ifndef RectifiedTransport_PaddedValues_h
#define RectifiedTransport_PaddedValues_h

#include "Core/Geometry/LatticePart.h"
#include "Core/Tables/Density.h"

#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

class PaddedValues final : public DensityValues
{
public:
  // `inner` has cells of `box`, by their numbers in it; `grown` are the cells of the larger grid.
  // `empty` is the density of those around the box.
  PaddedValues(std::shared_ptr<const DensityValues> inner, const LatticePart<3>& box,
    const GridSize<3>& padded, double empty);

  void Read(std::int64_t first, std::int64_t count, double* values) const override;

private:
  const std::shared_ptr<const DensityValues> Inner;
  const LatticePart<3> Box;
  const LatticePart<3> Whole;
  const double Empty;
};

} // namespace RectifiedTransport

#endif
