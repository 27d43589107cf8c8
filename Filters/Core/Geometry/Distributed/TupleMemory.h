// SPDX-License-Identifier: BSD-3-Clause
// The tuples of an array in memory, and as bytes for other ranks.
#ifndef RectifiedTransport_TupleMemory_h
#define RectifiedTransport_TupleMemory_h

#include "Core/Parallel/Ranks.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Contiguous tuples of `Size` bytes each; zeros of that size if First is null.
struct TupleMemory
{
  char* First = nullptr;
  std::size_t Size = 1;

  template <class Value>
  static TupleMemory Of(Value* values, int components)
  {
    return { reinterpret_cast<char*>(values),
      sizeof(Value) * static_cast<std::size_t>(components) };
  }
  char* At(std::int64_t tuple) const
  {
    return this->First + static_cast<std::size_t>(tuple) * this->Size;
  }
  std::size_t Length(std::int64_t tuples) const
  {
    return static_cast<std::size_t>(tuples) * this->Size;
  }
};

// Consecutive tuples.
struct TupleRun
{
  std::int64_t First;
  std::int64_t Count;
};

// Appends tuples as bytes; zeros if the array has no memory.
void appendTuples(const TupleMemory& from, const std::vector<TupleRun>& runs, Bytes& to);
// Copies tuples to as many tuples of another array of the kind.
void copyTuples(const TupleMemory& from, const std::vector<TupleRun>& runs,
  const std::vector<TupleRun>& runsThere, const TupleMemory& to);
// Reads tuples from bytes; returns where the next ones begin.
const char* takeTuples(const char* from, const std::vector<TupleRun>& runs, const TupleMemory& to);

// The tuples of elements, `each` of them one after the other, for the ranks that own the elements;
// `counts`: how many elements each rank owns.
std::vector<Bytes> packTuples(const TupleMemory& from, std::int64_t each,
  const std::vector<int>& owner, const std::vector<std::int64_t>& counts);
// Reads what each rank sent, rank 0 first.
void unpackTuples(std::vector<Bytes> received, const TupleMemory& to);

} // namespace RectifiedTransport

#endif
