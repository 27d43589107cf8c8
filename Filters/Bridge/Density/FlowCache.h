// SPDX-License-Identifier: BSD-3-Clause
// The flow of a density, kept until the density changes.
#ifndef RectifiedTransport_FlowCache_h
#define RectifiedTransport_FlowCache_h

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Density/DensityImage.h"
#include "Core/Flow/RectifiedFlow.h"

#include "vtkTimeStamp.h"

#include <variant>

namespace RectifiedTransport
{

class Progress;

class FlowCache
{
public:
  // Whether Update has to look closer, and most likely builds tables.
  bool IsOutdated(const DensityImage& density) const;

  // Builds the tables if the density is another one, down to its values where only its image is
  // another; progress then reaches `end`. Throws
  // Failure and Cancelled; the next update then builds.
  void Update(DensityImage& density, Progress& progress, double end);

  // Gives the tables' memory back; the next update builds.
  void Release() { this->Kept = std::monostate(); }

  template <int D>
  const RectifiedFlow<D>& Flow() const
  {
    return std::get<RectifiedFlow<D>>(this->Kept);
  }

  // Density times cell measure, summed.
  double TotalMass() const { return this->Mass; }

  // Grows with each build; 0 before the first.
  vtkMTimeType BuildTime() const { return this->Built.GetMTime(); }

private:
  bool HasFlow() const { return !std::holds_alternative<std::monostate>(this->Kept); }
  template <int D>
  RectifiedFlow<D> BuildFlow(DensityImage& density, const Context& context);
  template <int D>
  void Build(DensityImage& density, Progress& progress);

  std::variant<std::monostate, RectifiedFlow<1>, RectifiedFlow<2>, RectifiedFlow<3>> Kept;
  ContentHash Stamp;
  double Mass = 0.0;
  vtkTimeStamp Built;
};

} // namespace RectifiedTransport

#endif
