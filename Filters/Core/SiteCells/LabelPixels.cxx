// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/LabelPixels.h"

#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Parallel/MemoryPlan.h"

namespace RectifiedTransport
{

ImageGrid labelPixels(const ImageGrid& box, int resolution)
{
  constexpr int flat = 512;
  constexpr int solid = 64; // 262144 pixels of a cube, about as many as 512 x 512
  const int automatic = box.Dimension() == 3 ? solid : flat;
  return gridWithResolution(box, resolution == 0 ? automatic : resolution, "Resolution");
}

bool areManyPixels(const ImageGrid& pixels)
{
  constexpr double many = 8e6;
  return numberOfValues(pixels) > many;
}

std::string describeLabelPixels(const ImageGrid& pixels)
{
  constexpr double bytesOfPixel = 41.0; // in the largest step, without outlines
  return describeValues(pixels) + " pixels take about " +
    MemoryPlan{ "", bytesOfPixel * numberOfValues(pixels) }.Amount() +
    (areManyPixels(pixels) ? "; a lower Resolution is quicker" : "");
}

} // namespace RectifiedTransport
