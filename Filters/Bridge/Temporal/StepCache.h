// SPDX-License-Identifier: BSD-3-Clause
// The data of the last steps of a series that a filter has received, and their densities.
#ifndef RectifiedTransport_StepCache_h
#define RectifiedTransport_StepCache_h

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Store/Store.h"
#include "Core/Series/SeriesParticles.h"

#include "vtkDoubleArray.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The density of a step, read once.
struct StepDensity
{
  std::string ArrayName;
  ImageGrid Grid;
  DataIdentity Identity;
  // Each rank has the values of all cells, axis 0 of index space fastest.
  vtkSmartPointer<vtkDoubleArray> Values;
  double Mass = 0.0; // density times cell measure, summed; may be 0

  SeriesStep Step() const { return { this->Grid, this->Values->GetPointer(0), this->Mass }; }
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

struct CachedStep
{
  bool IsCached = false;
  double Time = 0.0;
  vtkSmartPointer<vtkDataObject> Data; // may be nullptr
  StoreSlot Density;                   // a StepDensity
  std::uint64_t Used = 0;
};

// Two intervals have three steps.
class StepCache
{
public:
  static constexpr int Most = 3;

  // Forgets the data if anything before the filter has changed since the last call; not their
  // densities, which are compared by content. Returns whether it has.
  bool RemoveOutdated(vtkAlgorithm* filter);
  // What changes within an execution is due to the requests of this one.
  void Stamp(vtkAlgorithm* filter);

  // Keeps a shallow copy in place of what was used least lately.
  void Insert(double time, vtkDataObject* data);
  bool Has(double time) const { return this->Find(time) >= 0; }
  // The number of the place of a step that is kept; it counts as used.
  int Use(double time);
  CachedStep& operator[](int place) { return this->Steps[static_cast<std::size_t>(place)]; }

private:
  int Find(double time) const;

  std::array<CachedStep, Most> Steps;
  std::uint64_t Clock = 0;
  vtkMTimeType Changed = 0;
};

} // namespace RectifiedTransport::Bridge

#endif
