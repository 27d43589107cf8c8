// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Settings/CornerSettings.h"

#include "Bridge/Run/Failure.h"

#include <stdexcept>
#include <string>

namespace RectifiedTransport::Bridge
{

void CornerSettings::Check() const
{
  if (!this->All.empty() && this->All.size() != 4)
  {
    throw Failure("Corners are " + std::to_string(this->All.size()) +
      " points; they must be 4 of the boundary, or none");
  }
}

SquareCorners CornerSettings::Of(const RepairedDisk& disk) const
{
  if (this->All.empty())
  {
    return chooseCorners(disk.Mesh());
  }
  std::vector<std::int64_t> corners;
  for (const std::int64_t point : this->All)
  {
    const std::string have = "Corners have the point " + std::to_string(point);
    if (point < 0 || point >= disk.NumberOfGivenPoints())
    {
      throw Failure(
        have + "; there are points 0 to " + std::to_string(disk.NumberOfGivenPoints() - 1));
    }
    corners.push_back(disk.PointOf(point));
    if (corners.back() < 0)
    {
      throw Failure(have +
        ", which is in no triangle with area; they must be 4 points of the "
        "boundary of the surface");
    }
  }
  try
  {
    return orderCorners(disk.Mesh(), corners, this->All);
  }
  catch (const std::invalid_argument& error)
  {
    throw Failure(std::string("Corners ") + error.what());
  }
}

} // namespace RectifiedTransport::Bridge
