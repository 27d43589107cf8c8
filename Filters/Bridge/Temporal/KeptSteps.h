// SPDX-License-Identifier: BSD-3-Clause
// The data of the last steps of a series that a filter has received.
#ifndef RectifiedTransport_KeptSteps_h
#define RectifiedTransport_KeptSteps_h

#include "Bridge/Temporal/StepDensity.h"
#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDataObject;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct KeptStep
{
  bool IsKept = false;
  double Time = 0.0;
  vtkSmartPointer<vtkDataObject> Data; // may be nullptr
  StoreSlot Density;                   // a StepDensity
  std::uint64_t Used = 0;
};

// Two intervals have three steps.
class KeptSteps
{
public:
  static constexpr int Most = 3;

  // Forgets the data if anything before the filter has changed since the last call; not their
  // densities, which are compared by content. Returns whether it has.
  bool ForgetOutdated(vtkAlgorithm* filter);
  // What changes within an execution is due to the requests of this one.
  void Stamp(vtkAlgorithm* filter);

  // Keeps a shallow copy in place of what was used least lately.
  void Keep(double time, vtkDataObject* data);
  bool Has(double time) const { return this->Find(time) >= 0; }
  // The number of the place of a step that is kept; it counts as used.
  int Use(double time);
  KeptStep& operator[](int place) { return this->Steps[static_cast<std::size_t>(place)]; }

private:
  int Find(double time) const;

  std::array<KeptStep, Most> Steps;
  std::uint64_t Clock = 0;
  vtkMTimeType Changed = 0;
};

} // namespace RectifiedTransport::Bridge

#endif
