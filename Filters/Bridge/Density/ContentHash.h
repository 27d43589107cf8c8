// SPDX-License-Identifier: BSD-3-Clause
// Identifies the density that a result was computed from, to detect changes.
#ifndef RectifiedTransport_ContentHash_h
#define RectifiedTransport_ContentHash_h

#include "Bridge/Density/InputDensity.h"

namespace RectifiedTransport::Bridge
{

class ContentHash
{
public:
  ContentHash() = default; // of no density
  // Takes the content of a density. Throws Cancelled.
  ContentHash(InputDensity& density, Progress& progress)
    : Known(true)
    , Times(density.GetTimes())
    , Content(density.GetContent(progress))
  {
  }

  // Whether it is of this density, only by modification times and reading parameters. If false,
  // contents must be compared.
  bool IsOf(const InputDensity& density) const
  {
    InputDensity::Content reading = this->Content;
    reading[0] = 0;
    return this->Known && this->Times == density.GetTimes() && reading == density.GetReading();
  }

  // Without a contiguous array there is no hash of the values: times must be equal, too.
  bool operator==(const ContentHash& other) const
  {
    return this->Known && other.Known && this->Content == other.Content &&
      (this->IsComplete() || this->Times == other.Times);
  }
  // Takes the times of another image that holds the same density.
  void SetTimes(const InputDensity& density) { this->Times = density.GetTimes(); }

  bool IsComplete() const { return this->Content[0] != 0; }
  bool operator<(const ContentHash& other) const { return this->Content < other.Content; }

private:
  bool Known = false;
  InputDensity::Times Times{};
  InputDensity::Content Content{};
};

} // namespace RectifiedTransport::Bridge

#endif
