// SPDX-License-Identifier: BSD-3-Clause
// Divides a domain among sites into cells of equal mass: the worker of vtkEqualMassCells.
#ifndef RectifiedTransport_EqualMassCells_h
#define RectifiedTransport_EqualMassCells_h

#include "Bridge/Plan/FlowCache.h"
#include "Bridge/SiteCells/CellOutputs.h"

#include <functional>
#include <string>

namespace RectifiedTransport::Bridge
{

// The members are the properties of that class.
struct EqualMassCells
{
  FlowOptions Flow;
  CostNorm Norm;
  int Resolution;
  bool IsPower = false; // Shape
  std::function<void(const std::string&)> Warn;

  // What warnings count.
  struct Report
  {
    std::int64_t Outside = 0;     // sites outside the domain
    std::int64_t WithoutMass = 0; // sites whose cells have no mass
    FlowReport Flow;              // what Shape Flow reports
  };

  // Assigns the pixels of a domain with points to at least one site; if the domain is nullptr, the
  // pixels around the sites. Sites get equally many pixels or, if the density is not nullptr, equal
  // masses of it. Reuses the kept labels if they are valid. Throws Failure, std::invalid_argument,
  // std::runtime_error, std::bad_alloc and Cancelled.
  Report Run(vtkPointSet* sites, vtkDataObject* domain, StoreSlot& kept, Progress& progress,
    const CellOutputs& outputs) const;
  Report Run(vtkPointSet* sites, InputDensity& density, FlowCache& cache, StoreSlot& kept,
    Progress& progress, const CellOutputs& outputs) const;
};

} // namespace RectifiedTransport::Bridge

#endif
