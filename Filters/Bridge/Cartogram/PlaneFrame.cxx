// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Cartogram/PlaneFrame.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

// The first axis is as near to that of x (or of y, if the normal is nearly along x) as the plane
// has, and the second one makes the frame right-handed about a normal that points up.
PlaneFrame::PlaneFrame(const Point<3>& origin, const Point<3>& normal)
  : Origin(origin)
{
  Point<3>& up = this->Axes[2];
  up = normal;
  vtkMath::Normalize(up.data());
  constexpr double nearly = 0.999;
  const int along = std::abs(up[0]) < nearly ? 0 : 1;
  const int high = std::abs(up[2]) > 1e-9 ? 2 : std::abs(up[1]) > 1e-9 ? 1 : 0;
  if (up[static_cast<std::size_t>(high)] < 0.0)
  {
    std::transform(up.begin(), up.end(), up.begin(), [](double x) { return 0.0 - x; });
  }
  Point<3>& first = this->Axes[0];
  first = { 0.0, 0.0, 0.0 };
  first[static_cast<std::size_t>(along)] = 1.0;
  const double part = up[static_cast<std::size_t>(along)];
  for (std::size_t i = 0; i < 3; ++i)
  {
    first[i] -= part * up[i];
  }
  vtkMath::Normalize(first.data());
  vtkMath::Cross(up.data(), first.data(), this->Axes[1].data());
}

Point<2> PlaneFrame::ToPlane(const Point<3>& place) const
{
  Point<3> offset;
  vtkMath::Subtract(place.data(), this->Origin.data(), offset.data());
  return { vtkMath::Dot(offset.data(), this->Axes[0].data()),
    vtkMath::Dot(offset.data(), this->Axes[1].data()) };
}

double PlaneFrame::Distance(const Point<3>& place) const
{
  Point<3> offset;
  vtkMath::Subtract(place.data(), this->Origin.data(), offset.data());
  return vtkMath::Dot(offset.data(), this->Axes[2].data());
}

Point<3> PlaneFrame::ToSpace(const Point<2>& inPlane, double distance) const
{
  Point<3> place;
  for (std::size_t i = 0; i < 3; ++i)
  {
    place[i] = this->Origin[i] + inPlane[0] * this->Axes[0][i] + inPlane[1] * this->Axes[1][i] +
      distance * this->Axes[2][i];
  }
  return place;
}

} // namespace RectifiedTransport
