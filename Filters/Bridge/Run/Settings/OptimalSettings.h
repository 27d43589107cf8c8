// SPDX-License-Identifier: BSD-3-Clause
// The properties Method, OptimalityTolerance and Certify.
#ifndef RectifiedTransport_OptimalSettings_h
#define RectifiedTransport_OptimalSettings_h

#include "Core/Messages/PropertyCheck.h"

#include "vtkIndent.h"

#include <ostream>

namespace RectifiedTransport::Bridge
{

// Indexed by vtkTransportAlgorithm::MethodType.
constexpr const char* MethodTexts[] = { "RectifiedFlow", "Optimal" };

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

// Reads the settings of a filter that has these properties. Throws Failure for values out of range.
template <class Filter>
OptimalSetting optimalSettingOf(Filter& filter)
{
  requireChoice("Method", filter.GetMethod(), MethodTexts);
  const double tolerance = filter.GetOptimalityTolerance();
  requireThat(
    tolerance > 0.0 && tolerance < 1.0, "OptimalityTolerance", tolerance, "above 0 and below 1");
  OptimalSetting setting;
  setting.IsOptimal = filter.GetMethod() == Filter::OPTIMAL;
  setting.Tolerance = tolerance;
  setting.Certifies = filter.GetCertify() != 0;
  return setting;
}

template <class Filter>
void printOptimalSetting(Filter& filter, std::ostream& os, vtkIndent indent)
{
  os << indent << "Method: " << filter.GetMethodAsString() << "\n";
  os << indent << "OptimalityTolerance: " << filter.GetOptimalityTolerance() << "\n";
  os << indent << "Certify: " << (filter.GetCertify() ? "On" : "Off") << "\n";
}

} // namespace RectifiedTransport::Bridge

#endif
