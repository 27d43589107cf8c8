// SPDX-License-Identifier: BSD-3-Clause
#include "DensityStamp.h"

#include "HostMonitor.h"

#include <utility>

namespace RectifiedTransport
{

bool DensityStamp::IsOf(const DensityImage& density) const
{
  return this->IsLike(density) && this->ImageTime == density.ImageTime();
}

bool DensityStamp::Renew(const DensityImage& density, const Executor& executor, HostMonitor& host)
{
  const DensityStamp previous = std::exchange(*this, DensityStamp());
  this->Fingerprint = density.Fingerprint(executor, host);
  this->Key = density.GetIdentity();
  this->ImageTime = density.ImageTime();
  return this->Key == previous.Key &&
    (this->ImageTime == previous.ImageTime ||
      (this->Fingerprint != 0 && this->Fingerprint == previous.Fingerprint));
}

} // namespace RectifiedTransport
