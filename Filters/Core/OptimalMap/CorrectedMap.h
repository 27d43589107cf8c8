// SPDX-License-Identifier: BSD-3-Clause
// A map at points whose masses are corrected in the target.
#ifndef RectifiedTransport_CorrectedMap_h
#define RectifiedTransport_CorrectedMap_h

#include "Core/OptimalMap/Masses/MassCorrection.h"
#include "Core/OptimalMap/PointMap.h"

#include <optional>

namespace RectifiedTransport
{

class Progress;

template <int Dimension>
class CorrectedMap
{
public:
  // From one side of a solver to the other, as of PointMap. Throws std::bad_alloc and Cancelled.
  CorrectedMap(const PotentialSolver<Dimension>& solver, int from,
    const CellDensity<Dimension>& target, const Point<Dimension>& sides, PointImages images,
    Progress& progress);

  // From the index space of the one density to that of the other.
  Point<Dimension> At(const double* point) const
  {
    Point<Dimension> image = this->Map.At(point);
    this->Correction->Move(image.data());
    return image;
  }
  // What At corrects is undone, near enough: the image as of PointMap, wherever there is mass.
  Point<Dimension> Uncorrected(const double* image) const
  {
    auto before = pointAt<Dimension>(image);
    this->Correction->Undo(before.data());
    return before;
  }
  // The relative L2 error of the masses of blocks of 8^d of the target's cells.
  double MassError() const { return this->Error; }

private:
  void MeasureBlocks(const CellDensity<Dimension>& target, ConstPointSpan<Dimension> images,
    const double* masses, Progress& progress);

  PointMap<Dimension> Map;
  std::optional<MassCorrection<Dimension>> Correction;
  double Error = 0.0;
};

} // namespace RectifiedTransport

#endif
