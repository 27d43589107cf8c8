// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/PlaneFrame.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport::Bridge
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

void RingPlane::Add(const std::vector<Point<3>>& ring)
{
  Point<3> area{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      this->Low[a] = std::min(this->Low[a], ring[i][a]);
      this->High[a] = std::max(this->High[a], ring[i][a]);
    }
    Point<3> from;
    Point<3> to;
    Point<3> cross;
    vtkMath::Subtract(ring[i].data(), ring.front().data(), from.data());
    vtkMath::Subtract(ring[(i + 1) % ring.size()].data(), ring.front().data(), to.data());
    vtkMath::Cross(from.data(), to.data(), cross.data());
    vtkMath::Add(area.data(), cross.data(), area.data());
  }
  if (vtkMath::Norm(area.data()) > vtkMath::Norm(this->Largest.data()))
  {
    this->Largest = area;
  }
  const double turn = vtkMath::Dot(area.data(), this->Largest.data()) < 0.0 ? -1.0 : 1.0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    this->Sum[a] += turn * area[a];
  }
}

bool RingPlane::HasArea() const
{
  return vtkMath::Norm(this->Sum.data()) > 0.0;
}

PlaneFrame RingPlane::Frame() const
{
  Point<3> centre;
  for (std::size_t a = 0; a < 3; ++a)
  {
    centre[a] = 0.5 * (this->Low[a] + this->High[a]);
  }
  return PlaneFrame(centre, this->Sum);
}

double RingPlane::Extent() const
{
  return std::hypot(
    this->High[0] - this->Low[0], this->High[1] - this->Low[1], this->High[2] - this->Low[2]);
}

} // namespace RectifiedTransport::Bridge
