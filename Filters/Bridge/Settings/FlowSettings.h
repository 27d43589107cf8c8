// SPDX-License-Identifier: BSD-3-Clause
// The properties of the integration of the flow.
#ifndef RectifiedTransport_FlowSettings_h
#define RectifiedTransport_FlowSettings_h

#include "Bridge/Run/PropertyCheck.h"
#include "Core/Flow/FlowOptions.h"

#include "vtkIndent.h"

#include <cmath>
#include <ostream>

namespace RectifiedTransport
{

// By the enumerations of vtkTransportAlgorithm.
constexpr const char* IntegratorTexts[] = { "Multistep", "RungeKutta4", "Euler", "Adaptive" };
constexpr const char* TableLookupTexts[] = { "Interpolated", "Nearest" };
constexpr const char* FlowMapsTexts[] = { "Auto", "On", "Off" };

struct FlowSettings
{
  int Integrator;
  int NumberOfSteps;
  double Tolerance;
  int TableLookup;
  int FlowMaps;

  // Throws Failure for values out of range.
  FlowOptions Options() const
  {
    constexpr int most = FlowOptions::MaximumNumberOfSteps;
    requireChoice("Integrator", this->Integrator, IntegratorTexts);
    requireThat(this->NumberOfSteps >= 1 && this->NumberOfSteps <= most, "NumberOfSteps",
      this->NumberOfSteps, "from 1 to 10000");
    requireThat(this->Tolerance > 0.0 && std::isfinite(this->Tolerance), "Tolerance",
      this->Tolerance, "a positive number of cells");
    requireChoice("TableLookup", this->TableLookup, TableLookupTexts);
    requireChoice("FlowMaps", this->FlowMaps, FlowMapsTexts);
    FlowOptions options;
    options.Method = static_cast<RectifiedTransport::Integrator>(this->Integrator);
    options.NumberOfSteps = this->NumberOfSteps;
    options.Tolerance = this->Tolerance;
    options.Lookup = static_cast<RectifiedTransport::TableLookup>(this->TableLookup);
    options.Maps = static_cast<RectifiedTransport::FlowMaps>(this->FlowMaps);
    return options;
  }

  void Print(std::ostream& os, vtkIndent indent) const
  {
    os << indent << "Integrator: " << choiceText(IntegratorTexts, this->Integrator) << "\n";
    os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
    os << indent << "Tolerance: " << this->Tolerance << "\n";
    os << indent << "TableLookup: " << choiceText(TableLookupTexts, this->TableLookup) << "\n";
    os << indent << "FlowMaps: " << choiceText(FlowMapsTexts, this->FlowMaps) << "\n";
  }
};

// The properties of a filter that has them all.
template <class Filter>
FlowSettings flowSettingsOf(Filter& filter)
{
  FlowSettings settings{};
  settings.Integrator = filter.GetIntegrator();
  settings.NumberOfSteps = filter.GetNumberOfSteps();
  settings.Tolerance = filter.GetTolerance();
  settings.TableLookup = filter.GetTableLookup();
  settings.FlowMaps = filter.GetFlowMaps();
  return settings;
}

} // namespace RectifiedTransport

#endif
