// SPDX-License-Identifier: BSD-3-Clause
// Detects unchanged data: by modification times, and if those differ by a hash of the values.
#ifndef RectifiedTransport_DataStamp_h
#define RectifiedTransport_DataStamp_h

#include <cstdint>
#include <utility>

namespace RectifiedTransport
{

// Identifies data by a key, such as the modification times of arrays, by the modification time of
// their data set, and by a fingerprint. Programs that write into an array often call Modified()
// only on the data set; but hosts such as ParaView also make a new data set of the same arrays at
// every run.
template <class Key>
class DataStamp
{
public:
  // Whether the key is equal: the data may be the same, in another data set.
  bool IsLike(const Key& key) const { return this->Known && this->Identity == key; }

  // Whether key and time are equal: the data are the same. If false, Update compares fingerprints.
  bool IsOf(const Key& key, std::uint64_t time) const
  {
    return this->IsLike(key) && this->Time == time;
  }

  // Stores key, time and the fingerprint that print() returns. Returns whether the data are those
  // of the previous call: by time, or if only the time differs by fingerprint. If print() throws,
  // nothing is stored.
  template <class Print>
  bool Update(const Key& key, std::uint64_t time, const Print& print)
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
