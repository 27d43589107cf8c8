// SPDX-License-Identifier: BSD-3-Clause
// Which density something was made from, to know whether it has changed since.
#ifndef RectifiedTransport_ContentHash_h
#define RectifiedTransport_ContentHash_h

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/Fingerprint.h"

namespace RectifiedTransport
{

class ContentHash
{
public:
  // Whether it is plainly the same density. Else Renew tells.
  bool IsOf(const DensityImage& density) const
  {
    return this->Stamp.IsOf(density.GetIdentity(), density.ImageTime());
  }

  // Whether it may be the same density, in another image.
  bool IsLike(const DensityImage& density) const
  {
    return this->Stamp.IsLike(density.GetIdentity());
  }

  // Takes the stamp of a density, as the work of the host's current stage. Returns whether it is
  // the one that was stamped before, down to its values where only its image is another. Throws
  // Cancelled, and is then of no density.
  bool Renew(const DensityImage& density, Progress& progress)
  {
    return this->Stamp.Renew(
      density.GetIdentity(), density.ImageTime(), [&]() { return density.Fingerprint(progress); });
  }

private:
  DataStamp<DensityImage::Identity> Stamp;
};

} // namespace RectifiedTransport

#endif
