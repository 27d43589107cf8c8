// SPDX-License-Identifier: BSD-3-Clause
// The one memory of what filters computed, by the data and the options that it was computed from.
#ifndef RectifiedTransport_Store_h
#define RectifiedTransport_Store_h

#include "Bridge/Store/DataIdentity.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include <memory>
#include <type_traits>
#include <typeinfo>
#include <utility>

namespace RectifiedTransport::Bridge
{

// What the filters of the process share: objects that some slot keeps. Any thread may call it.
namespace Store
{

// nullptr if nobody owns an object of this type and these data, which are hashed.
std::shared_ptr<void> find(const std::type_info& type, const DataIdentity& of);
void insert(
  const std::type_info& type, const DataIdentity& of, const std::shared_ptr<void>& object);
// Forgets an object that has no other owner, so that nobody finds it. Returns whether it has none.
bool withdraw(const std::shared_ptr<void>& object);

} // namespace Store

// Whether an object is shared with other filters.
enum class Sharing
{
  Process, // with filters that need one for the same data
  None
};

// The object that a filter keeps in a place, until it needs another one there.
class StoreSlot
{
public:
  bool IsEmpty() const { return !this->Object; }
  // Whether Get returns what is kept: by times alone.
  bool Holds(const DataIdentity& of) const { return this->Object && of.IsByTimes(this->Of); }
  // The same by contents; `of` is hashed.
  bool HoldsContent(const DataIdentity& of) const
  {
    return this->Object && of.IsByContent(this->Of);
  }
  // Identifies what is kept; hashed.
  const DataIdentity& Identity() const { return this->Of; }
  template <class T>
  std::shared_ptr<T> Cached() const
  {
    return std::static_pointer_cast<T>(this->Object);
  }
  void Release() { *this = StoreSlot(); }
  // For data of the content that is kept: takes their times.
  void TakeTimes(const DataIdentity& of) { this->Of = this->Holds(of) ? this->Of : of; }

  // Returns the object of these data: the one that is kept here or, if it may be shared, by another
  // filter, else a new one, which make() returns. Before that, what was kept is released; or
  // make(previous) gets it if it has no other owner, to use its memory, else nullptr. Ranks agree:
  // all of them make, or none. `progress` is that of the comparison. Collective on `ranks`. Throws
  // Cancelled, and what make throws; then nothing is kept.
  template <class T, class Make>
  std::shared_ptr<T> Get(
    DataIdentity of, const Ranks& ranks, Progress& progress, Sharing sharing, const Make& make)
  {
    // Times are local: a rank on which the last run failed may be alone in having to make it.
    if (onAllRanks(ranks, this->Holds(of)))
    {
      return this->Cached<T>();
    }
    of.Hash(progress);
    if (onAllRanks(ranks, this->HoldsContent(of)))
    {
      this->Of = std::move(of);
      return this->Cached<T>();
    }
    const bool isShared = sharing == Sharing::Process && of.HasHash();
    auto found = isShared ? Store::find(typeid(T), of) : nullptr;
    if (onAllRanks(ranks, found != nullptr))
    {
      this->Object = std::move(found);
      this->Of = std::move(of);
      return this->Cached<T>();
    }
    found.reset();
    std::shared_ptr<void> previous = std::move(this->Object);
    this->Release();
    if (previous && !Store::withdraw(previous))
    {
      previous.reset();
    }
    std::shared_ptr<T> made = this->Made<T>(std::move(previous), make);
    this->Object = std::const_pointer_cast<std::remove_const_t<T>>(made);
    if (isShared)
    {
      Store::insert(typeid(T), of, this->Object);
    }
    this->Of = std::move(of);
    return made;
  }

private:
  template <class T, class Make>
  static std::shared_ptr<T> Made(std::shared_ptr<void> previous, const Make& make)
  {
    if constexpr (std::is_invocable_v<Make, std::shared_ptr<T>>)
    {
      return make(std::static_pointer_cast<T>(std::move(previous)));
    }
    else
    {
      previous.reset(); // two side by side would double the peak
      return make();
    }
  }

  std::shared_ptr<void> Object;
  DataIdentity Of;
};

} // namespace RectifiedTransport::Bridge

#endif
