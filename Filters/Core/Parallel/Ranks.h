// SPDX-License-Identifier: BSD-3-Clause
// The ranks (processes) that run one computation together, each on its part of the data: the
// interface through which a host application lets them exchange bytes.
#ifndef RectifiedTransport_Ranks_h
#define RectifiedTransport_Ranks_h

#include <vector>

namespace RectifiedTransport
{

// Thrown by an exchange when the computation of another rank has failed; that rank knows the
// reason. Not a std::exception, because nothing failed here.
class FailedElsewhere
{
};

using Bytes = std::vector<char>;

// Gather and Exchange are collective: all ranks call them in the same order. When a rank fails or
// is cancelled, the next exchange of each other rank throws FailedElsewhere or Cancelled.
class Ranks
{
public:
  virtual ~Ranks() = default;

  virtual int Count() const = 0;
  virtual int Own() const = 0; // from 0
  // Returns what each rank gives, on all ranks.
  virtual std::vector<Bytes> Gather(const Bytes& own) const = 0;
  // Sends a part to each rank, including this one, and returns what each sent here.
  virtual std::vector<Bytes> Exchange(std::vector<Bytes> parts) const = 0;

  bool AreSeveral() const { return this->Count() > 1; }
  bool IsFirst() const { return this->Own() == 0; }
};

// One rank, for a computation in one process.
class SoloRanks final : public Ranks
{
public:
  int Count() const override { return 1; }
  int Own() const override { return 0; }
  std::vector<Bytes> Gather(const Bytes& own) const override { return { own }; }
  std::vector<Bytes> Exchange(std::vector<Bytes> parts) const override { return parts; }

  static const SoloRanks& Get()
  {
    static const SoloRanks solo;
    return solo;
  }
};

} // namespace RectifiedTransport

#endif
