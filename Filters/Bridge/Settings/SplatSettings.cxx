// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Settings/SplatSettings.h"

#include "Bridge/Run/PropertyCheck.h"

#include <ostream>

namespace RectifiedTransport
{

namespace
{

const char* const KernelTexts[] = { "CloudInCell", "NearestCell", "TriangularShapedCloud",
  "Gaussian" };

} // namespace

const char* SplatSettings::KernelText() const
{
  return choiceText(KernelTexts, this->Kernel);
}

SplatOptions SplatSettings::Options() const
{
  requireChoice("Kernel", this->Kernel, KernelTexts);
  requireThat(this->Radius > 0.0 && this->Radius <= SplatOptions::LargestRadius, "Radius",
    this->Radius, "above 0 and at most 10000 cells");
  SplatOptions options;
  options.Kernel = static_cast<SplatKernel>(this->Kernel);
  options.Radius = this->Radius;
  return options;
}

void SplatSettings::Print(std::ostream& os, vtkIndent indent) const
{
  os << indent << "Kernel: " << this->KernelText() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
}

} // namespace RectifiedTransport
