// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Splat/SplatSettings.h"

#include "Bridge/Run/PropertyCheck.h"

#include <ostream>

namespace RectifiedTransport
{

namespace
{

const char* const KernelTexts[] = { "CloudInCell", "NearestCell", "TriangularShapedCloud",
  "Gaussian" };
const char* const BoundaryTexts[] = { "Renormalize", "Drop" };

} // namespace

const char* SplatSettings::KernelText() const
{
  return choiceText(KernelTexts, this->Kernel);
}

const char* SplatSettings::BoundaryText() const
{
  return choiceText(BoundaryTexts, this->Boundary);
}

SplatOptions SplatSettings::Options() const
{
  requireChoice("Kernel", this->Kernel, KernelTexts);
  requireThat(this->Radius > 0.0 && this->Radius <= SplatOptions::LargestRadius, "Radius",
    this->Radius, "above 0 and at most 10000 cells");
  requireChoice("Boundary", this->Boundary, BoundaryTexts);
  SplatOptions options;
  options.Kernel = static_cast<SplatKernel>(this->Kernel);
  options.Radius = this->Radius;
  options.Boundary = static_cast<SplatBoundary>(this->Boundary);
  return options;
}

void SplatSettings::Print(std::ostream& os, vtkIndent indent) const
{
  os << indent << "Kernel: " << this->KernelText() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Boundary: " << this->BoundaryText() << "\n";
}

} // namespace RectifiedTransport
