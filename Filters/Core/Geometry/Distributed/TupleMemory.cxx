// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/TupleMemory.h"

#include <algorithm>
#include <numeric>

namespace RectifiedTransport
{

// The receiver counts on the bytes of all runs: an array without memory sends zeros.
void appendTuples(const TupleMemory& from, const std::vector<TupleRun>& runs, Bytes& to)
{
  const std::int64_t tuples = std::accumulate(runs.begin(), runs.end(), std::int64_t{ 0 },
    [](std::int64_t sum, const TupleRun& run) { return sum + run.Count; });
  if (!from.First)
  {
    to.resize(to.size() + from.Length(tuples));
    return;
  }
  to.reserve(to.size() + from.Length(tuples));
  for (const TupleRun& run : runs)
  {
    to.insert(to.end(), from.At(run.First), from.At(run.First + run.Count));
  }
}

// Run i of one array goes to run i of the other; both have as many tuples.
void copyTuples(const TupleMemory& from, const std::vector<TupleRun>& runs,
  const std::vector<TupleRun>& runsThere, const TupleMemory& to)
{
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    char* target = to.At(runsThere[i].First);
    if (from.First)
    {
      std::copy_n(from.At(runs[i].First), to.Length(runs[i].Count), target);
    }
    else
    {
      std::fill_n(target, to.Length(runs[i].Count), '\0');
    }
  }
}

// The inverse of appendTuples: the bytes are in the order of the runs.
const char* takeTuples(const char* from, const std::vector<TupleRun>& runs, const TupleMemory& to)
{
  for (const TupleRun& run : runs)
  {
    std::copy_n(from, to.Length(run.Count), to.At(run.First));
    from += to.Length(run.Count);
  }
  return from;
}

// One pass over the elements: each goes to the end of its owner's part, so that parts keep their
// order. Without memory, the parts stay zeros.
std::vector<Bytes> packTuples(const TupleMemory& from, std::int64_t each,
  const std::vector<int>& owner, const std::vector<std::int64_t>& counts)
{
  const std::size_t size = from.Length(each);
  std::vector<Bytes> parts;
  std::vector<char*> next;
  for (const std::int64_t count : counts)
  {
    parts.emplace_back(static_cast<std::size_t>(count) * size);
    next.push_back(parts.back().data());
  }
  for (std::size_t i = 0; from.First && i < owner.size(); ++i)
  {
    char*& to = next[static_cast<std::size_t>(owner[i])];
    to = std::copy_n(from.First + i * size, size, to);
  }
  return parts;
}

// The memory of each part is freed once it has been read.
void unpackTuples(std::vector<Bytes> received, const TupleMemory& to)
{
  char* next = to.First;
  for (Bytes& bytes : received)
  {
    next = std::copy(bytes.begin(), bytes.end(), next);
    bytes = Bytes();
  }
}

} // namespace RectifiedTransport
