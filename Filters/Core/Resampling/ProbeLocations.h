// SPDX-License-Identifier: BSD-3-Clause
// Places in data sets, at which arrays are sampled.
#ifndef RectifiedTransport_ProbeLocations_h
#define RectifiedTransport_ProbeLocations_h

#include <cstdint>

namespace RectifiedTransport
{

// A place in a data set: between points that have weights, and in a cell.
struct ProbeLocation
{
  std::int64_t Points[8];
  double Weights[8]; // by points; they sum to 1
  int Count;         // number of points
  std::int64_t Cell; // -1 for a place in none: values are NaN, or 0 for types without NaN
  int Set = 0;       // which of the data sets
};

class ProbeLocations
{
public:
  virtual ~ProbeLocations() = default;

  virtual std::int64_t Count() const = 0;
  // On any thread.
  virtual ProbeLocation Find(std::int64_t place) const = 0;
  // The same for `count` places from `first` on; for a place it writes only as many points as it
  // has.
  virtual void FindBlock(std::int64_t first, std::int64_t count, ProbeLocation* found) const
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      found[i] = this->Find(first + i);
    }
  }
};

} // namespace RectifiedTransport

#endif
