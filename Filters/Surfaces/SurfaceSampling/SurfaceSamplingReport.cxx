// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceSampling/SurfaceSamplingReport.h"

#include "Core/Messages/PartText.h"
#include "Surfaces/Parameterization/ParameterizationReport.h"
#include "Surfaces/SurfaceSampling/SurfaceSamples.h"

#include <sstream>

namespace RectifiedTransport
{

std::vector<std::string> SurfaceSamplingReport::Warnings() const
{
  std::vector<std::string> warnings;
  if (!this->Repair.empty())
  {
    warnings.push_back(this->Repair);
  }
  if (isWorthWarning(this->Moved, this->Particles))
  {
    warnings.push_back(std::to_string(this->Moved) + " of " + std::to_string(this->Particles) +
      " particles in empty cells moved to the nearest cell with mass (more NumberOfSteps may spare "
      "them that)");
  }
  if (!this->Steps.empty())
  {
    warnings.push_back(this->Steps);
  }
  if (this->IsAreaPreserving)
  {
    std::ostringstream text;
    text.precision(2);
    text
      << "The conformal map squeezes much of the surface into few cells: the particles come from "
         "the area-preserving map instead, which shears their pattern (a longer boundary helps)";
    if (this->PatchError > SurfaceSamples::AcceptableError)
    {
      text << "; their numbers in patches of the surface are still wrong by "
           << 100.0 * this->PatchError << " %";
    }
    warnings.push_back(text.str());
  }
  if (this->Collapsed > 0)
  {
    warnings.push_back(collapsedWarning(this->Collapsed, this->Triangles));
  }
  return warnings;
}

} // namespace RectifiedTransport
