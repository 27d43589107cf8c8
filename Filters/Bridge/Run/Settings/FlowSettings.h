// SPDX-License-Identifier: BSD-3-Clause
// The properties of the integration of the flow.
#ifndef RectifiedTransport_FlowSettings_h
#define RectifiedTransport_FlowSettings_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Messages/PropertyCheck.h"

#include "vtkIndent.h"

#include <cmath>
#include <ostream>

namespace RectifiedTransport::Bridge
{

// Indexed by the enumerations of vtkTransportEnumerations.
constexpr const char* IntegratorTexts[] = { "Multistep", "RungeKutta4", "Euler", "Adaptive" };
constexpr const char* TableLookupTexts[] = { "Interpolated", "Nearest" };
constexpr const char* FlowMapsTexts[] = { "Auto", "On", "Off" };

// The options of a filter that has these properties. Throws Failure for values out of range.
template <class Filter>
FlowOptions flowOptionsOf(Filter& filter)
{
  constexpr int most = FlowOptions::MaximumNumberOfSteps;
  requireChoice("Integrator", filter.GetIntegrator(), IntegratorTexts);
  requireThat(filter.GetNumberOfSteps() >= 0 && filter.GetNumberOfSteps() <= most, "NumberOfSteps",
    filter.GetNumberOfSteps(), "from 1 to 10000, or 0 (as many as AreaTolerance asks)");
  requireThat(filter.GetAreaTolerance() > 0.0 && filter.GetAreaTolerance() <= 1.0, "AreaTolerance",
    filter.GetAreaTolerance(), "above 0 and at most 1");
  requireThat(filter.GetTolerance() > 0.0 && std::isfinite(filter.GetTolerance()), "Tolerance",
    filter.GetTolerance(), "a positive number of cells");
  requireChoice("TableLookup", filter.GetTableLookup(), TableLookupTexts);
  requireChoice("FlowMaps", filter.GetFlowMaps(), FlowMapsTexts);
  FlowOptions options;
  options.Integrator = static_cast<Integrator>(filter.GetIntegrator());
  options.NumberOfSteps = filter.GetNumberOfSteps();
  options.AreaTolerance = filter.GetAreaTolerance();
  options.Tolerance = filter.GetTolerance();
  options.Lookup = static_cast<TableLookup>(filter.GetTableLookup());
  options.Maps = static_cast<FlowMaps>(filter.GetFlowMaps());
  return options;
}

template <class Filter>
void printFlowOptions(Filter& filter, std::ostream& os, vtkIndent indent)
{
  os << indent << "Integrator: " << filter.GetIntegratorAsString() << "\n";
  os << indent << "NumberOfSteps: " << filter.GetNumberOfSteps() << "\n";
  os << indent << "AreaTolerance: " << filter.GetAreaTolerance() << "\n";
  os << indent << "Tolerance: " << filter.GetTolerance() << "\n";
  os << indent << "TableLookup: " << filter.GetTableLookupAsString() << "\n";
  os << indent << "FlowMaps: " << filter.GetFlowMapsAsString() << "\n";
}

} // namespace RectifiedTransport::Bridge

#endif
