// SPDX-License-Identifier: BSD-3-Clause
// Whether data are what they were: by the times that say so, and by their bits where those differ.
#ifndef RectifiedTransport_Fingerprint_h
#define RectifiedTransport_Fingerprint_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

// A number that follows from the bits of the arrays' values, as the work of the current stage; 0 if
// they are not in memory as they are. Arrays may be null. Throws Cancelled.
std::uint64_t fingerprint(const std::vector<vtkDataArray*>& arrays, Progress& progress);

// Of data that are known by a key, such as the times of arrays, and by the time of the data set
// around them. Who writes into an array often says so to the data set alone; but hosts also make
// that anew around the same arrays at every run, as ParaView does.
template <class Key>
class DataStamp
{
public:
  // Whether they may be the same, in another data set.
  bool IsLike(const Key& key) const { return this->Known && this->Identity == key; }

  // Whether they plainly are the same. Else Renew tells.
  bool IsOf(const Key& key, std::uint64_t time) const
  {
    return this->IsLike(key) && this->Time == time;
  }

  // Takes the stamp of data whose fingerprint print() gives. Returns whether they are those that
  // were stamped before, down to their values where only the data set is another. Is of no data
  // where print() throws.
  template <class Print>
  bool Renew(const Key& key, std::uint64_t time, const Print& print)
  {
    const DataStamp previous = std::exchange(*this, DataStamp());
    this->Bits = print();
    this->Identity = key;
    this->Time = time;
    this->Known = true;
    return previous.IsOf(key, time) ||
      (previous.IsLike(key) && this->Bits != 0 && this->Bits == previous.Bits);
  }

private:
  bool Known = false;
  Key Identity{};
  std::uint64_t Time = 0;
  std::uint64_t Bits = 0; // the fingerprint; 0 if there is none
};

} // namespace RectifiedTransport

#endif
