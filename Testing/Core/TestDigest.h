// SPDX-License-Identifier: BSD-3-Clause
// The results' very bits: the same from every compiler, on every processor and with every
// instruction set (the tests run once with each). A change that means to alter results states its
// new digests in the tests that use this, and in the changelog.
#ifndef TestDigest_h
#define TestDigest_h

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Fowler, Noll and Vo's hash of bytes.
class Digest
{
public:
  template <class T>
  void Add(const std::vector<T>& values)
  {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i)
    {
      this->Hash = (this->Hash ^ bytes[i]) * 0x100000001b3u;
    }
  }
  std::uint64_t Value() const { return this->Hash; }

private:
  std::uint64_t Hash = 0xcbf29ce484222325u;
};

using KnownDigests = std::map<std::string, std::uint64_t>;

inline void expectDigest(const KnownDigests& known, const std::string& what, const Digest& digest)
{
  const auto found = known.find(what);
  EXPECT_TRUE(found != known.end() && found->second == digest.Value())
    << "it is { \"" << what << "\", 0x" << std::hex << digest.Value() << "u },";
}

} // namespace RectifiedTransport

#endif
