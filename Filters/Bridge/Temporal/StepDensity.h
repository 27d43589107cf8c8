// SPDX-License-Identifier: BSD-3-Clause
// The density of one step of a series, read once.
#ifndef RectifiedTransport_StepDensity_h
#define RectifiedTransport_StepDensity_h

#include "Bridge/Store/Store.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Tables/Density.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;

struct StepDensity
{
  std::string ArrayName;
  ImageGrid Grid;
  DataIdentity Identity;
  // Of all cells, axis 0 of index space fastest; on each rank.
  vtkSmartPointer<vtkDoubleArray> Values;
  double Mass = 0.0; // density times cell measure, summed; may be 0

  template <int D>
  DensityArray<D, double> Density() const
  {
    return { this->Values->GetPointer(0), this->Grid.Size<D>() };
  }
  // Whether a map to or from the other density serves this one.
  bool IsSameAs(const StepDensity& other) const
  {
    return this->Identity.IsByContent(other.Identity);
  }
};

// Returns what is kept, if it is of the same density; else reads it. Collective. Throws Failure for
// values that are no density, and Cancelled.
std::shared_ptr<const StepDensity> readStepDensity(
  InputDensity& density, StoreSlot& kept, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
