// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parameterization/CornerSettings.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

std::int64_t CornerSettings::At(int index) const
{
  return index >= 0 && index < this->Number() ? this->Points[static_cast<std::size_t>(index)] : -1;
}

bool CornerSettings::Resize(int count)
{
  if (count < 0 || count > MaximumNumber)
  {
    throw std::invalid_argument("The number of corners is " + std::to_string(count) +
      "; it must be from 0 to " + std::to_string(MaximumNumber));
  }
  const bool changes = count != this->Number();
  this->Points.resize(static_cast<std::size_t>(count), -1);
  return changes;
}

bool CornerSettings::Set(int index, std::int64_t point)
{
  if (index < 0 || index >= MaximumNumber)
  {
    throw std::invalid_argument("The index of a corner is " + std::to_string(index) +
      "; it must be from 0 to " + std::to_string(MaximumNumber - 1));
  }
  const bool grows = this->Resize(std::max(index + 1, this->Number()));
  std::int64_t& known = this->Points[static_cast<std::size_t>(index)];
  const bool changes = known != point;
  known = point;
  return grows || changes;
}

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

std::string CornerSettings::Text() const
{
  std::string text;
  for (const std::int64_t point : this->Points)
  {
    text += " " + std::to_string(point);
  }
  return this->Points.empty() ? " automatic" : text;
}

} // namespace RectifiedTransport
