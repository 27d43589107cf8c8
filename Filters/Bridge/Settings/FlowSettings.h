// SPDX-License-Identifier: BSD-3-Clause
// How a filter integrates the flow, as its properties say it: checked, named and printed.
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

  const char* IntegratorText() const;
  const char* TableLookupText() const;
  void Print(std::ostream& os, vtkIndent indent) const;

  // Throws Failure for what is out of range.
  FlowOptions Options() const;
};

} // namespace RectifiedTransport

// What a class needs that has vtkFlowPropertiesMacro.
#define vtkImplementFlowPropertiesMacro(Class)                                                     \
  RectifiedTransport::FlowSettings Class::GetFlowSettings()                                        \
  {                                                                                                \
    return { this->Integrator, this->NumberOfSteps, this->Tolerance, this->TableLookup };          \
  }                                                                                                \
  const char* Class::GetIntegratorAsString()                                                       \
  {                                                                                                \
    return this->GetFlowSettings().IntegratorText();                                               \
  }                                                                                                \
  const char* Class::GetTableLookupAsString()                                                      \
  {                                                                                                \
    return this->GetFlowSettings().TableLookupText();                                              \
  }

#endif
