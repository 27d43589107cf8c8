// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/CornerSettings.h"

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

void CornerSettings::Check() const
{
  if (!this->Points.empty() && this->Points.size() != 4)
  {
    throw std::invalid_argument("Corners are " + std::to_string(this->Points.size()) +
      " points; they must be 4 of the boundary, or none");
  }
}

SquareCorners CornerSettings::Of(const RepairedDisk& disk) const
{
  if (this->Points.empty())
  {
    return chooseCorners(disk.Mesh());
  }
  // The given points' numbers become those of the repaired mesh, which may have merged or dropped
  // some.
  std::vector<std::int64_t> corners;
  for (const std::int64_t point : this->Points)
  {
    const std::string have = "Corners have the point " + std::to_string(point);
    if (point < 0 || point >= disk.NumberOfGivenPoints())
    {
      throw std::invalid_argument(
        have + "; there are points 0 to " + std::to_string(disk.NumberOfGivenPoints() - 1));
    }
    corners.push_back(disk.PointOf(point));
    if (corners.back() < 0)
    {
      throw std::invalid_argument(have +
        ", which is in no triangle with area; they must be 4 points of the "
        "boundary of the surface");
    }
  }
  try
  {
    return orderCorners(disk.Mesh(), corners, this->Points);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(std::string("Corners ") + error.what());
  }
}

} // namespace RectifiedTransport
