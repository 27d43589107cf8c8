// SPDX-License-Identifier: BSD-3-Clause
// The properties that say what moves points: Method, OptimalityTolerance, Certify, Tables and the
// flow's.
#ifndef RectifiedTransport_TransportSettings_h
#define RectifiedTransport_TransportSettings_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/TableChoice.h"
#include "Core/Messages/PropertyCheck.h"

namespace RectifiedTransport::Bridge
{

// Indexed by enumerations of vtkTransportEnumerations.
constexpr const char* MethodTexts[] = { "RectifiedFlow", "Optimal" };
constexpr const char* TablesTexts[] = { "Auto", "Whole", "Tiled" };

// Throws Failure for a value out of range.
inline TableSetting tableSetting(int tables)
{
  requireChoice("Tables", tables, TablesTexts);
  return static_cast<TableSetting>(tables);
}

struct OptimalSetting
{
  bool IsOptimal = false; // points are moved by the optimal map, else by the flow
  double Tolerance = 1e-3;
  bool Certifies = false; // with the flow: there is a bound of its cost

  bool operator==(const OptimalSetting& other) const
  {
    return this->IsOptimal == other.IsOptimal && this->Tolerance == other.Tolerance &&
      this->Certifies == other.Certifies;
  }
  bool NeedsMap() const { return this->IsOptimal || this->Certifies; }
  // How to do without, for errors of memory.
  const char* Advice() const
  {
    return this->IsOptimal ? "Method RectifiedFlow needs none" : "Certify Off needs none";
  }
  // What only whole tables give, for TableUse; empty for nothing.
  const char* WholeFor() const
  {
    return this->IsOptimal ? "the optimal map (Method Optimal)"
      : this->Certifies    ? "a bound of the cost (Certify)"
                           : "";
  }
};

// All of them, as a vtkTransportAlgorithm has them.
struct TransportSettings
{
  FlowOptions Flow;
  TableSetting Tables = TableSetting::Auto;
  OptimalSetting Optimal;
};

} // namespace RectifiedTransport::Bridge

#endif
