// SPDX-License-Identifier: BSD-3-Clause
// Which density something was made from, to know whether it has changed since.
#ifndef RectifiedTransport_ContentHash_h
#define RectifiedTransport_ContentHash_h

#include "Bridge/Density/DensityImage.h"

namespace RectifiedTransport
{

class ContentHash
{
public:
  ContentHash() = default; // of no density
  // Takes the content of a density, as the work of the current stage. Throws Cancelled.
  ContentHash(DensityImage& density, Progress& progress)
    : Known(true)
    , Times(density.GetTimes())
    , Content(density.GetContent(progress))
  {
  }

  // Whether it is plainly of this density: nothing says that it was changed. Else its own hash
  // tells.
  bool IsOf(const DensityImage& density) const
  {
    DensityImage::Content reading = this->Content;
    reading[0] = 0;
    return this->Known && this->Times == density.GetTimes() && reading == density.GetReading();
  }

  // Where values are not in memory as they are, equal content tells nothing.
  bool operator==(const ContentHash& other) const
  {
    return this->Known && other.Known && this->Content == other.Content &&
      (this->IsComplete() || this->Times == other.Times);
  }
  // Of the same density, which may come in another image.
  void SetTimes(const DensityImage& density) { this->Times = density.GetTimes(); }

  bool IsComplete() const { return this->Content[0] != 0; }
  bool operator<(const ContentHash& other) const { return this->Content < other.Content; }

private:
  bool Known = false;
  DensityImage::Times Times{};
  DensityImage::Content Content{};
};

} // namespace RectifiedTransport

#endif
