// SPDX-License-Identifier: BSD-3-Clause
// The flow of a density, with its tables, for all who read the same density.
#ifndef RectifiedTransport_SharedFlow_h
#define RectifiedTransport_SharedFlow_h

#include "Bridge/Density/DensityImage.h"
#include "Core/Flow/RectifiedFlow.h"

#include "vtkTimeStamp.h"

#include <memory>
#include <variant>

namespace RectifiedTransport
{

class ContentHash;

class SharedFlow
{
public:
  template <int D>
  const RectifiedFlow<D>& Flow() const
  {
    return std::get<RectifiedFlow<D>>(this->Kept);
  }
  // Density times cell measure, summed.
  double TotalMass() const { return this->Mass; }
  vtkMTimeType BuildTime() const { return this->Built.GetMTime(); }

  // The flow of a density that someone holds, else a new one, which is kept for others as long as
  // anyone holds it; progress then reaches `end`. `previous` is given up before: its memory is
  // taken for a new one where nobody else holds it. Throws Failure and Cancelled.
  static std::shared_ptr<const SharedFlow> Of(DensityImage& density, const ContentHash& content,
    std::shared_ptr<const SharedFlow> previous, Progress& progress, double end);

private:
  using AnyFlow =
    std::variant<std::monostate, RectifiedFlow<1>, RectifiedFlow<2>, RectifiedFlow<3>>;

  template <int D>
  void Build(DensityImage& density, AnyFlow previous, Progress& progress);

  AnyFlow Kept;
  double Mass = 0.0;
  vtkTimeStamp Built;
};

} // namespace RectifiedTransport

#endif
