// SPDX-License-Identifier: BSD-3-Clause
// The properties of the integration of the flow, checked, as text and printed.
#ifndef RectifiedTransport_FlowSettings_h
#define RectifiedTransport_FlowSettings_h

#include "Core/Flow/FlowOptions.h"

#include "vtkIndent.h"

#include <iosfwd>

namespace RectifiedTransport
{

// The values are those of vtkFlowPropertiesMacro.
struct FlowSettings
{
  int Integrator;
  int NumberOfSteps;
  double Tolerance;
  int TableLookup;
  int FlowMaps;

  const char* IntegratorText() const;
  const char* TableLookupText() const;
  const char* FlowMapsText() const;
  void Print(std::ostream& os, vtkIndent indent) const;

  // Throws Failure for values out of range.
  FlowOptions Options() const;
};

} // namespace RectifiedTransport

// For the source file of a class that has vtkFlowPropertiesMacro.
#define vtkImplementFlowPropertiesMacro(Class)                                                     \
  RectifiedTransport::FlowSettings Class::GetFlowSettings()                                        \
  {                                                                                                \
    return { this->Integrator, this->NumberOfSteps, this->Tolerance, this->TableLookup,            \
      this->FlowMaps };                                                                            \
  }                                                                                                \
  const char* Class::GetIntegratorAsString()                                                       \
  {                                                                                                \
    return this->GetFlowSettings().IntegratorText();                                               \
  }                                                                                                \
  const char* Class::GetTableLookupAsString()                                                      \
  {                                                                                                \
    return this->GetFlowSettings().TableLookupText();                                              \
  }                                                                                                \
  const char* Class::GetFlowMapsAsString()                                                         \
  {                                                                                                \
    return this->GetFlowSettings().FlowMapsText();                                                 \
  }

#endif
