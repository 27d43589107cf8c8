// SPDX-License-Identifier: BSD-3-Clause
// The density of an image that lies on several ranks, for the core: parts of it on any rank.
#ifndef RectifiedTransport_PiecesDensity_h
#define RectifiedTransport_PiecesDensity_h

#include "Core/Tables/SharedDensity.h"

#include <memory>

namespace RectifiedTransport
{

class DensityImage;

template <int Dimension>
class PiecesDensity final : public SharedDensity<Dimension>
{
public:
  // The density must outlive this object, and be prepared.
  explicit PiecesDensity(const DensityImage& density)
    : Density(density)
  {
  }
  std::unique_ptr<const DensityValues> Gather(
    const GridSize<Dimension>& low, const GridSize<Dimension>& high) const override;

private:
  const DensityImage& Density;
};

} // namespace RectifiedTransport

#endif
