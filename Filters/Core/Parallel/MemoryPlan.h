// SPDX-License-Identifier: BSD-3-Clause
// What a computation is about to allocate: one value for the check before it and for its error.
#ifndef RectifiedTransport_MemoryPlan_h
#define RectifiedTransport_MemoryPlan_h

#include <string>

namespace RectifiedTransport
{

struct MemoryPlan
{
  std::string Purpose; // continues "Not enough memory for "
  double Bytes = 0.0;

  // "Not enough memory for ...: 3.2 GB were asked for".
  std::string DescribeLack() const;
  // "3.2 GB".
  std::string Amount() const;
  // Whether a single block of this size can be allocated now. Systems that overcommit memory refuse
  // single blocks that exceed it, but not sums of blocks.
  bool Fits() const;
  // The same with more bytes.
  MemoryPlan With(double bytes) const { return { this->Purpose, this->Bytes + bytes }; }
};

} // namespace RectifiedTransport

#endif
